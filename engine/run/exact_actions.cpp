// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/exact_actions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/core/line_fit.hpp"
#include "engine/family/family.hpp"
#include "engine/family/table_of.hpp"
#include "engine/solve/discrete_lagrangian.hpp"

namespace extremal {
namespace {

/// Positions of the exact motion at equal times from the start to h: nodes of a far finer run.
Eigen::MatrixXd exactPath(const System& system, const State& start, double h, const std::stop_token& stop) {
    constexpr int pieces = 16;
    const auto integrator = trustedIntegrator(system, start, h / pieces);
    integrator->setStop(stop);
    const int d = system.dimension();
    Eigen::MatrixXd path(d, pieces + 1);
    State state = start;
    for (int k = 0;; ++k) {
        path.col(k) = Eigen::Map<const Eigen::VectorXd>(state.x.data(), d);
        if (k == pieces) return path;
        if (advance(*integrator, state).outcome != Outcome::converged) return {};
    }
}

/// Slope over the longest stretch of fine points that are well above round-off: the five finest of these.
void fit(ActionDefect& result) {
    constexpr int mostPoints = 5;
    const auto n = static_cast<int>(result.h.size());
    result.fitTo = n;
    const auto at = [&](int i) { return static_cast<std::size_t>(i); };
    while (result.fitTo > 0 && result.defect[at(result.fitTo - 1)] < 100 * result.floor) --result.fitTo;
    result.fitFrom = std::max(0, result.fitTo - mostPoints);
    const int points = result.fitTo - result.fitFrom;
    if (points < 3) return;
    // Steps that are too long for the degree: the local slopes do not agree, and a mean of them says nothing.
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (int i = result.fitFrom + 1; i < result.fitTo; ++i) {
        const double slope = std::log(result.defect[at(i - 1)] / result.defect[at(i)]) /
                             std::log(result.h[at(i - 1)] / result.h[at(i)]);
        least = std::min(least, slope);
        most = std::max(most, slope);
    }
    if (most - least > 0.15 * most) return;
    std::vector<double> x, y;
    for (int i = result.fitFrom; i < result.fitTo; ++i) {
        x.push_back(std::log(result.h[at(i)]));
        y.push_back(std::log(result.defect[at(i)]));
    }
    result.order = lineThrough(x, y).slope;
}

}  // namespace

ExactActions::Entry ExactActions::at(int i, const std::stop_token& stop) {
    const std::lock_guard lock(mutex_);
    const auto index = static_cast<std::size_t>(i);
    if (entries_.size() <= index) entries_.resize(index + 1);
    if (entries_[index]) return *entries_[index];
    auto entry = std::make_unique<Entry>();
    entry->h = largest_ * std::pow(2.0, -0.5 * i);
    if (const Eigen::MatrixXd path = exactPath(system_, start_, entry->h, stop); path.size() > 0) {
        const auto exact =
            exactDiscreteLagrangian<double>(system_.mechanics(), start_.t, entry->h, path, 1e-15, stop);
        entry->isKnown = exact.outcome == Outcome::converged;
        entry->action = exact.action;
        entry->estimatedError = exact.estimatedError;
        entry->q0 = path.col(0);
        entry->q1 = path.col(path.cols() - 1);
    }
    if (stop.stop_requested()) return {};
    entries_[index] = std::move(entry);
    return *entries_[index];
}

ActionDefect actionDefect(const System& system, const Discretization& discretization, double startTime,
                          ExactActions& exact, const std::stop_token& stop) {
    constexpr int mostSteps = 20;
    ActionDefect result;
    const DiscreteLagrangian<double> Ld(system.mechanics(),
                                        tableOf(discretization.space, discretization.quadrature));
    for (int i = 0; i < mostSteps && !stop.stop_requested(); ++i) {
        const ExactActions::Entry known = exact.at(i, stop);
        if (!known.isKnown) continue;
        const auto found = Ld(startTime, known.h, known.q0, known.q1);
        if (found.outcome != Outcome::converged) continue;
        const double defect = std::abs(found.action - known.action);
        const double roundOff = 4 * std::numeric_limits<double>::epsilon() * std::abs(known.action);
        const double floor = std::max(roundOff, known.estimatedError);
        if (defect <= 4 * floor) break;
        result.h.push_back(known.h);
        result.defect.push_back(defect);
        result.floor = floor;
    }
    if (result.h.empty())
        result.failure = stop.stop_requested() ? "stopped" : "no step gave a defect above round-off";
    fit(result);
    return result;
}

}  // namespace extremal
