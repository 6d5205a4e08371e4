// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of families that references are computed with.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/family/discretization.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// The scheme that references of a system are computed with.
struct ReferencePlan {
    std::string description;  ///< "Gauss collocation of degree 12"
    std::function<std::unique_ptr<Integrator>(double step)> make;
    /// Its only step, with the error to expect; 0: steps are halved until two of them agree.
    double step = 0, expectedError = 0;
    /// Where halving begins; 0: at the period of the fastest motion, which it must resolve.
    double firstStep = 0;
    /// More steps than these, of all the runs that are compared at least, are not made; 0: without a limit of
    /// the plan.
    double mostSteps = 0;
};

/// The scheme that references of systems on meshes are computed with: on a mesh of its own.
struct ReferenceMesh {
    std::string description;
    Discretization discretization;
    double step = 0, elements = 0;
};

/// How a reference from a state is computed. Of families that are not the system's own (familyFor) `make` of
/// the plan is empty where that one's is as good. Without it the family provides no reference.
struct TrustedScheme {
    static constexpr PartInfo part{"trusted-scheme", "a scheme of references", false};
    ReferencePlan (*plan)(const System&, const State& start, double duration) = nullptr;
};

/// The same of systems on meshes, whose references are refined in space as well: `refinement` 0, 1, ..
/// doubles cells and steps. `step`: the shortest of the scene's schemes. Without it references are on the
/// mesh of the scene.
struct TrustedMesh {
    static constexpr PartInfo part{"trusted-mesh", "a scheme of references on a mesh of its own", false};
    ReferenceMesh (*refined)(const Settings& model, double step, int refinement) = nullptr;
    Takes of = Takes::everything();  ///< for which systems of the family
};

/// References by a discretization, whose steps are halved until two of them agree.
ReferencePlan referenceBy(std::string description, const System& system, const Discretization& scheme);

/// The ways to compute a reference of the system, the cheapest first; the last one is that of its own family.
std::vector<ReferencePlan> referencePlans(const System& system, const State& start, double duration);

/// The scheme that references of the system are computed with, for a run from a state. Throws InvalidScene
/// where there is none.
std::unique_ptr<Integrator> trustedIntegrator(const System& system, const State& start, double step);

}  // namespace extremal
