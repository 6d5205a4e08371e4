// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/inside_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/view/axes.hpp"
#include "engine/view/plane.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostPoints = 20000;

constexpr long long fewSteps = 500, mostSteps = 4000;

/// Points inside a step: enough for a smooth curve, none where steps are too many.
int pointsPerStep(bool isUnplanned, long long steps) {
    constexpr long long points = 2000;
    if (isUnplanned) return 8;
    return steps > mostSteps ? 0 : static_cast<int>(std::clamp(points / std::max(1LL, steps), 4LL, 40LL));
}

constexpr double pointsPerPeriod = 16;

/// Points in the part of the time axis that a view shows: enough for some tens of oscillations.
constexpr double pointsPerPart = 1000;

}  // namespace

void appendState(Trajectory& trajectory, double t, const std::vector<double>& x, std::size_t width) {
    trajectory.columns[0].values.push_back(t);
    for (std::size_t c = 0; c < width; ++c) trajectory.columns[c + 1].values.push_back(x[c]);
}

std::vector<Column> leadingColumns(const System& system) {
    std::vector<Column> columns{{"t", system.independent, system.timeUnit, {}, {}}};
    for (const Quantity& c : stateColumns(system)) columns.push_back({c.name, c.symbol, c.unit, {}, {}});
    return columns;
}

InsideStep::InsideStep(SchemeResult& result, const Scene& scene, const ProductPlan& plan,
                       const System& system, bool isUnplanned, long long steps, Observer error)
    : result_(result), error_(std::move(error)), steps_(steps) {
    if (plan.has(Product::denseOutput) || plan.has(Product::denseError))
        points_ = pointsPerStep(isUnplanned, steps);
    isSelective_ = !isUnplanned && steps > fewSteps && !error_.evaluate;
    const std::vector<Column> columns = leadingColumns(system);
    width_ = columns.size() - 1;
    for (const View& view : scene.views) {
        if (!needs(view, Product::sections)) continue;
        const std::string name = planeOf(view, system).value_or(ViewPlane{}).at;
        const auto found =
            std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name == name; });
        if (found == columns.end() || found == columns.begin()) continue;
        auto& all = result_.products.make<Sections>().all;
        sections_.push_back({static_cast<std::size_t>(found - columns.begin()) - 1, all.size()});
        all.push_back({name, {columns}});
    }
    if (points_ == 0) return;
    for (const View& view : scene.views)
        if (view.xRange && axesOf(view, system).variable == system.independent)
            parts_.emplace_back(view.xRange->low.value, view.xRange->high.value);
    Trajectory& points = result_.products.make<DenseOutput>().points;
    points.columns = columns;
    if (!error_.evaluate) return;
    errorValues_.resize(error_.columns.size());
    points.columns.push_back(error_.columns.front());
}

void InsideStep::start(const State& state) {
    at_ = state;
    if (points_ == 0) return;
    keep(state, {});
    if (!isSelective_) return;
    low_.assign(state.x.begin(), state.x.begin() + static_cast<std::ptrdiff_t>(width_));
    high_ = low_;
}

/// Whether some entry of the state leaves the chord of the step, in its middle, by a share of the range that
/// this entry has had.
bool InsideStep::isCurved(const Integrator& integrator, const State& before, const State& after) {
    constexpr double share = 0.01;
    integrator.denseOutput(0.5, at_.x);
    bool isCurved = false;
    for (std::size_t c = 0; c < width_; ++c) {
        low_[c] = std::min({low_[c], at_.x[c], after.x[c]});
        high_[c] = std::max({high_[c], at_.x[c], after.x[c]});
        const double deviation = std::abs(at_.x[c] - (before.x[c] + after.x[c]) / 2);
        isCurved = isCurved || deviation > share * (high_[c] - low_[c]);
    }
    return isCurved;
}

/// More points where the curve oscillates, and in steps that belong to a part that is shown.
int InsideStep::pointsIn(double start, double end, double periods, double least) const {
    const double first = std::min(start, end), last = std::max(start, end);
    double most = least;
    if (const double all = pointsPerPeriod * periods; all * static_cast<double>(steps_) <= mostPoints)
        most = std::max(most, all);
    for (const auto& [low, high] : parts_)
        if (first < high && last > low)
            most = std::max(most, pointsPerPart * std::min(1.0, (last - first) / (high - low)));
    return static_cast<int>(std::ceil(most));
}

void InsideStep::look(const Integrator& integrator, const State& before, const State& after,
                      const StepReport& report) {
    if (!sections_.empty()) cross(integrator, before, after);
    if (points_ == 0) return;
    const double periods = integrator.periodsPerStep();
    const double least = isSelective_ && !isCurved(integrator, before, after) ? 1 : points_;
    const int points = pointsIn(before.t, after.t, periods, least);
    // Equal distances would turn an oscillation that they do not resolve into a slower one: unequal ones fill
    // its band.
    const bool isUneven = points < pointsPerPeriod * periods;
    const double golden = (std::sqrt(5.0) - 1) / 2;
    for (int j = 1; j <= points; ++j) {
        const double place = isUneven ? j - std::fmod(j * golden, 1.0) : j, tau = place / points;
        at_.t = j < points ? before.t + tau * (after.t - before.t) : after.t;
        if (j < points)
            integrator.denseOutput(tau, at_.x);
        else
            at_.x = after.x;
        keep(at_, report);
    }
    if (result_.products.make<DenseOutput>().points.rows() <= mostPoints) return;
    result_.products.drop<DenseOutput>();  // an adaptive code with many steps: its rows are dense
    points_ = 0;
}

void InsideStep::keep(const State& at, const StepReport& report) {
    Trajectory& curve = result_.products.make<DenseOutput>().points;
    appendState(curve, at.t, at.x, width_);
    if (!error_.evaluate) return;
    error_.evaluate(NodeBlock(at, report), errorValues_.data(), errorValues_.size());
    curve.columns.back().values.push_back(errorValues_.front());
}

void InsideStep::cross(const Integrator& integrator, const State& before, const State& after) {
    samples_.begin(integrator, after.x.size());
    const double noise = roundingOf(after.x);
    const bool isForwards = after.t > before.t;  // upwards in t: one section for both ways
    for (const Section& section : sections_) {
        Trajectory& events = result_.products.make<Sections>().all[section.index].events;
        const auto value = [&](double tau) { return samples_.at(tau)[section.column]; };
        for (const Crossing& crossing : finder_.find(before.x[section.column], after.x[section.column],
                                                     samples_.places(), value, noise)) {
            if (crossing.isUpwards != isForwards || events.rows() >= mostPoints) continue;
            integrator.denseOutput(crossing.tau, at_.x);
            appendState(events, before.t + crossing.tau * (after.t - before.t), at_.x, width_);
        }
    }
}

}  // namespace extremal
