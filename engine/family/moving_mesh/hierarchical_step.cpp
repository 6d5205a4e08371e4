// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/moving_mesh/hierarchical_step.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

HierarchicalStep::HierarchicalStep(const NodeSpace& space, const Monitor& monitor, double tolerance,
                                   int maxIterations)
    : space_(space),
      monitor_(monitor),
      values_(space, monitor, 1, 1, tolerance, maxIterations),
      mesh_(space.problem->mesh.left(), space.problem->mesh.length(), space.elements()),
      lu_(static_cast<int>(space.n), 1) {
    for (auto* each : {&X_, &y_, &nodes_, &load_}) each->assign(space_.n, 0);
    for (auto* each : {&M_, &own_}) each->assign(space_.elements(), 0);
}

/// The mesh of the step; false where it is the one there is.
bool HierarchicalStep::choose(const std::vector<double>& z, const std::vector<double>& v) {
    const std::size_t n = space_.n;
    for (std::size_t i = 0; i < n; ++i) {
        X_[i] = z[2 * i + 1];
        y_[i] = z[2 * i];
    }
    curvatures(X_.data(), y_.data(), n, u_xx_);
    for (std::size_t e = 0; e + 1 < n; ++e)
        own_[e] = monitor_((y_[e + 1] - y_[e]) / (X_[e + 1] - X_[e]), (u_xx_[e] + u_xx_[e + 1]) / 2,
                           (v[2 * e] + v[2 * e + 2]) / 2, 0);
    // Where a front is going to be in the next steps is beside where it is: the largest of three neighbours.
    for (std::size_t e = 0; e + 1 < n; ++e)
        M_[e] = std::max({own_[e > 0 ? e - 1 : 0], own_[e], own_[std::min(e + 1, n - 2)]});
    nodes_ = X_;
    mesh_.choose(X_, M_, nodes_);
    return nodes_ != X_;
}

void HierarchicalStep::factoriseMass() {
    const auto last = static_cast<int>(space_.n) - 1;
    lu_.clear();
    for (int e = 0; e < last; ++e) {
        const double h = nodes_[static_cast<std::size_t>(e) + 1] - nodes_[static_cast<std::size_t>(e)];
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b) lu_.add(e + a, e + b, a == b ? h / 3 : h / 6);
    }
    for (const int end : {0, last})
        if (space_.holdsValue(static_cast<std::size_t>(end))) lu_.fix(end);
    (void)lu_.factorise();  // a mass is regular
}

/// f at the new nodes from f at the old ones, entries 2 i of its argument: the best approximation of the
/// function.
void HierarchicalStep::project(std::vector<double>& f) {
    const std::size_t n = space_.n;
    std::fill(load_.begin(), load_.end(), 0.0);
    std::size_t old = 0;
    for (std::size_t e = 0; e + 1 < n; ++e) {
        const double a = nodes_[e], b = nodes_[e + 1];
        // Simpson's rule is exact between two nodes of either mesh.
        for (double x = a; x < b;) {
            while (old + 2 < n && X_[old + 1] <= x) ++old;
            const double to = std::min(b, X_[old + 1]), middle = (x + to) / 2;
            const auto value = [&](double at) {
                const double xi = (at - X_[old]) / (X_[old + 1] - X_[old]);
                return (1 - xi) * f[2 * old] + xi * f[2 * old + 2];
            };
            const double w = (to - x) / 6;
            for (const auto& [at, weight] : {std::pair{x, w}, std::pair{middle, 4 * w}, std::pair{to, w}}) {
                const double xi = (at - a) / (b - a), part = weight * value(at);
                load_[e] += (1 - xi) * part;
                load_[e + 1] += xi * part;
            }
            x = to;
        }
    }
    for (const std::size_t end : {std::size_t{0}, n - 1})
        if (space_.holdsValue(end)) load_[end] = f[2 * end];
    lu_.solve(load_.data());
    for (std::size_t i = 0; i < n; ++i) f[2 * i] = load_[i];
}

Outcome HierarchicalStep::advance(std::vector<double>& z, std::vector<double>& v, double h,
                                  StepReport& report, const std::stop_token& stop) {
    if (choose(z, v)) {
        factoriseMass();
        project(z);
        project(v);
        report.cost.linearSolves += 3;
        for (std::size_t i = 0; i < space_.n; ++i) {
            z[2 * i + 1] = nodes_[i];
            v[2 * i + 1] = 0;
        }
    }
    return values_.advanceAtRest(z, v, h, report, stop);
}

}  // namespace extremal
