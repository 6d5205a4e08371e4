// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrators by what a table of costs varies: the step of a scheme, the tolerance of an adaptive one.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/system.hpp"

namespace extremal::bench {

using Make = std::function<std::unique_ptr<Integrator>(const System&, const State&, double setting)>;

inline Make schemeOf(const Discretization& discretization) {
    return [discretization](const System& s, const State& start, double h) {
        return makeIntegrator(s, discretization, {start.t, h});
    };
}

/// Free motions between kicks at the knots of a splitting.
inline Make freeMotion(const std::string& knots, const std::string& first = "") {
    Settings space{"free-motion", {{"knots", knots}}, {}};
    if (!first.empty()) space.keys.emplace_back("first", first);
    return schemeOf({space, {"auto", {}, {}}, {}});
}

/// Kepler arcs between kicks likewise.
inline Make keplerArcs(const std::string& knots) {
    return schemeOf({{"kepler-arcs", {{"knots", knots}}, {}}, {"auto", {}, {}}, {}});
}

/// A baseline by its id; the setting of an adaptive one is its tolerance.
inline Make baselineOf(const std::string& id, Value::Object keys = {}) {
    const BaselineEntry* entry = findBaseline(id);
    Settings settings{id, {}, {}};
    for (const auto& [key, value] : keys) settings.keys.emplace_back(key, value);
    return [entry, settings](const System& s, const State& start, double setting) {
        return entry->isAdaptive() ? entry->make(s, {0, start, setting, settings})
                                   : entry->make(s, {setting, start, 0, settings});
    };
}

}  // namespace extremal::bench
