// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of tau as a user types them, with their derivatives by tau, in any precision.
///
/// Each is an expression (core/text/expression.hpp) in tau, in the length h of the step, and in names that
/// stand for expressions in their turn. Numbers are read from their text in the precision of the evaluation,
/// so that 0.1 is exact in all of them; the points of tables are doubles. Derivatives by dual numbers (f, f')
/// through the tree; abs' = sign and sign' = 0, also at 0, and a choice has the derivative of what is chosen.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/text/expression.hpp"

namespace extremal {

struct Formulas {
    std::vector<Expression> functions;
    /// Names and what they stand for; each may use those before it.
    std::vector<std::pair<std::string, Expression>> names;
    std::optional<double> step;  ///< the value of h; empty where none of them depends on it

    /// Whether a function, or a name that one uses, depends on h.
    bool dependOnStep() const;
};

/// Formulas in one precision; names must be known.
template <class T>
class EvaluatedFormulas {
public:
    explicit EvaluatedFormulas(const Formulas& formulas);
    std::size_t size() const { return results_.size(); }
    /// Operations of one evaluation.
    std::size_t length() const { return code_.size(); }
    /// Fills value[a] = f_a(tau) and derivative[a] = f_a'(tau); they may be infinite or not numbers.
    void operator()(const T& tau, std::span<T> value, std::span<T> derivative) const;

private:
    /// kind `name`: tau.
    struct Instruction {
        Operator kind;
        int left, right, third;
        int function;
        T number;
        std::shared_ptr<const Interpolant> table;
    };
    struct Dual {
        T value{}, slope{};
    };
    int append(const Expression& expression, const std::vector<std::pair<std::string, int>>& known,
               const std::optional<double>& step);
    static Dual power(const Dual& a, const Dual& b);
    static Dual call(int function, const Dual& a, const Dual& b, const Dual& c);
    static Dual laterCall(int function, const Dual& a, const Dual& b, const Dual& c);

    std::vector<Instruction> code_;
    std::vector<int> results_;
};

}  // namespace extremal
