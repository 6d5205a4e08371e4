// SPDX-License-Identifier: GPL-3.0-or-later
/// The key `places` of a model with a typed density: where the values of its components are.
///
///     {"a": "edges-x", "b": "edges-y"}     names of FieldPlace; components that are left out: "nodes"
/// The potential (a, b) of electrodynamics in the plane is on edges (Nedelec's elements of lowest degree;
/// with the trapezoidal rule these are Yee's scheme).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/density/problem.hpp"

namespace extremal {

FieldInfo densityPlacesField(bool isPlane);

/// "edges-x"
std::string_view nameOf(FieldPlace place);

/// Sets problem.places, which stay empty where all are nodes. Throws InvalidScene for what is no component or
/// no place, for an interval that is not periodic, and where the density has a derivative of a component
/// along which it is constant.
void readPlaces(const Settings& model, DensityProblem& problem);

/// Throws where a model without a typed density has the key.
void refusePlaces(const Settings& model);

/// The two components whose values are on the edges along x and along y, where there is one of each.
struct EdgePair {
    std::size_t alongX, alongY;
};
std::optional<EdgePair> edgePairOf(const DensityProblem& problem);

}  // namespace extremal
