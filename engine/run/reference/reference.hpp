// SPDX-License-Identifier: GPL-3.0-or-later
/// The solution that errors are measured against, and how good it is itself.
///
/// exact: the model's own; computed: Gauss collocation of degree 12 at a step refined until two of them
/// agree, evaluated on its dense output; where a run has many fast periods of a frequency that the model
/// knows, steps over many periods in the same way, if they agree to 1e-11, so that the cost does not grow
/// with the stiffness; for fields elements of high degree on a mesh that is finer than that of the scene;
/// A computed reference of a system with coordinates is confirmed by a method of another kind (members.hpp).
///
/// scheme: a scheme of the user's choice; file: rows of a CSV, known only at their times; companion: of each
/// scheme the same with one degree more (scene/outlook/companion.hpp).
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

/// A solution on a mesh of its own.
struct MeshSolution {
    std::shared_ptr<const System> system;  ///< null: there is none
    std::size_t width = 0;                 ///< of its states
    std::function<ExactSolution()> make;
    /// A solution read off at the nodes of another mesh.
    ExactSolution on(const std::shared_ptr<const System>& other) const;
};

/// Of the run of a companion, while it goes on.
struct StepCounts {
    long long steps = 0, events = 0;  ///< events: steps in which something happened besides going on
    StepCounts& operator+=(const StepCounts& other) {
        steps += other.steps;
        events += other.events;
        return *this;
    }
};

struct ReferencePair;

struct Reference {
    ReferenceInfo info;
    /// Makes a solution for one run: each keeps its own place in time. Empty where there is no reference. At
    /// times it does not know it gives NaN.
    std::function<ExactSolution()> make;
    /// Where it has a mesh of its own. `make` is read off it.
    MeshSolution onMesh = {};
    std::shared_ptr<StepCounts> counts = {};  ///< of a companion
    /// Of a computed one, with that of another kind at the same times (members.hpp); null: there is none.
    std::shared_ptr<const ReferencePair> pair = {};

    /// Computes the solution once for all its users, at these times; where its states on a mesh of its own
    /// are too many numbers, once for those on the mesh of the scene. False where these are too many as well.
    /// `width`: of the states of the scene.
    bool share(std::vector<double> times, std::size_t width, std::shared_ptr<const System> system);
};

/// The reference as a scheme on a mesh of its own sees it: the solution at its nodes, or none.
Reference referenceFor(const Reference& reference, const ResolvedScene& resolved,
                       const ResolvedScheme& scheme);

/// Prepares the reference a scene asks for; in place of companions, which are for single runs, the automatic
/// one. Takes time for computed ones; gives up with kind none when
/// stopped. Throws InvalidScene for a file that cannot be used.
Reference makeReference(const ResolvedScene& resolved, const std::stop_token& stop);

/// The run of the scheme's companion, over the same nodes.
Reference companionReference(const ResolvedScene& resolved, const ResolvedScheme& scheme,
                             const std::stop_token& stop);

/// The run of its second companion; empty where it does not exist. `factor`: what the difference from it is
/// multiplied by to estimate the error, as its own is a known part of that of the scheme.
struct SecondCompanion {
    std::function<ExactSolution()> make;
    double factor = 1;
};
SecondCompanion secondCompanion(const ResolvedScene& resolved, const ResolvedScheme& scheme,
                                const std::stop_token& stop);

/// Makes all solutions of a computed reference readers of one, at the nodes of the scene's schemes, where
/// memory allows.
void shareReference(Reference& reference, const ResolvedScene& resolved);

}  // namespace extremal
