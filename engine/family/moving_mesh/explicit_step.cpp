// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/moving_mesh/explicit_step.hpp"

#include <algorithm>
#include <cmath>

#include "engine/solve/newton_policy.hpp"

namespace extremal {

ExplicitStep::ExplicitStep(const NodeSpace& space, const Monitor& monitor, double relaxation,
                           double speedLimit, double tolerance, int maxIterations)
    : space_(space),
      monitor_(monitor),
      relaxation_(relaxation),
      speedLimit_(speedLimit),
      tolerance_(tolerance),
      maxIterations_(maxIterations),
      action_(space),
      lu_(static_cast<int>(space.n), 1) {
    const std::size_t n = space_.n;
    for (auto* each : {&z1_, &v1_, &p0_}) each->assign(2 * n, 0);
    for (auto* each : {&y_, &residual_, &X_, &equal_}) each->assign(n, 0);
    M_.assign(n - 1, 0);
}

void ExplicitStep::moveMesh(const std::vector<double>& z, const std::vector<double>& v, double h) {
    const std::size_t n = space_.n;
    for (std::size_t i = 0; i < n; ++i) {
        X_[i] = z[2 * i + 1];
        y_[i] = z[2 * i];
    }
    curvatures(X_.data(), y_.data(), n, u_xx_);
    for (std::size_t e = 0; e + 1 < n; ++e) {
        const double s = (y_[e + 1] - y_[e]) / (X_[e + 1] - X_[e]);
        const double speed = (v[2 * e + 1] + v[2 * e + 3]) / 2;
        M_[e] = monitor_(s, (u_xx_[e] + u_xx_[e + 1]) / 2, (v[2 * e] + v[2 * e + 2]) / 2 - s * speed, speed);
    }
    smoothDensity(M_);
    equidistribute(X_, M_, equal_);
    double farthest = 0;
    for (std::size_t i = 0; i < n; ++i) farthest = std::max(farthest, std::abs(equal_[i] - X_[i]));
    // Nodes that are faster than waves turn the sign of the gradient's part of the action: they are held to
    // a speed below.
    const double part = std::min({1.0, std::abs(h) / relaxation_, speedLimit_ * std::abs(h) / farthest});
    for (std::size_t i = 0; i < n; ++i) {
        const double move = space_.isEnd(i) ? 0 : part * (equal_[i] - X_[i]);
        z1_[2 * i + 1] = X_[i] + move;
        v1_[2 * i + 1] = move / h;
    }
}

/// u + h u_t at the new places, u_t from the rates of the nodes.
void ExplicitStep::guess(const std::vector<double>& z, const std::vector<double>& v, double h) {
    const std::size_t n = space_.n;
    std::size_t e = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = z1_[2 * i + 1];
        while (e + 2 < n && z[2 * e + 3] < x) ++e;
        const double length = z[2 * e + 3] - z[2 * e + 1], xi = (x - z[2 * e + 1]) / length;
        const double s = (z[2 * e + 2] - z[2 * e]) / length;
        const double left = v[2 * e] - s * v[2 * e + 1], right = v[2 * e + 2] - s * v[2 * e + 3];
        z1_[2 * i] = space_.holdsValue(i)
                         ? z[2 * i]
                         : (1 - xi) * (z[2 * e] + h * left) + xi * (z[2 * e + 2] + h * right);
    }
}

void ExplicitStep::evaluate(const std::vector<double>& z0, double h, bool withJacobian, Cost& cost) {
    if (withJacobian) lu_.clear();
    action_.evaluate(z0, z1_, h, withJacobian, cost,
                     [this](std::size_t e, std::size_t a, std::size_t b, double value) {
                         if (a % 2 == 0 && b % 2 == 0)  // the values alone are unknown
                             lu_.add(static_cast<int>(e + a / 2), static_cast<int>(e + b / 2), value);
                     });
    for (std::size_t i = 0; i < space_.n; ++i) residual_[i] = p0_[2 * i] + action_.atStart(2 * i, h);
}

Outcome ExplicitStep::solve(const std::vector<double>& z0, double h, StepReport& report,
                            const std::stop_token& stop) {
    const std::size_t n = space_.n;
    NewtonPolicy<double> policy(
        NewtonLimits<double>::elementStep(std::max(tolerance_, std::numeric_limits<double>::epsilon())));
    for (int iteration = 0; iteration < maxIterations_; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        evaluate(z0, h, true, report.cost);
        for (const std::size_t i : {std::size_t{0}, n - 1})
            if (space_.holdsValue(i)) {
                lu_.fix(static_cast<int>(i));
                residual_[i] = 0;
            }
        if (!lu_.factorise()) return Outcome::singular;
        policy.jacobianIsNew();
        lu_.solve(residual_.data());
        ++report.cost.iterations;
        report.cost.linearSolves += 2;
        double largest = 0, increments = 0, value = 0;
        for (std::size_t i = 0; i < n; ++i) {
            double& y = z1_[2 * i];
            y -= residual_[i];
            if (!(std::abs(residual_[i]) <= largest)) largest = std::abs(residual_[i]);
            increments = std::max(increments, std::abs(y - z0[2 * i]));
            value = std::max(value, std::abs(y));
        }
        report.residual = relativeCorrection(largest, increments, value);
        if (const auto end = endOf(policy.judge(report.residual))) return *end;
    }
    return Outcome::diverged;
}

Outcome ExplicitStep::advance(std::vector<double>& z, std::vector<double>& v, double h, StepReport& report,
                              const std::stop_token& stop) {
    moveMesh(z, v, h);
    return advanceValues(z, v, h, report, stop);
}

Outcome ExplicitStep::advanceAtRest(std::vector<double>& z, std::vector<double>& v, double h,
                                    StepReport& report, const std::stop_token& stop) {
    for (std::size_t i = 0; i < space_.n; ++i) {
        z1_[2 * i + 1] = z[2 * i + 1];
        v1_[2 * i + 1] = 0;
    }
    return advanceValues(z, v, h, report, stop);
}

/// Of values, where the new places and their rates are known.
Outcome ExplicitStep::advanceValues(std::vector<double>& z, std::vector<double>& v, double h,
                                    StepReport& report, const std::stop_token& stop) {
    const std::size_t n = space_.n;
    space_.momentum(z.data(), v.data(), p0_);
    guess(z, v, h);
    const Outcome outcome = solve(z, h, report, stop);
    if (outcome != Outcome::converged) return outcome;
    evaluate(z, h, false, report.cost);
    slabEnergy_ = action_.energy();
    // y' from the new p_y = (M v)_y with X' of this step
    lu_.clear();
    for (std::size_t i = 0; i < n; ++i) residual_[i] = action_.atEnd(2 * i, h);
    ElementDerivatives::Matrix mass;
    for (std::size_t e = 0; e + 1 < n; ++e) {
        elementMass(z1_.data() + 2 * e, mass);
        for (std::size_t a = 0; a < 4; a += 2) {
            for (std::size_t b = 0; b < 4; b += 2) {
                lu_.add(static_cast<int>(e + a / 2), static_cast<int>(e + b / 2), mass[a][b]);
                residual_[e + a / 2] -= mass[a][b + 1] * v1_[2 * e + b + 1];
            }
        }
    }
    for (const std::size_t i : {std::size_t{0}, n - 1})
        if (space_.holdsValue(i)) {
            lu_.fix(static_cast<int>(i));
            residual_[i] = 0;
        }
    if (!lu_.factorise()) return Outcome::singular;
    lu_.solve(residual_.data());
    report.cost.linearSolves += 2;
    for (std::size_t i = 0; i < n; ++i) v1_[2 * i] = residual_[i];
    z.swap(z1_);
    v.swap(v1_);
    return Outcome::converged;
}

}  // namespace extremal
