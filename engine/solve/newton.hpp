/// Newton's method with damping for small dense systems F(x) = 0 that are solved before or beside a run;
/// steps have their own, which allocates nothing (integrator/galerkin_step.hpp).
///
/// A correction is halved until the residual shrinks, at most 30 times. The iteration goes on to round-off:
/// it ends when the correction is below a unit of the last place of the unknowns, or no longer shrinks within
/// four digits of it. `size` is that of the quantities the unknowns are parts of, where it is larger than
/// theirs: round-off is relative to it. T: double or quadruple precision. Trouble is an Outcome: singular,
/// notFinite, diverged.
#pragma once

#include <algorithm>
#include <limits>

#include "engine/core/dense.hpp"
#include "engine/core/outcome.hpp"

namespace extremal {

/// system(x, F, J) fills F and the Jacobian J = dF/dx and says whether they are finite; J may be null.
template <class T, class System>
Outcome solveNewton(Eigen::Matrix<T, Eigen::Dynamic, 1>& x, System&& system, const T& size = T(0),
                    int maxIterations = 100) {
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    if (x.size() == 0) return Outcome::converged;
    const T epsilon = std::numeric_limits<T>::epsilon();
    Vector F, trial, trialF;
    Matrix J;
    T last = std::numeric_limits<T>::infinity();
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        if (!system(x, F, &J)) return Outcome::notFinite;
        const dense::Lu<T> lu(J);
        if (!(lu.pivotRatio() > epsilon * T(1e-3))) return Outcome::singular;
        const Vector delta = -lu.solve(F);
        const T change = delta.cwiseAbs().maxCoeff(),
                scale = std::max({T(x.cwiseAbs().maxCoeff()), change, size});
        if (!(change < std::numeric_limits<T>::infinity())) return Outcome::notFinite;
        const bool isNear = change <= T(1e4) * epsilon * scale;
        if (change <= epsilon * scale || (isNear && change >= last / 4)) {
            x += delta;
            return Outcome::converged;
        }
        T damping(1);
        const T before = F.norm();
        for (int half = 0;; ++half, damping /= 2) {
            trial = x + damping * delta;
            if (isNear || half == 30)
                break;  // the residual is round-off, or will not shrink: take it as it is
            if (system(trial, trialF, nullptr) && trialF.norm() < before) break;
        }
        x = trial;
        last = change;
    }
    return Outcome::diverged;
}

}  // namespace extremal
