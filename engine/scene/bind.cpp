// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/bind.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/mechanism/mechanism_start.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/scene/reflections.hpp"
#include "engine/scene/switches.hpp"

namespace extremal {

System makeSystem(const Scene& scene) {
    const ModelEntry* entry = findModel(scene.model.type);
    if (!entry) throw InvalidScene("/model/type", "unknown model \"" + scene.model.type + "\"");
    System system = entry->make(scene.model);
    addReflections(system, scene.events);
    nameVariedNumbers(system, scene);
    addSwitches(system, scene);
    return system;
}

State givenState(const Scene& scene, const System& system) {
    State state;
    state.t = scene.start.value;
    if (system.start) {
        state.x = system.start(scene.initial.given, state.t);
        return state;
    }
    if (scene.initial.second == Initial::Second::position) return exactStart(scene, system);
    const auto d = static_cast<std::size_t>(system.dimension());
    state.x.assign(2 * d, 0);
    const auto* const form = system.parts.find<WrittenForm>();
    for (std::size_t i = 0; i < d; ++i) {
        state.x[i] = scene.initial.q.empty() && form ? form->q[i] : scene.initial.q[i].value;
        if (i < scene.initial.pOrV.size()) state.x[d + i] = scene.initial.pOrV[i].value;
    }
    const bool isOfModel = scene.initial.second == Initial::Second::none && form;
    if (isOfModel)
        std::copy(form->v.begin(), form->v.end(), state.x.begin() + static_cast<std::ptrdiff_t>(d));
    if (scene.initial.second == Initial::Second::velocity || isOfModel) {
        const std::vector<double> v(state.x.begin() + static_cast<std::ptrdiff_t>(d), state.x.end());
        std::vector<double> gradient(2 * d);
        const auto& m = system.mechanics();
        m.gradient(m.model.get(), state.t, state.x.data(), v.data(), gradient.data());
        for (std::size_t i = 0; i < d; ++i) state.x[d + i] = gradient[d + i];
    }
    return state;
}

State initialState(const Scene& scene, const System& system) {
    State state = givenState(scene, system);
    try {
        putOnConstraints(system, state, scene.initial.isProjected);
        requireOutsideWalls(system, state);
    } catch (const InvalidScene& e) {
        // Where the model has keys of its own, what is wrong is at these.
        std::vector<Problem> problems = e.problems();
        for (Problem& p : problems) {
            p.pointer = originIn(system.parts, p.pointer);
            if (scene.initial.q.empty() && p.pointer == "/initial/q") p.pointer = "/initial";
        }
        throw InvalidScene(std::move(problems));
    }
    return state;
}

ExactSolution exactSolution(const Scene& scene, const System& system, const State& initial) {
    // With parameters of extreme size a formula may over- or underflow, and a special function refuse.
    try {
        const ExactSolution exact = system.exactFrom ? system.exactFrom(scene.initial.given, initial)
                                    : system.exact   ? system.exact(initial)
                                                     : ExactSolution();
        if (!exact || exact.atPlaces()) return exact;  // known at places: perhaps not at nodes
        std::vector<double> x(initial.x.size());
        exact(initial.t, x);
        const bool isFinite = std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); });
        return isFinite ? exact : ExactSolution();
    } catch (const std::domain_error&) {
    } catch (const std::runtime_error&) {  // of Boost.Math: overflow, evaluation, rounding
    }
    return {};
}

long long stepCount(double start, double end, double step) {
    return static_cast<long long>(std::floor((end - start) / step + 1e-9));
}

}  // namespace extremal
