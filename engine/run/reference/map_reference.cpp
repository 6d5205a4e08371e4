// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/map_reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/run/march/march.hpp"
#include "engine/run/reference/shared_solution.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/two_positions.hpp"

namespace extremal {

MapReference::MapReference(const ResolvedScene& resolved, const std::vector<double>& steps,
                           const std::stop_token& stop) {
    const Scene& scene = resolved.scene;
    const State& initial = resolved.initial;
    double nodes = 0;
    for (const double step : steps) nodes += (scene.end.value - scene.start.value) / step + 1;
    const bool isSmall = SharedSolution::isSmall(nodes, initial.x.size());
    if (scene.reference.kind == ReferenceSpec::Kind::scheme && resolved.reference.front().isFixed() &&
        isSmall) {
        runScheme(resolved, steps, stop);
        return;
    }
    reference_ = makeReference(resolved, stop);
    constexpr double mostNodes = 2e6;  // of which many are the same
    if (reference_.make && reference_.info.type != "exact" && nodes <= mostNodes) share(resolved, steps);
}

void MapReference::runScheme(const ResolvedScene& resolved, const std::vector<double>& steps,
                             const std::stop_token& stop) {
    const Scene& scene = resolved.scene;
    const State& initial = resolved.initial;
    const ResolvedScheme& scheme = resolved.reference.front();
    for (const double step : steps) {
        if (stop.stop_requested()) return;
        const auto nodes = static_cast<std::size_t>(stepCount(scene.start.value, scene.end.value, step)) + 1;
        const double parts = std::max(1.0, std::ceil(step / scheme.spec.step.value - 1e-9)),
                     part = step / parts;
        State state = schemeStart(resolved, scheme, part);
        const std::size_t width = state.x.size();
        auto table = std::make_shared<Table>(Table{initial.t, step, width, {}});
        const auto integrator = scheme.make(*resolved.system, part, state);
        const auto every = static_cast<long long>(parts);
        const MarchSink collect{[&](const Stretch& stretch) {
            for (std::size_t i = 0; i < stretch.nodes.size(); ++i)
                if (stretch.nodes.node(i) % every == 0)
                    table->states.insert(table->states.end(), stretch.nodes.x(i), stretch.nodes.x(i) + width);
            return true;
        }};
        MarchGrid grid;
        grid.clock = {initial.t, part};
        grid.steps = static_cast<long long>(nodes - 1) * every;
        if (march(*integrator, state, grid, {&collect, 1}, stop).outcome != Outcome::converged)
            table->states.assign(nodes * width, std::numeric_limits<double>::quiet_NaN());
        tables_.push_back(std::move(table));
    }
}

void MapReference::share(const ResolvedScene& resolved, const std::vector<double>& steps) {
    const Scene& scene = resolved.scene;
    const State& initial = resolved.initial;
    std::vector<double> times;
    for (const double step : steps)
        for (long long k = 0; k <= stepCount(scene.start.value, scene.end.value, step); ++k)
            times.push_back(Clock{initial.t, step}.at(k));
    isShared_ = reference_.share(std::move(times), initial.x.size(), resolved.system);
}

ExactSolution MapReference::at(std::size_t row, const ResolvedScene& resolved,
                               const ResolvedScheme& scheme) const {
    Reference table;
    if (row < tables_.size()) {
        table.info = reference_.info;
        table.make = [solution = atNodes(row)] { return solution; };
    }
    const Reference own = referenceFor(table.make ? table : reference_, resolved, scheme);
    return own.make ? own.make() : ExactSolution{};
}

ExactSolution MapReference::atNodes(std::size_t row) const {
    return [table = tables_[row]](double t, std::span<double> x) {
        const auto node = static_cast<std::size_t>(std::llround((t - table->start) / table->step));
        const auto from = table->states.begin() + static_cast<std::ptrdiff_t>(node * table->width);
        std::copy_n(from, table->width, x.begin());
    };
}

}  // namespace extremal
