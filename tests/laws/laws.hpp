// SPDX-License-Identifier: GPL-3.0-or-later
/// What the laws share: systems by name, every scheme and baseline of the catalogues, end states.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/system.hpp"
#include "tests/tools/slope.hpp"

namespace extremal::laws {

inline System systemNamed(const std::string& id, Value::Object overrides = {}) {
    const ModelEntry* entry = findModel(id);
    Settings settings;
    settings.type = id;
    for (const FieldInfo& f : entry->item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    for (auto& [key, value] : overrides)
        for (auto& member : settings.keys)
            if (member.first == key) member.second = value;
    return entry->make(settings);
}

/// A scheme under test: its name, what it claims, and how to make it.
struct Case {
    std::string name;
    Claims claims;
    std::function<std::unique_ptr<Integrator>(const System&, const Clock&)> make;
    bool isPair = false;
};

/// The keys of a baseline with their defaults, or the examples of those that have none.
inline Settings defaultsOf(const CatalogItem& item) {
    Settings settings;
    settings.type = item.id;
    for (const FieldInfo& f : item.parameters)
        if (!f.firstValue().isNull()) settings.keys.emplace_back(f.key, f.firstValue());
    return settings;
}

/// The default keys; of a baseline with a number of stages, those with 1 to maxStages.
inline std::vector<Settings> variantsOf(const CatalogItem& item, int maxStages) {
    const Settings defaults = defaultsOf(item);
    if (!defaults.find("stages")) return {defaults};
    std::vector<Settings> all(static_cast<std::size_t>(maxStages), defaults);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (auto& [key, value] : all[i].keys)
            if (key == "stages") value = static_cast<double>(i + 1);
    return all;
}

/// Every discretization of the scheme catalogue up to the given degree, and every fixed-step baseline, that
/// fit the system. Experiments that come with a caution promise nothing.
inline std::vector<Case> everyScheme(int maxDegree, const System& system = systemNamed("kepler")) {
    std::vector<Case> cases;
    std::vector<Discretization> known;  // some names are of the same discretization
    for (const SchemeEntry& e : schemeCatalog()) {
        const int low = e.maxDegree == 0 ? 0 : e.minDegree,
                  high = e.maxDegree == 0 ? 0 : std::min(maxDegree, e.maxDegree);
        for (int degree = low; degree <= high; ++degree) {
            const Discretization discretization = e.make(degree);
            // Times that are unknowns have laws of their own (moving_times_test.cpp).
            if (timeGridOf(discretization.space) != TimeGrid::fixed) continue;
            if (!isFor(discretization, system) ||
                std::find(known.begin(), known.end(), discretization) != known.end() ||
                !describe(discretization.space, discretization.quadrature).caution.empty())
                continue;
            known.push_back(discretization);
            std::string name = e.item.id;
            if (const auto at = name.find('<'); at != std::string::npos)
                name = name.substr(0, at) + std::to_string(degree);
            cases.push_back({name, describe(discretization.space, discretization.quadrature).claims,
                             [discretization](const System& s, const Clock& c) {
                                 return makeIntegrator(s, discretization, c);
                             },
                             true});
        }
    }
    for (const BaselineEntry& e : baselineCatalog()) {
        if (e.grid != TimeGrid::fixed || !appliesTo(e, system)) continue;
        for (const Settings& keys : variantsOf(e.item, maxDegree)) {
            const std::string stages =
                keys.find("stages") ? "-" + std::to_string(keys.integer("stages")) : "";
            cases.push_back({e.item.id + stages, claimsOf(e, keys),
                             [make = e.make, keys](const System& s, const Clock& c) {
                                 return make(s, {c.step, {c.start, 0, {}, {}}, 0, keys});
                             }});
        }
    }
    return cases;
}

inline Discretization polynomialPair(int degree, Settings quadrature, const std::string& basis = "lobatto") {
    Discretization discretization;
    discretization.space = {"polynomial", {{"degree", static_cast<double>(degree)}, {"basis", basis}}, {}};
    discretization.quadrature = completeQuadrature(discretization.space, quadrature);
    return discretization;
}

inline Discretization splinePair(int degree, int cells, Settings quadrature) {
    Discretization discretization;
    discretization.space = {
        "spline", {{"degree", static_cast<double>(degree)}, {"cells", static_cast<double>(cells)}}, {}};
    discretization.quadrature = completeQuadrature(discretization.space, quadrature);
    return discretization;
}

/// The state after n steps, or nothing if one failed.
inline std::optional<State> after(Integrator& integrator, State state, long long n) {
    for (long long k = 0; k < n; ++k)
        if (advance(integrator, state).outcome != Outcome::converged) return {};
    return state;
}

inline double distance(const std::vector<double>& a, const std::vector<double>& b, std::size_t from,
                       std::size_t to) {
    double sum = 0;
    for (std::size_t i = from; i < to; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

/// A star and two planets in a plane, of masses 1, `second` and 2/5 of it, x and y of one after the other.
inline System planets(double second = 0.05) {
    return systemNamed("lagrangian",
                       {{"coordinates", Value(Value::Array{"x0", "y0", "x1", "y1", "x2", "y2"})},
                        {"parameters", Value(Value::Object{{"m", second}, {"n", 0.4 * second}})},
                        {"lagrangian",
                         "(x0_t^2 + y0_t^2)/2 + m/2*(x1_t^2 + y1_t^2) + n/2*(x2_t^2 + y2_t^2) + "
                         "m/sqrt((x1-x0)^2 + (y1-y0)^2) + n/sqrt((x2-x0)^2 + (y2-y0)^2) + "
                         "m*n/sqrt((x2-x1)^2 + (y2-y1)^2)"}});
}

inline const State keplerStart{0, 0, {0.4, 0, 0, 2}};

}  // namespace extremal::laws
