#include "engine/run/look_at_pair.hpp"

#include <algorithm>

#include "engine/scene/bind.hpp"

namespace extremal {

bool showsView(const Scene& scene, const char* id) {
    return std::any_of(scene.views.begin(), scene.views.end(), [&](const View& v) { return v.id == id; });
}

std::shared_ptr<ExactActions> exactActionsOf(const Scene& scene, const System& system, const State& initial) {
    if (!isMechanical(system) || !showsView(scene, "discrete-lagrangian")) return nullptr;
    double largest = 0;
    for (const SchemeSpec& s : scene.schemes)
        if (s.isEnabled && pairOf(s)) largest = std::max(largest, 2 * s.step.value);
    return largest > 0 ? std::make_shared<ExactActions>(system, initial, largest) : nullptr;
}

void lookAtPair(SchemeResult& result, const Scene& scene, const System& system, const State& start,
                ExactActions* exact, const std::stop_token& stop) {
    const auto pair = pairOf(result.spec);
    if (!pair || !isMechanical(system) || !isPairFor(*pair, system)) return;
    if (showsView(scene, "sparsity"))
        result.pattern =
            std::make_shared<const KktPattern>(kktPattern(system, *pair, start, result.spec.step.value));
    if (exact)
        result.actionDefect =
            std::make_shared<const ActionDefect>(actionDefect(system, *pair, start.t, *exact, stop));
}

}  // namespace extremal
