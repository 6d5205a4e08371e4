// SPDX-License-Identifier: GPL-3.0-or-later
/// The grid of a view "parameter-map": a parameter of the model against the step, both in equal ratios.
///
///     value_i = from (to/from)^(i/(columns - 1)),   step_j likewise,
///
/// rounded to a few digits more than their spacing needs, so that a case can be written down. What a view
/// leaves out follows from the scene: the parameter that makes the fast oscillation of the system faster
/// (else the first number of the model), three decades to either side of it, and one to either side of the
/// steps of the schemes.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"
#include "engine/view/parameter_map.hpp"

namespace extremal {

struct MapGrid {
    std::string parameter;  ///< "k"
    std::string pointer;    ///< where it stands in the document: "/model/k"
    std::string column;     ///< of an observable, its largest size is shown: "energy_error"
    std::vector<double> values, steps;
    double duration = 0;
    bool operator==(const MapGrid&) const = default;
};

/// Of a view that has been read.
MapGrid mapGridOf(const Scene& scene, const View& view);

/// A number of the model that can be varied.
struct ModelParameter {
    std::string name, pointer, symbol, unit;
    double value = 0;
    double min = 0, max = 0;  ///< what the model admits
};
std::vector<ModelParameter> parametersOf(const Scene& scene);

/// The columns of all observables that the system has, and whose they are.
struct ObservedColumn {
    std::string name, symbol, unit, observable;
};
std::vector<ObservedColumn> observableColumns(const Scene& scene, const System& system);

/// Whether the view has anything to show by default: a number to vary, and an energy.
bool canBeMapped(const Scene& scene, const System& system);

/// Schemes that have a step and are switched on: a map each.
std::vector<std::size_t> mappedSchemes(const Scene& scene);

}  // namespace extremal
