// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/cell_newton.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/corrections.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {
namespace {

bool isFiniteEverywhere(const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

/// The shorter side runs fastest; periodic ones are folded, so that neighbours are two places apart at most.
CellNewton::CellNewton(const DensityProblem& problem) {
    const int nx = problem.nodesX(), ny = problem.nodesY(), m = static_cast<int>(problem.components());
    const std::vector<int> x = problem.isPeriodic() ? foldedOrder(nx) : lineOrder(nx), y = foldedOrder(ny);
    const bool isXInner = nx <= ny || ny == 1;
    for (std::size_t i = 0; i < problem.size(); ++i) {
        const auto node = static_cast<int>(i % problem.nodes()), c = static_cast<int>(i / problem.nodes());
        const int X = x[static_cast<std::size_t>(node % nx)], Y = y[static_cast<std::size_t>(node / nx)];
        place_.push_back((isXInner ? Y * nx + X : X * ny + Y) * m + c);
        isHeld_.push_back(problem.isFixed(i));
    }
    isLine_ = ny == 1;
    const int apart = problem.isPeriodic() ? 2 : 1;
    const int reach = ny == 1 ? apart : isXInner ? 2 * nx + apart : apart * ny + 2;
    lu_ = BandLu(static_cast<int>(problem.size()), reach * m + m - 1);
    for (auto* v : {&F_, &delta_, &start_}) v->resize(problem.size());
}

bool CellNewton::factorise(const Equations& equations, const double* x) {
    lu_.clear();
    equations.matrix(
        x, [this](std::size_t i, std::size_t j, double value) { lu_.add(place_[i], place_[j], value); });
    for (std::size_t i = 0; i < place_.size(); ++i)
        if (isHeld_[i]) lu_.fix(place_[i]);
    isFactored_ = lu_.factorise() && isRegular(lu_.pivotRatio(), 1.0);
    return isFactored_;
}

void CellNewton::apply(double* b) {
    for (std::size_t i = 0; i < place_.size(); ++i)
        delta_[static_cast<std::size_t>(place_[i])] = isHeld_[i] ? 0 : b[i];
    lu_.solve(delta_.data());
    for (std::size_t i = 0; i < place_.size(); ++i) b[i] = delta_[static_cast<std::size_t>(place_[i])];
}

Outcome CellNewton::solve(const Equations& equations, double* x, const std::stop_token& stop,
                          StepReport& report) {
    constexpr int mostWithKept = 12, most = 50;
    const std::size_t size = place_.size();
    std::copy_n(x, size, start_.begin());
    if (isFactored_) {
        const Outcome found = attempt(equations, x, mostWithKept, true, stop, report);
        if (found == Outcome::converged || found == Outcome::stopped) return found;
        std::copy(start_.begin(), start_.end(), x);
    }
    isFactored_ = false;
    return attempt(equations, x, most, false, stop, report);
}

Outcome CellNewton::attempt(const Equations& equations, double* x, int most, bool isKept,
                            const std::stop_token& stop, StepReport& report) {
    // On a line new factors cost as much as a few corrections, over a rectangle as dozens.
    const double slow = isLine_ ? 0.01 : 0.2;
    const std::size_t size = place_.size();
    CorrectionLimits limits;
    limits.most = most;
    if (isKept) limits.slow = 1;
    int sinceFactors = 0;
    return solveByCorrections(limits, stop, report, [&](int iteration, double ratio) {
        equations.residual(x, F_.data());
        // A correction that leads out of the domain of L is taken back by halves. delta_ is in the order of
        // the band.
        for (int retreat = 0; iteration > 0 && !isFiniteEverywhere(F_) && retreat < mostRetreats; ++retreat) {
            for (std::size_t i = 0; i < size; ++i) {
                double& last = delta_[static_cast<std::size_t>(place_[i])];
                last /= 2;
                x[i] += last;
            }
            equations.residual(x, F_.data());
        }
        if (!isFiniteEverywhere(F_)) return Correction{.outcome = Outcome::notFinite};
        if (!isFactored_ || (sinceFactors >= 2 && ratio > slow)) {
            if (!factorise(equations, x)) return Correction{.outcome = Outcome::singular};
            ++report.cost.linearSolves;
            sinceFactors = 0;
        }
        ++sinceFactors;
        apply(F_.data());
        ++report.cost.linearSolves;
        double change = 0, scale = 0;
        for (std::size_t i = 0; i < size; ++i) {
            x[i] -= F_[i];
            change = std::max(change, std::abs(F_[i]));
            scale = std::max(scale, std::abs(x[i]));
            if (!std::isfinite(F_[i])) change = HUGE_VAL;
        }
        return Correction{change, scale};
    });
}

}  // namespace extremal
