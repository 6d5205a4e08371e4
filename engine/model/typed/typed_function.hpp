// SPDX-License-Identifier: GPL-3.0-or-later
/// A typed function of one or more variables with its first and second derivatives.
///
/// f(y_0, ..), an expression in the names of its variables and parameters, differentiated symbolically and
/// flattened to tapes as they are asked for: f alone, with df/dy_i, and with d2f/dy_i dy_j. Errors are
/// InvalidScene with the pointer given and a caret below the place.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/graph.hpp"
#include "engine/model/typed/tape/tape.hpp"

namespace extremal::typed {

class TypedFunction {
public:
    TypedFunction(const std::string& text, const std::string& pointer, std::vector<std::string> variables,
                  std::vector<std::pair<std::string, double>> parameters);

    /// Of the text of a formula whose names are known to be right, and which may be long (isExpanded).
    /// Throws ExpressionError.
    explicit TypedFunction(const Formula& formula);

    int variables() const { return variables_; }
    /// Fills f, then the gradient, then the lower triangle of the Hessian row by row; any of the last two may
    /// be null.
    void evaluate(const double* y, double* value, double* gradient, double* hessian) const;
    /// Adds it to a graph, with these nodes for y_0, ..
    GraphFunction addTo(Graph& to, const std::vector<int>& variables) const;
    /// Whether all second derivatives are 0 as formulas.
    bool isAffine() const;
    /// Instructions of one evaluation with all derivatives.
    std::size_t length() const { return tape(Extent::hessian).length(); }
    double operator()(const double* y) const {
        double value = 0;
        evaluate(y, &value, nullptr, nullptr);
        return value;
    }

private:
    enum class Extent : std::size_t { value, gradient, hessian };  ///< each with those before it
    struct Derivatives;

    void compile(const Formula& formula);
    const Tape& tape(Extent extent) const;

    int variables_;
    std::shared_ptr<Derivatives> made_;
};

}  // namespace extremal::typed
