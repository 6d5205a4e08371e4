// SPDX-License-Identifier: GPL-3.0-or-later
/// Values of states that a run was asked for: where they stop being numbers, the motion was left.
///
/// Observables that are functions of the state alone (energies, momenta, norms, ...) are known wherever the
/// motion is. A run that computes them at every node ends, as lost, at the last node before one at which such
/// a value is not finite, whatever else of the state still looks sound. It says nothing of columns that were
/// not finite at the start, of values that are measured in steps or against a reference, which may be unknown
/// without a fault of the scheme, and of states whose momentum has no velocity that could be found.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/observe/catalog.hpp"

namespace extremal {

class StateValues {
public:
    /// Finds nothing wrong.
    StateValues() = default;
    /// Of an observer bound to the system, at the state a run starts from. Finds nothing wrong with the
    /// values of an observable that is more than a function of the state.
    StateValues(const ObservableEntry& entry, const Observer& observer, const System& system,
                const State& start);

    /// How many nodes, in order, have finite values; those of node i begin at values + i * stride.
    std::size_t finiteNodes(const NodeBlock& nodes, const double* values, std::size_t stride) const;

private:
    std::vector<std::size_t> columns_;  ///< that are watched
    std::function<bool(double t, const double* x)> hasVelocity_;
};

/// Whether the Legendre transform has a velocity at (t, x); empty where every state has one.
std::function<bool(double t, const double* x)> velocityTestOf(const System& system);

}  // namespace extremal
