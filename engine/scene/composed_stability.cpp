#include "engine/scene/composed_stability.hpp"

#include <limits>
#include <map>
#include <mutex>
#include <string>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/integrator/stability.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/json.hpp"
#include "engine/scene/read_parts.hpp"

namespace extremal {
namespace {

System oscillator() {
    const ModelEntry* entry = findModel("harmonic-oscillator");
    return entry->make({"harmonic-oscillator", {{"m", 1.0}, {"k", 1.0}}, {}});
}

bool runsOn(const System& system, const SchemeSpec& scheme) {
    if (const auto pair = innerPairOf(scheme)) return isPairFor(*pair, system);
    const BaselineEntry* entry = findBaseline(scheme.baseline.type);
    return entry && appliesTo(*entry, system);
}

double measure(const SchemeSpec& scheme) {
    constexpr double resolution = 0.02;
    const System system = oscillator();
    if (!runsOn(system, scheme)) return 0;
    return firstInstability(
        [&](double z) {
            const auto step = makeScheme(system, scheme, z, State{0, 0, {1, 0}});
            State one{0, 0, {1, 0}}, other{0, 0, {0, 1}};
            const bool isSolved = advance(*step, one).outcome == Outcome::converged &&
                                  advance(*step, other).outcome == Outcome::converged;
            return isSolved ? (one.x[0] + other.x[1]) / 2 : std::numeric_limits<double>::quiet_NaN();
        },
        resolution);
}

}  // namespace

double composedStabilityLimit(const SchemeSpec& scheme) {
    static std::mutex mutex;
    static std::map<std::string, double> known;
    SchemeSpec bare = scheme;  // what the limit depends on
    bare.label.clear();
    bare.isEnabled = bare.allowsUnstable = true;
    bare.step = {};
    bare.solver = {"auto", {}, {}};
    const std::string key = writeJson(schemeValue(bare));
    {
        const std::lock_guard lock(mutex);
        if (const auto found = known.find(key); found != known.end()) return found->second;
    }
    const double limit = measure(bare);
    const std::lock_guard lock(mutex);
    if (known.size() >= 256) known.clear();
    return known.emplace(key, limit).first->second;
}

}  // namespace extremal
