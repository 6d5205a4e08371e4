// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems as subjects of laws: where they start, how large and how fast they are, where they go. There is
/// one for each model of the catalogue, from its first preset (typed ones from each of theirs), and
/// small wave functions in place of those of the presets.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/scene/preset.hpp"
#include "tests/laws/laws.hpp"

namespace extremal::laws {

/// A system with its motion from a start, scaled.
struct Subject {
    std::string name;
    System system;
    State start;
    double time = 1;                ///< over which errors are measured: some radians of the fastest motion
    double scaleQ = 1, scaleP = 1;  ///< sizes of positions and momenta; of states without halves both are one
    std::vector<double> own;        ///< size of each entry of the state
    std::array<State, 4> exact;     ///< at the quarters of `time`
    bool isAutonomous = true;       ///< its energy does not depend on t

    std::size_t half() const { return start.x.size() / 2; }
    double scaleOf(std::size_t i) const { return hasHalves() && i >= half() ? scaleP : scaleQ; }
    /// Whether a state is (q, p), and the canonical form is that of these.
    bool hasHalves() const { return !system.parts.find<Body>() && !system.parts.find<Wave>(); }
    /// The state at the time of another.
    State exactAt(double t) const;
};

/// Scaled to the sizes of positions and momenta.
double distanceOn(const Subject& on, const State& a, const State& b);

/// The system of a model (or of a typed Lagrangian's preset), with its motion over `time`; 0: over some
/// radians of its fastest motion. Its reference is the trusted scheme of its family.
Subject subjectOf(std::string name, const System& system, const State& start, double time = 0,
                  double longest = 0);

/// What the state of a subject is; problems without motion are not subjects. A family of a new kind of system
/// is among the others: laws.claims_others measures it by what its systems say of themselves.
enum class SubjectKind { coordinates, body, wave, other };
SubjectKind kindOfSubject(const System& system);

std::vector<Subject> everySubject(SubjectKind kind);

/// The first preset of each model, and every one of a typed one.
std::vector<const Preset*> onePerModel();

}  // namespace extremal::laws
