// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/reflections.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "engine/mechanism/joined_constraints.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/typed/parts/typed_parts.hpp"
#include "engine/scene/event_names.hpp"

namespace extremal {
namespace {

/// A coordinate as a name that no parameter has.
std::string placeName(const Coordinate& coordinate) {
    std::string name = "q_" + coordinate.name;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

/// Names and parameters of the expressions of events.
typed::Formula namesFor(const EventSpec& event, const System& system) {
    typed::Formula formula;
    for (const Coordinate& c : system.coordinates) formula.coordinates.push_back(placeName(c));
    formula.parameters = event.values;
    return formula;
}

/// The gap, with coordinates by the names above.
std::string gapText(const EventSpec& event, const System& system) {
    std::string text = event.expression;
    for (const Coordinate& c : system.coordinates) {
        const std::string name = placeName(c), own = name.substr(2);
        const bool isParameter = std::any_of(event.values.begin(), event.values.end(),
                                             [&](const auto& each) { return each.first == own; });
        if (!isParameter) text = withNameReplaced(text, own, name);
    }
    return event.direction == EventSpec::Direction::up ? "-(" + text + ")" : text;
}

/// The first of its names that is not a place or the time; empty: there is none.
std::string otherName(const EventSpec& event, const System& system) {
    std::vector<std::string> parameters;
    for (const auto& each : event.values) parameters.push_back(each.first);
    const std::vector<StateName> known = stateNames(system, parameters);
    const EventText text = EventText::of(event.expression);
    if (!text.integrands.empty()) return "integral";
    for (const std::string& name : parseExpression(event.expression).names())
        for (const StateName& each : known) {
            if (each.name != name) continue;
            const bool isPlace = each.kind == StateName::Kind::time ||
                                 (each.kind == StateName::Kind::column && each.index < system.dimension());
            if (!isPlace) return name;
        }
    return {};
}

/// Two walls as one part.
struct Both {
    Wall first, second;
    int dimension;
};

Wall joined(const Wall& first, const Wall& second, int dimension) {
    Wall made = first;
    made.names.insert(made.names.end(), second.names.begin(), second.names.end());
    made.restitution.insert(made.restitution.end(), second.restitution.begin(), second.restitution.end());
    made.isTimeDependent = first.isTimeDependent || second.isTimeDependent;
    made.model = std::make_shared<const Both>(Both{first, second, dimension});
    made.first = [](const void* p, double t, const double* q, double* gap, double* byPlace, double* byTime) {
        const Both& both = *static_cast<const Both*>(p);
        const int n = both.first.count();
        both.first.first(both.first.model.get(), t, q, gap, byPlace, byTime);
        both.second.first(both.second.model.get(), t, q, gap + n, byPlace + n * both.dimension, byTime + n);
    };
    return made;
}

/// Whether impulses of a wall change a momentum, which is linear in p, at some places.
bool isChangedBy(const Wall& wall, const MomentumMap& map, int dimension) {
    const auto d = static_cast<std::size_t>(dimension);
    std::vector<double> q(d), p(d), normal(d);
    double gap = 0, byTime = 0;
    for (int trial = 1; trial <= 4; ++trial) {
        for (std::size_t i = 0; i < d; ++i) q[i] = std::sin(1.3 * trial + 0.7 * static_cast<double>(i)) + 0.1;
        wall.first(wall.model.get(), 0.37 * trial, q.data(), &gap, normal.data(), &byTime);
        double size = 0;
        for (const double n : normal) size += std::abs(n);
        const double change = map.value(q.data(), normal.data()) - map.value(q.data(), p.data());
        if (!(std::abs(change) <= 1e-12 * size)) return true;
    }
    return false;
}

Wall wallOf(const EventSpec& event, const System& system) {
    return typed::wallOf({{event.title(), gapText(event, system), event.restitution}},
                         namesFor(event, system));
}

}  // namespace

std::vector<Problem> reflectionProblems(const EventSpec& event, const System& system) {
    if (!system.hasCoordinates() || !isTaken(mechanisms(), system.parts))
        return {{"", "reflects, which takes coordinates with a Lagrangian", "another action"}};
    if (event.direction == EventSpec::Direction::both)
        return {{"", "reflects, and has no direction",
                 "down: the motion stays where the expression is positive; up: where it is negative"}};
    if (const std::string other = otherName(event, system); !other.empty())
        return {{"", "reflects, which takes an expression of places and t, without " + other,
                 "impulses are along its gradient by the places"}};
    try {
        wallOf(event, system);
        return {};
    } catch (const InvalidScene& e) {
        return e.problems();
    }
}

void addReflections(System& system, const std::vector<EventSpec>& events) {
    for (const EventSpec& event : events) {
        if (event.action != EventSpec::Action::reflect) continue;
        const Wall own = wallOf(event, system);
        const Wall* const known = system.parts.find<Wall>();
        std::erase_if(system.momenta,
                      [&](const MomentumMap& map) { return isChangedBy(own, map, system.dimension()); });
        const auto* const contact = system.parts.find<WallContact>();
        const Constraint gaps = typed::contactWith(own).gaps;
        system.parts.set(WallContact{
            joinedConstraints(contact ? &contact->gaps : nullptr, gaps, {0}, system.dimension())});
        system.parts.set(known ? joined(*known, own, system.dimension()) : own);
        forgetKnownMotion(system);
    }
}

}  // namespace extremal
