#include "engine/scene/bind.hpp"

#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/scene/two_positions.hpp"

namespace extremal {

System makeSystem(const Scene& scene) {
    const ModelEntry* entry = findModel(scene.model.type);
    if (!entry) throw InvalidScene("/model/type", "unknown model \"" + scene.model.type + "\"");
    return entry->make(scene.model);
}

State initialState(const Scene& scene, const System& system) {
    State state;
    state.t = scene.start.value;
    if (system.start) {
        state.x = system.start(scene.initial.given, state.t);
        return state;
    }
    if (scene.initial.second == Initial::Second::position) return exactStart(scene, system);
    const auto d = static_cast<std::size_t>(system.dimension());
    state.x.assign(2 * d, 0);
    for (std::size_t i = 0; i < d; ++i) {
        state.x[i] = scene.initial.q[i].value;
        if (i < scene.initial.pOrV.size()) state.x[d + i] = scene.initial.pOrV[i].value;
    }
    if (scene.initial.second == Initial::Second::velocity) {
        const std::vector<double> v(state.x.begin() + static_cast<std::ptrdiff_t>(d), state.x.end());
        std::vector<double> gradient(2 * d);
        const auto& m = system.mechanics();
        m.gradient(m.model.get(), state.t, state.x.data(), v.data(), gradient.data());
        for (std::size_t i = 0; i < d; ++i) state.x[d + i] = gradient[d + i];
    }
    return state;
}

ExactSolution exactSolution(const Scene& scene, const System& system, const State& initial) {
    if (system.exactFrom) return system.exactFrom(scene.initial.given, initial);
    return system.exact ? system.exact(initial) : ExactSolution();
}

long long stepCount(double start, double end, double step) {
    return static_cast<long long>(std::floor((end - start) / step + 1e-9));
}

}  // namespace extremal
