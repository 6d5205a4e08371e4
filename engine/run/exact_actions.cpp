// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/exact_actions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/core/algebra/line_fit.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/solve/discrete_lagrangian.hpp"

namespace extremal {
namespace {

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

constexpr int mostLengths = 20;

/// Both actions after step i of the sequence; h is 0 where they are not known.
struct DefectPoint {
    double h = 0;
    ActionPair action = {};
};

/// From the longest step down to the first whose defect is round-off.
ActionDefect defectOf(const std::function<DefectPoint(int i)>& at, const std::stop_token& stop) {
    ActionDefect result;
    bool isKnown = false;
    for (int i = 0; i < mostLengths && !stop.stop_requested(); ++i) {
        const auto [h, action] = at(i);
        if (!(h > 0)) continue;
        isKnown = true;
        const double defect = std::abs(action.discrete - action.exact);
        const double roundOff = 4 * std::numeric_limits<double>::epsilon() * std::abs(action.exact);
        const double floor = std::max(roundOff, action.error);
        if (defect <= 4 * floor) break;
        result.h.push_back(h);
        result.defect.push_back(defect);
        result.floor = floor;
    }
    if (result.h.empty())
        result.failure = stop.stop_requested() ? "stopped"
                         : isKnown             ? "no step gave a defect above round-off"
                                               : "no step has a motion from the start whose action is known";
    fit(result);
    return result;
}

}  // namespace

ExactActions::ExactActions(const System& system, const State& start, double largest)
    : system_(system), start_(start), largest_(largest) {
    auto local = localCoordinates(system, start);
    if (!local) throw std::invalid_argument("no coordinates in which a step has an action of its own");
    local_ = std::move(*local);
}

/// Positions of the exact motion at equal times from the start to h: nodes of a far finer run.
Eigen::MatrixXd ExactActions::path(double h, const std::stop_token& stop) const {
    constexpr int pieces = 16;
    const auto integrator = trustedIntegrator(system_, start_, h / pieces);
    integrator->setStop(stop);
    Eigen::MatrixXd path(local_.mechanics.dimension, pieces + 1);
    State state = start_;
    for (int k = 0;; ++k) {
        path.col(k) = local_.position(state);
        if (k == pieces) return path;
        if (advance(*integrator, state).outcome != Outcome::converged) return {};
    }
}

ExactActions::Entry ExactActions::at(int i, const std::stop_token& stop) {
    const std::lock_guard lock(mutex_);
    const auto index = static_cast<std::size_t>(i);
    if (entries_.size() <= index) entries_.resize(index + 1);
    if (entries_[index]) return *entries_[index];
    auto entry = std::make_unique<Entry>();
    entry->h = largest_ * std::pow(2.0, -0.5 * i);
    if (const Eigen::MatrixXd path = this->path(entry->h, stop); path.size() > 0) {
        const auto exact =
            exactDiscreteLagrangian<double>(local_.mechanics, start_.t, entry->h, path, 1e-15, stop);
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
    const auto& functions = equationsOf(discretization).functions;
    return defectOf(
        [&](int i) -> DefectPoint {
            const ExactActions::Entry known = exact.at(i, stop);
            if (!known.isKnown) return {};
            const DiscreteLagrangian<double> Ld(
                exact.mechanics(), functions.make({system, discretization, exact.start(), known.h}));
            const auto found = Ld(startTime, known.h, known.q0, known.q1);
            if (found.outcome != Outcome::converged) return {};
            return {known.h, {found.action, known.action, known.estimatedError}};
        },
        stop);
}

ActionDefect actionDefect(const StepCase& step, const std::stop_token& stop) {
    const ActionPairs pairs = equationsOf(step.discretization).actions.make(step);
    return defectOf(
        [&](int i) -> DefectPoint {
            const double h = step.step * std::pow(2.0, -0.5 * i);
            const auto pair = pairs(h, stop);
            return pair ? DefectPoint{h, *pair} : DefectPoint{};
        },
        stop);
}

}  // namespace extremal
