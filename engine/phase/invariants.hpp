// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of the state that a scheme is to keep, by name: "energy", "momentum.<name>" and
/// "casimir.<name>" as columns have it, or a formula in coordinates and momenta, or in variables
/// ("x*p_y - y*p_x").
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// One that a scene asks for: as it is written, and with the values of parameters in place.
struct KeptQuantity {
    std::string text, formula;
    bool operator==(const KeptQuantity&) const = default;
};

struct Invariant {
    std::string name;
    /// The energy of equations x' = J grad H with a constant J: Pi f keeps it, without more.
    bool isKeptByProjection = false;
    /// As many numbers as x has. A function may keep buffers: each integrator has its own. Empty: of the
    /// energy in coordinates and momenta, whose gradient is known from the flow.
    std::function<void(const double* x, double* gradient)> gradient;
};

/// Those of a system that can keep them. Throws InvalidScene (pointers "/keep/1")
/// where one of them is not known, is not constant along the motion near `start`, or depends on the others
/// there. Without x the start is not known, and nothing is checked there.
std::vector<Invariant> invariantsOf(const std::vector<KeptQuantity>& kept, const System& system,
                                    const State& start);

/// Whether steps can keep invariants of its motion: that of a Lagrangian or a Hamiltonian alone, of a
/// one-form or of a bracket.
bool canKeepInvariants(const System& system);

/// What formulas of a state may be of: coordinates and momenta, or the variables of equations of first order.
/// Behind an odd number of variables the state has an entry without a name.
std::vector<std::string> namesInState(const System& system);

/// "energy" and nothing else.
inline bool isEnergyAlone(const std::vector<KeptQuantity>& kept) {
    return kept.size() == 1 && kept.front().text == "energy";
}

}  // namespace extremal
