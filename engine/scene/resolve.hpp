// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene as it runs: what reading it makes of its model and its schemes, once. Everything behind the codec
/// takes it; nothing derives it again.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/family/family.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// A scheme: a discretization of a family, or a baseline, and perhaps a composition of it.
struct ResolvedScheme {
    SchemeSpec spec;                          ///< as the scene has it: label, step, tolerance
    const Family* family = nullptr;           ///< null: a baseline
    const BaselineEntry* baseline = nullptr;  ///< null: of a family
    Discretization discretization;  ///< of a family: complete, but for what the start of a run decides
    std::vector<double> parts;      ///< of its step, where it is composed
    Properties properties;          ///< of a family, without its composition
    Claims claims;                  ///< with its composition
    TimeGrid grid = TimeGrid::fixed;
    /// Where the space has a resolution of its own: the system on the mesh of the scheme, and its start.
    /// Null: the system of the scene.
    std::shared_ptr<const System> ownSystem = {};
    State ownInitial = {};

    // Compiled once.
    ResolvedScheme();
    ResolvedScheme(const ResolvedScheme&);
    ResolvedScheme(ResolvedScheme&&) noexcept;
    ResolvedScheme& operator=(const ResolvedScheme&);
    ResolvedScheme& operator=(ResolvedScheme&&) noexcept;
    ~ResolvedScheme();

    bool isComposed() const { return !parts.empty(); }
    /// Its steps follow a monitor (phase/monitored.hpp).
    bool isMonitored() const { return !spec.monitor.type.empty(); }
    /// Its steps keep invariants in place of the symplectic form (family/parts/test_space.hpp).
    bool isTested() const { return !spec.keep.empty(); }
    /// The discretization that the scheme is, and not one that it is composed of, takes in another time, or
    /// tests by other functions; null for baselines.
    const Discretization* plain() const {
        return family && !isComposed() && !isMonitored() && !isTested() ? &discretization : nullptr;
    }
    /// Largest step * frequency on the harmonic oscillator; infinity: none; 0: not known. That of a
    /// composition is measured when it is first asked for.
    double stabilityLimit() const;
    /// Of fields on meshes: the order in space, which compositions in time do not raise; 0: there is none.
    int orderInSpace() const;
    /// Nodes are products of the run.
    bool isFixed() const { return grid == TimeGrid::fixed; }
    /// Has a tolerance in place of a step.
    bool isAdaptive() const { return grid == TimeGrid::landing; }
    /// Whether it can integrate the system.
    bool fits(const System& system) const;
    /// Its integrator, for a run from a state. Throws InvalidScene (pointer relative to the scheme).
    std::unique_ptr<Integrator> make(const System& system, double step, const State& start) const;
};

/// The complete discretization that a scheme is or is composed of; none for baselines.
std::optional<Discretization> discretizationOf(const SchemeSpec& scheme);

/// Keys must be checked and complete. Claims are those on the system, where it is known. Throws InvalidScene
/// where a name is not known.
ResolvedScheme resolve(const SchemeSpec& scheme, const System* system = nullptr);

struct ResolvedScene {
    Scene scene;
    std::shared_ptr<const System> system;
    State initial;  ///< of the scene; schemes start from schemeStart (two_positions.hpp)
    std::vector<ResolvedScheme> schemes;    ///< one for each of scene.schemes, disabled ones as well
    std::vector<ResolvedScheme> reference;  ///< one where a scheme is the reference
};

/// The system that a scheme integrates, and its state at the start of the scene.
inline const std::shared_ptr<const System>& systemOf(const ResolvedScene& scene,
                                                     const ResolvedScheme& scheme) {
    return scheme.ownSystem ? scheme.ownSystem : scene.system;
}
inline const State& initialOf(const ResolvedScene& scene, const ResolvedScheme& scheme) {
    return scheme.ownSystem ? scheme.ownInitial : scene.initial;
}

/// Gives the scheme its own system where its space has a resolution of its own. Throws InvalidScene.
void resolveSystem(ResolvedScheme& scheme, const Scene& scene);

/// The scheme on a mesh of `factor` times as many elements, where the system has a mesh; else as it is.
/// Throws InvalidScene where the initial data are not known there.
ResolvedScheme refined(const ResolvedScheme& scheme, const ResolvedScene& scene, int factor);

/// Throws InvalidScene where the scene is not valid.
ResolvedScene resolve(const Scene& scene);

}  // namespace extremal
