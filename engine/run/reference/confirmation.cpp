// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/confirmation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/run/march/march.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {

double Confirmation::judgedTo(double error) const {
    double t = parts.front().t;
    for (const Part& part : parts) {
        if (safety * part.distance > error) break;
        t = part.t;
    }
    return t;
}

Confirmation confirm(const ResolvedScene& scene, const ExactSolution& reference, const DistanceOf& distance,
                     const std::stop_token& stop) {
    constexpr double tolerance = 1e-13, fewParts = 400;
    constexpr long long mostSteps = 200'000;
    const System& system = *scene.system;
    if (!system.hasCoordinates() || system.error.evaluate) return {};
    const ErrorMeasure measure = errorMeasure(system, scene.initial);
    const double every = timeSpan(scene.scene).length() / fewParts;
    for (const char* id : {"rk8pd", "fehlberg78"}) {
        const BaselineEntry* const entry = findBaseline(id);
        if (!entry || !canIntegrate(*entry, system)) continue;
        std::unique_ptr<Integrator> integrator;
        try {
            BaselineOptions options;
            options.start = scene.initial;
            options.tolerance = tolerance;
            integrator = entry->make(system, options);
        } catch (const InvalidScene&) {
            continue;  // its library is not there
        }
        Confirmation found{entry->item.title, {{scene.initial.t, 0}}};
        std::vector<double> exact(scene.initial.x.size()), values(measure.columns.size());
        double most = 0;
        const MarchSink compare{[&](const Stretch& stretch) {
            for (std::size_t i = 0; i < stretch.nodes.size(); ++i) {
                const double t = stretch.nodes.t(i);
                reference(t, exact);
                measure.evaluate(stretch.nodes.x(i), exact.data(), values.data());
                const double d = distance(values);
                if (!(d <= most)) most = std::isfinite(d) ? d : HUGE_VAL;
                if (std::abs(t - found.parts.back().t) >= every) found.parts.push_back({t, most});
            }
            return true;
        }};
        MarchGrid grid;
        grid.end = scene.scene.end.value;
        grid.isBackwards = isBackwards(scene.scene);
        grid.budget = mostSteps;
        State state = scene.initial;
        const MarchReport report = march(*integrator, state, grid, {&compare, 1}, stop);
        if (stop.stop_requested()) return {};
        if (report.outcome != Outcome::converged) continue;
        found.parts.push_back({state.t, most});
        return found;
    }
    return {};
}

}  // namespace extremal
