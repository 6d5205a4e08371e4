/// The systems of the presets as subjects of laws: where they start, how large and how fast they are, where
/// they go.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "engine/scene/bind.hpp"
#include "engine/scene/codec.hpp"
#include "engine/scene/preset.hpp"
#include "tests/laws/laws.hpp"

namespace extremal::laws {

/// A system with its motion from a start, scaled.
struct Subject {
    std::string name;
    System system;
    State start;
    double time = 1;                ///< over which errors are measured: some radians of the fastest motion
    double scaleQ = 1, scaleP = 1;  ///< sizes of positions and momenta
    std::vector<double> own;        ///< of each coordinate
    std::array<State, 4> exact;     ///< at the quarters of `time`

    std::size_t half() const { return start.x.size() / 2; }
    double scaleOf(std::size_t i) const { return isBody(system) || i < half() ? scaleQ : scaleP; }
};

/// Scaled to the sizes of positions and momenta.
inline double distanceOn(const Subject& on, const State& a, const State& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i)
        worst = std::max(worst, std::abs(a.x[i] - b.x[i]) / on.scaleOf(i));
    return worst;
}

inline Subject subjectOf(const std::string& name, const Scene& scene) {
    constexpr int referenceSteps = 32;
    Subject s{name, makeSystem(scene), {}, 1, 1, 1, {}, {}};
    s.start = initialState(scene, s.system);
    const double w = highestFrequency(s.system, s.start);
    s.time = 0;
    for (const SchemeSpec& scheme : scene.schemes) s.time = std::max(s.time, 40 * scheme.step.value);
    if (w > 0) s.time = std::min(s.time, 4 / w);
    const auto integrator = trustedIntegrator(s.system, s.start, s.time / referenceSteps);
    State state = s.start;
    s.scaleQ = s.scaleP = 0;
    s.own.assign(state.x.size(), 0);
    for (int k = 1; k <= referenceSteps; ++k) {
        if (advance(*integrator, state).outcome != Outcome::converged)
            qFatal("%s: no reference", name.c_str());
        if (k % (referenceSteps / 4) == 0)
            s.exact[static_cast<std::size_t>(4 * k / referenceSteps - 1)] = state;
        for (std::size_t i = 0; i < state.x.size(); ++i) {
            double& scale = isBody(s.system) || i < s.half() ? s.scaleQ : s.scaleP;
            scale = std::max(scale, std::abs(state.x[i]));
            s.own[i] = std::max(s.own[i], std::abs(state.x[i]));
        }
    }
    if (!(s.scaleP > 0)) s.scaleP = 1;
    // Coordinates that hardly leave zero are lost in the round-off of the others; Pluto's momentum, 3e-6 of
    // Jupiter's, is not.
    for (std::size_t i = 0; i < s.own.size(); ++i) s.own[i] = std::max(s.own[i], 1e-4 * s.scaleOf(i));
    return s;
}

/// A system for each model, typed Lagrangians each by itself: the first preset of each kind.
inline std::vector<Subject> everySystem() {
    std::vector<Subject> subjects;
    std::set<std::string> seen;
    for (const Preset& preset : presets()) {
        const Scene scene = readScene(preset.json).scene;
        const bool isTyped = scene.model.type == "lagrangian";
        if (!seen.insert(isTyped ? std::string(preset.id) : scene.model.type).second) continue;
        if (const System system = makeSystem(scene); !isMechanical(system) && !isBody(system)) continue;
        subjects.push_back(subjectOf(std::string(preset.id), scene));
    }
    return subjects;
}

}  // namespace extremal::laws
