// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/switches.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/family/parts/parameter_switching.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/switched_step.hpp"

namespace extremal {
namespace {

/// The first of the conditions of two parts whose values differ at some places; empty: they are the same.
template <class Part>
std::string firstChanged(const System& a, const System& b) {
    const Part* const one = a.parts.find<Part>();
    const Part* const other = b.parts.find<Part>();
    if (!one || !other) return {};
    const auto n = static_cast<std::size_t>(one->count()), d = static_cast<std::size_t>(a.dimension());
    std::vector<double> q(d), first(n), second(n), byPlace(n * d), byTime(n);
    for (int trial = 1; trial <= 4; ++trial) {
        for (std::size_t i = 0; i < d; ++i) q[i] = std::sin(1.3 * trial + 0.7 * static_cast<double>(i)) + 0.1;
        const double t = 0.37 * trial;
        one->first(one->model.get(), t, q.data(), first.data(), byPlace.data(), byTime.data());
        other->first(other->model.get(), t, q.data(), second.data(), byPlace.data(), byTime.data());
        for (std::size_t k = 0; k < n; ++k)
            if (std::abs(first[k] - second[k]) > 1e-12 * (std::abs(first[k]) + std::abs(second[k])))
                return one->names[k];
    }
    return {};
}

bool haveSameState(const System& a, const System& b) {
    const std::vector<Quantity> first = stateColumns(a), second = stateColumns(b);
    return std::equal(first.begin(), first.end(), second.begin(), second.end(),
                      [](const Quantity& x, const Quantity& y) { return x.name == y.name; });
}

}  // namespace

std::vector<Problem> switchProblems(const EventSpec& event, const Scene& scene, const System& system) {
    const std::vector<ModelParameter> all = parametersOf(scene);
    std::vector<std::string> names;
    for (const ModelParameter& each : all) names.push_back(each.name);
    const auto known =
        std::find_if(all.begin(), all.end(), [&](const auto& p) { return p.name == event.parameter; });
    if (known == all.end())
        return {{"/parameter",
                 "is " + event.parameter + ", and " + scene.model.type + " has no such parameter",
                 names.empty() ? "it has none; a typed Lagrangian with parameters"
                               : "one of " + joinNames(names)}};
    if (!(event.value.value >= known->min && event.value.value <= known->max))
        return {{"/value",
                 event.parameter + " cannot be " + formatNumber(event.value.value, 6) + ": it is from " +
                     formatNumber(known->min, 6) + " to " + formatNumber(known->max, 6),
                 "a value that the model admits"}};
    const std::string cannot = event.parameter + " cannot change during a motion: ";
    try {
        Scene alone;
        alone.model = scene.model;
        alone.events = {event};
        const SwitchableSystems systems(alone);
        const auto other = systems.system({event.value.value});
        if (!haveSameState(system, *other))
            return {{"/parameter", cannot + "another value has another state", "a parameter of forces"}};
        if (const std::string name = firstChanged<Constraint>(system, *other); !name.empty())
            return {{"/parameter", cannot + "the constraint " + name + " would no longer be met",
                     "a stiff spring in place of the constraint, or one that depends on t"}};
        if (const std::string name = firstChanged<Wall>(system, *other); !name.empty())
            return {{"/parameter", cannot + "the wall " + name + " would jump",
                     "a wall that moves with t; its restitution may be switched"}};
    } catch (const InvalidScene& e) {
        return {{"/value", e.problems().front().message, e.problems().front().hint}};
    }
    return {};
}

void addSwitches(System& system, const Scene& scene) {
    const bool hasSwitches = std::any_of(scene.events.begin(), scene.events.end(), [](const EventSpec& e) {
        return e.action == EventSpec::Action::change;
    });
    if (!hasSwitches) return;
    const auto systems = std::make_shared<const SwitchableSystems>(scene);
    system.parts.set(
        ParameterSwitching{[systems](const System& first, const State& start, const MakeFrom& make) {
            return makeSwitchedStep(systems, first, start, make);
        }});
    forgetKnownMotion(system);
}

}  // namespace extremal
