// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/density/places.hpp"

#include <algorithm>
#include <array>

#include "engine/core/problem.hpp"
#include "engine/core/text/known_keys.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

constexpr const char* placesKey = "places";

struct NamedPlace {
    FieldPlace place;
    const char* name;
    bool isOfPlane;
};
constexpr std::array<NamedPlace, 4> namedPlaces{{{FieldPlace::nodes, "nodes", false},
                                                 {FieldPlace::edgesX, "edges-x", true},
                                                 {FieldPlace::edgesY, "edges-y", true},
                                                 {FieldPlace::cells, "cells", false}}};

std::vector<std::string> knownPlaces(bool isPlane) {
    std::vector<std::string> names;
    for (const NamedPlace& each : namedPlaces)
        if (isPlane || !each.isOfPlane) names.emplace_back(each.name);
    return names;
}

FieldPlace placeNamed(const Value& given, bool isPlane, const std::string& pointer) {
    const std::vector<std::string> known = knownPlaces(isPlane);
    const std::string name = given.isString() ? given.asString() : std::string();
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw InvalidScene(pointer, "must be a place of values, " + joinNames(known),
                           name.empty() ? "\"nodes\"" : suggestName(name, known));
    return std::find_if(namedPlaces.begin(), namedPlaces.end(),
                        [&](const NamedPlace& each) { return name == each.name; })
        ->place;
}

/// A function that is constant along an axis on each cell has no derivative there.
void requireDerivatives(const DensityProblem& problem, std::size_t c, FieldPlace place,
                        const std::string& pointer) {
    for (int direction = 0; direction < problem.density.directions(); ++direction) {
        const int slope =
            (DensityArgument::slopeX + direction) * problem.density.components() + static_cast<int>(c);
        if (!isConstantAlong(place, direction) || !problem.density.dependsOn(slope)) continue;
        const char axis = direction == 0 ? 'x' : 'y';
        throw InvalidScene(
            pointer,
            "cannot be \"" + std::string(nameOf(place)) + "\": such functions are constant along " + axis +
                " on each cell, and the density has the derivative " + problem.names[c] + "_" + axis,
            problem.isPlane() && place != FieldPlace::cells
                ? (direction == 0 ? "\"edges-y\" or \"nodes\"" : "\"edges-x\" or \"nodes\"")
                : "\"nodes\"");
    }
}

}  // namespace

FieldInfo densityPlacesField(bool isPlane) {
    return optionalJsonField(
        placesKey, "places",
        std::string("Where the values of the components of a typed density are, by name: ") +
            (isPlane
                 ? "nodes (linear along both axes, the default), edges-x (the edges along x: constant along "
                   "x and linear along y on each cell), edges-y, cells (constant)."
                 : "nodes (linear on each cell, the default), cells (constant on each cell)."));
}

std::string_view nameOf(FieldPlace place) {
    return std::find_if(namedPlaces.begin(), namedPlaces.end(),
                        [&](const NamedPlace& each) { return each.place == place; })
        ->name;
}

void readPlaces(const Settings& model, DensityProblem& problem) {
    const Value* const given = model.find(placesKey);
    if (!given || given->isNull()) return;
    const std::string key = std::string("/") + placesKey;
    if (!given->isObject())
        throw InvalidScene(key, "must be an object of places by the names of components",
                           "{\"" + problem.names.front() + "\": \"nodes\"}");
    std::vector<FieldPlace> places(problem.components(), FieldPlace::nodes);
    for (const auto& [name, value] : given->asObject()) {
        const std::string pointer = key + "/" + name;
        const auto found = std::find(problem.names.begin(), problem.names.end(), name);
        if (found == problem.names.end())
            throw InvalidScene(pointer, "is not a component", joinNames(problem.names));
        const auto c = static_cast<std::size_t>(found - problem.names.begin());
        places[c] = placeNamed(value, problem.isPlane(), pointer);
        if (places[c] != FieldPlace::nodes && !problem.isPeriodic())
            throw InvalidScene(pointer, "must be \"nodes\" where the domain has ends",
                               "\"boundary\": \"periodic\" in the model");
        requireDerivatives(problem, c, places[c], pointer);
    }
    if (std::any_of(places.begin(), places.end(), [](FieldPlace p) { return p != FieldPlace::nodes; }))
        problem.places = std::move(places);
}

void refusePlaces(const Settings& model) {
    if (const Value* const given = model.find(placesKey); given && !given->isNull())
        throw InvalidScene(std::string("/") + placesKey, "is for a field with a typed density",
                           "the key lagrangian in place of potential");
}

std::optional<EdgePair> edgePairOf(const DensityProblem& problem) {
    const auto only = [&](FieldPlace place) {
        return std::count(problem.places.begin(), problem.places.end(), place) == 1;
    };
    if (!only(FieldPlace::edgesX) || !only(FieldPlace::edgesY)) return {};
    const auto find = [&](FieldPlace place) {
        return static_cast<std::size_t>(std::find(problem.places.begin(), problem.places.end(), place) -
                                        problem.places.begin());
    };
    return EdgePair{find(FieldPlace::edgesX), find(FieldPlace::edgesY)};
}

}  // namespace extremal
