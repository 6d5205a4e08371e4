/// A system with its parameters in place: what a scene's "model" turns into.
///
/// Everything a system can say is a field here; a field that is empty is something the system does not have
/// (no exact solution, no conserved momentum, nothing to draw). One file of model/systems makes one entry.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/state.hpp"
#include "engine/model/drawing.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/core/settings.hpp"

namespace extremal {

/// A generalised coordinate. Its state columns are "q.<name>" and "p.<name>".
struct Coordinate {
    std::string name;    ///< in files: "theta"
    std::string title;   ///< "angle"
    std::string symbol;  ///< in plots: "θ"
    std::string unit;    ///< "rad"; empty if dimensionless
    std::string momentumUnit;
};

/// A momentum that Noether's theorem conserves, as a function of the state.
struct MomentumMap {
    std::string name;    ///< column "momentum.<name>"
    std::string symbol;
    std::string unit;
    std::function<double(const double* q, const double* p)> value;
};

struct System {
    std::string id;
    std::vector<Coordinate> coordinates;
    std::string timeUnit;    ///< "s", or empty if dimensionless
    std::string energyUnit;
    Mechanics<double> mechanics;
    std::vector<MomentumMap> momenta;
    /// Makes the exact solution through the initial state (t, x), or returns an empty function where there is none.
    std::function<ExactSolution(const State& initial)> exact;
    /// Shapes of one state, for the stage.
    std::function<void(const double* x, Drawing& drawing)> draw;
    /// The default phase portrait and trajectory: names of state columns.
    std::string phaseX, phaseY, trajectoryX, trajectoryY;
    bool hasPlanarTrajectory = false;  ///< the two trajectory columns are lengths in one plane

    int dimension() const { return static_cast<int>(coordinates.size()); }
};

struct ModelEntry {
    CatalogItem item;
    /// Initial data to start from when a user picks this model: q, then p, one per coordinate.
    std::vector<double> exampleQ, exampleP;
    double exampleEnd = 10, exampleStep = 0.05;
    std::function<System(const Settings& settings)> make;  ///< keys are checked and complete
};

/// All systems, in alphabetical order of their ids; gathered from the files of model/systems.
const std::vector<ModelEntry>& modelCatalog();
/// The entry with this id, or null.
const ModelEntry* findModel(std::string_view id);

}  // namespace extremal
