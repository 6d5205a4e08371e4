// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/adaptive_method.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/mechanism/driven_flow.hpp"

namespace extremal {

AdaptiveMethod::AdaptiveMethod(const Mechanics<double>& m)
    : AdaptiveMethod(
          [m](double t, const double* x, double* dx) {
              return m.flow(m.model.get(), t, x, x + m.dimension, dx, dx + m.dimension);
          },
          static_cast<std::size_t>(2 * m.dimension)) {
    if (!isDriven(m)) jacobian_.emplace(m);
}

AdaptiveMethod::AdaptiveMethod(Rate rate, std::size_t n)
    : rate_(std::move(rate)), before_(n, 0.0), x_(n, 0.0) {}

bool AdaptiveMethod::variationalFlow(double t, const double* y, double* dy, std::size_t size) {
    const std::size_t n = before_.size();
    if (!flow(t, y, dy)) return false;
    velocity_.assign(dy, dy + n / 2);
    for (double& v : velocity_) v *= ahead_;
    const Eigen::MatrixXd& jacobian = jacobian_->evaluate(ahead_ * t, y, y + n / 2, velocity_.data());
    const auto rows = static_cast<Eigen::Index>(n), columns = static_cast<Eigen::Index>(size / n) - 1;
    Eigen::Map<Eigen::MatrixXd>(dy + n, rows, columns).noalias() =
        ahead_ * jacobian.lazyProduct(Eigen::Map<const Eigen::MatrixXd>(y + n, rows, columns));
    return true;
}

void AdaptiveMethod::begin(State& state) {
    state.memory.assign(1, 0);
    hasStepped_ = false;
}

StepReport AdaptiveMethod::advance(State& state, double until) {
    StepReport report;
    if (state.memory.empty()) begin(state);
    const double ahead = until < state.t ? -1 : 1;
    const bool isContinued = hasStepped_ && ahead == ahead_ && ahead * state.t == endTime_ && state.x == x_;
    ahead_ = ahead;
    end_ = ahead * until;
    before_ = x_ = state.x;
    startTime_ = ahead * state.t;
    double t = startTime_, next = state.memory[0];
    hasStepped_ = false;
    report.outcome = take(t, x_, next, report, isContinued);
    if (report.outcome == Outcome::converged &&
        !std::all_of(x_.begin(), x_.end(), [](double v) { return std::isfinite(v); }))
        report.outcome = Outcome::notFinite;
    if (report.outcome != Outcome::converged) return report;
    hasStepped_ = true;
    state.x = x_;
    state.memory[0] = next;
    endTime_ = t;
    state.t = ahead * t;
    ++state.node;
    report.step = ahead * (endTime_ - startTime_);
    return report;
}

double AdaptiveMethod::firstStep(double t, const Vector& x) const {
    Vector dx(x.size());
    flow(t, x.data(), dx.data());
    double length = 0, rate = 0;
    for (std::size_t i = 0; i < dx.size(); ++i) {
        length = std::max(length, std::abs(x[i]));
        rate = std::max(rate, std::abs(dx[i]));
    }
    const double cap = (end_ - t) / 100;
    return rate > 0 && length > 0 && std::isfinite(rate) ? std::min(cap, 1e-3 * length / rate) : cap * 1e-3;
}

void refuseWithout(const std::string& baseline, const std::string& library, const std::string& package) {
    throw InvalidScene("/baseline",
                       baseline + " needs " + library + ", which was missing when this program was built",
                       "install the package " + package + " and build again");
}

}  // namespace extremal
