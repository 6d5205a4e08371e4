#include "engine/scene/composed_stability.hpp"

#include <limits>
#include <map>
#include <mutex>
#include <string>

#include "engine/integrator/stability.hpp"
#include "engine/scene/json.hpp"
#include "engine/scene/read_parts.hpp"

namespace extremal {
namespace {

System oscillator() {
    const ModelEntry* entry = findModel("harmonic-oscillator");
    return entry->make({"harmonic-oscillator", {{"m", 1.0}, {"k", 1.0}}, {}});
}

double measure(const ResolvedScheme& scheme) {
    constexpr double resolution = 0.02;
    const System system = oscillator();
    if (!scheme.fits(system)) return 0;
    return firstInstability(
        [&](double z) {
            const auto step = scheme.make(system, z, State{0, 0, {1, 0}});
            State one{0, 0, {1, 0}}, other{0, 0, {0, 1}};
            const bool isSolved = advance(*step, one).outcome == Outcome::converged &&
                                  advance(*step, other).outcome == Outcome::converged;
            return isSolved ? (one.x[0] + other.x[1]) / 2 : std::numeric_limits<double>::quiet_NaN();
        },
        resolution);
}

}  // namespace

double composedStabilityLimit(const ResolvedScheme& scheme) {
    static std::mutex mutex;
    static std::map<std::string, double> known;
    SchemeSpec bare = scheme.spec;  // what the limit depends on
    bare.label.clear();
    bare.isEnabled = bare.allowsUnstable = true;
    bare.step = {};
    bare.solver = {"auto", {}, {}};
    const std::string key = writeJson(schemeValue(bare));
    {
        const std::lock_guard lock(mutex);
        if (const auto found = known.find(key); found != known.end()) return found->second;
    }
    const double limit = measure(scheme);
    const std::lock_guard lock(mutex);
    if (known.size() >= 256) known.clear();
    return known.emplace(key, limit).first->second;
}

}  // namespace extremal
