// SPDX-License-Identifier: GPL-3.0-or-later
/// Newton's method with damping for small dense systems F(x) = 0 that are solved before or beside a run;
/// steps have their own, which allocates nothing (integrator/galerkin_step.hpp).
///
/// A correction is halved until the residual shrinks, at most 30 times: 1e-9 of a correction that still does
/// not help is not taken. When it ends is said by solve/newton_policy.hpp. `size` is that of the quantities
/// the unknowns are parts of, where it is larger than theirs: round-off is relative to it. T: double or
/// quadruple precision. Trouble is an Outcome: singular, notFinite, diverged.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/outcome.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

/// system(x, F, J) fills F and the Jacobian J = dF/dx and says whether they are finite; J may be null.
template <class T, class System>
Outcome solveNewton(Eigen::Matrix<T, Eigen::Dynamic, 1>& x, System&& system, const T& size = T(0),
                    int maxIterations = 100) {
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    if (x.size() == 0) return Outcome::converged;
    constexpr int mostHalvings = 30;
    const auto limits = NewtonLimits<T>::dense();
    NewtonPolicy<T> policy(limits);
    Vector F, trial, trialF;
    Matrix J;
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        if (!system(x, F, &J)) return Outcome::notFinite;
        const dense::Lu<T> lu(J);
        if (!isRegular(T(lu.pivotRatio()), T(1))) return Outcome::singular;
        const Vector delta = -lu.solve(F);
        const T change = delta.cwiseAbs().maxCoeff(),
                scale = std::max({T(x.cwiseAbs().maxCoeff()), change, size});
        const T relative = change > T(0) ? T(change / scale) : change;
        if (const auto end = endOf(policy.judge(relative))) {
            if (*end == Outcome::converged) x += delta;
            return *end;
        }
        const bool isNear = relative <= limits.stagnation;
        T damping(1);
        const T before = F.norm();
        for (int half = 0;; ++half, damping /= 2) {
            trial = x + damping * delta;
            if (isNear || half == mostHalvings)
                break;  // the residual is round-off, or will not shrink: take it as it is
            if (system(trial, trialF, nullptr) && trialF.norm() < before) break;
        }
        x = trial;
    }
    return Outcome::diverged;
}

}  // namespace extremal
