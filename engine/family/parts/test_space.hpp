// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose curves can be tested by other functions than those that the discrete action
/// gives: steps that keep the energy, or a list of invariants, in place of the symplectic form
/// (phase/kept_step.hpp).
#pragma once

#include <memory>
#include <vector>

#include "engine/family/discretization.hpp"
#include "engine/family/written_action.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/phase/invariants.hpp"

namespace extremal {

struct TestSpace {
    static constexpr PartInfo part{"test-space", "curves that keep invariants", false};
    /// What it promises; the refusal says which discretizations have no such steps.
    Properties (*describe)(const Discretization&, const std::vector<KeptQuantity>&) = nullptr;
    WrittenAction (*written)(const Discretization&, const std::vector<KeptQuantity>&) = nullptr;
    /// Of a system that a Lagrangian or a Hamiltonian alone moves.
    std::unique_ptr<Integrator> (*make)(const System&, const Discretization&, double step,
                                        std::vector<Invariant>) = nullptr;
};

}  // namespace extremal
