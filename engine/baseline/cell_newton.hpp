// SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method for equations of the nodal values of a field, with a banded LU that is kept while it
/// contracts. Internal to the implicit cells.
#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/model/density/problem.hpp"
#include "engine/solve/band_lu.hpp"

namespace extremal {

class CellNewton {
public:
    CellNewton() = default;
    explicit CellNewton(const DensityProblem& problem);

    /// The matrix at x: add(i, j, value) for its entries.
    using Add = std::function<void(std::size_t i, std::size_t j, double value)>;
    struct Equations {
        /// F(x); held values are left as they are.
        std::function<void(const double* x, double* F)> residual;
        std::function<void(const double* x, const Add& add)> matrix;
    };
    /// Improves x. Held values stay.
    Outcome solve(const Equations& equations, double* x, const std::stop_token& stop, StepReport& report);

    /// Factorises the matrix at x; false where it is singular.
    bool factorise(const Equations& equations, const double* x);
    /// b <- A^{-1} b, 0 at held values.
    void apply(double* b);
    void forget() { isFactored_ = false; }
    bool isFactored() const { return isFactored_; }
    int reach() const { return lu_.reach(); }

private:
    Outcome attempt(const Equations& equations, double* x, int most, bool isKept, const std::stop_token& stop,
                    StepReport& report);

    std::vector<int> place_;  ///< of unknown i in the band
    std::vector<bool> isHeld_;
    BandLu lu_;
    bool isFactored_ = false, isLine_ = true;
    std::vector<double> F_, delta_, start_;
};

}  // namespace extremal
