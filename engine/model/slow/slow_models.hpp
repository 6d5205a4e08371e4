// SPDX-License-Identifier: GPL-3.0-or-later
/// Slow models of a system with a fast oscillation: Hamilton's equations of fewer unknowns, or of slower
/// ones, and the states of the system that they stand for.
///
/// y = (q, p, c): d slow coordinates, their momenta, and constants of the motion on which the Hamiltonian
/// K(q, p; c) depends (the action of the oscillation). An action may also be one of the momenta, beside its
/// angle among the coordinates. What K leaves out of the system is the error of the model, which no step
/// makes smaller.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/parts.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/system.hpp"

namespace extremal {

struct SlowModel {
    std::string id;     ///< "rod": the value of the key `model` of a slow space
    std::string title;  ///< in place of the system: "rod"
    int dimension = 1;  ///< d
    int constants = 0;  ///< entries of c
    int constantsFrom;  ///< index of the first entry of y that is constant, an action among p included

    /// y at a state.
    std::function<void(const State& start, double* y)> project;
    /// K, with the constants of y in place.
    std::function<PhaseMechanics(const double* y)> hamiltonian;
    /// The state x at time t.
    std::function<void(double t, const double* y, double* x)> embed;

    int size() const { return 2 * dimension + constants; }
};

/// The part of systems that have some, from the crudest to the finest.
struct SlowModels {
    static constexpr PartInfo part{"slow-models", "slow models of a fast oscillation", false};
    std::vector<SlowModel> all;
};

/// The model of that id; null where the system has none.
const SlowModel* findSlowModel(const System& system, std::string_view id);

/// The model behind the calls of baselines, which go along y' = (K_p, -K_q, 0); of models whose states do not
/// depend on time.
ReducedModel reducedModel(std::string id, const SlowModel& model);

}  // namespace extremal
