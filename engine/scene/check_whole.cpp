#include <algorithm>
#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/core/text.hpp"
#include "engine/family/multiscale/resonance.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/wave/wave.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/cost.hpp"
#include "engine/scene/pointer.hpp"
#include "engine/scene/read_parts.hpp"
#include "engine/scene/two_positions.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {
namespace {

/// Rows of one scheme that fit in memory with ease; a larger file is hardly what was meant.
constexpr double maxRows = 2e7;

void checkStepCount(Reader& reader, const Scene& scene, const SchemeSpec& scheme,
                    const std::string& pointer) {
    const double h = scheme.step.value, start = scene.start.value, end = scene.end.value;
    if (scheme.tolerance) return;
    const double steps = (end - start) / h;
    const double largest = std::max(std::fabs(start), std::fabs(end));
    if (steps > scene.maxSteps)
        reader.error(pointer + "/step",
                     "needs " + formatNumber(steps, 3) + " steps from " + formatNumber(start) + " to " +
                         formatNumber(end) + ", the limit is " + formatNumber(scene.maxSteps),
                     "take a larger step, or raise /limits/steps");
    else if (largest + h == largest)
        reader.error(pointer + "/step",
                     "is too small to change t near " + formatNumber(largest) + ", got " + formatNumber(h));
    else if (h > (end - start) * (1 + 1e-9) + 1e-9 * h)
        reader.warning(pointer + "/step", "is longer than the run: no step is taken, got " + formatNumber(h));
}

void checkRows(Reader& reader, const Scene& scene) {
    if (!scene.every) return;
    const double rows = (scene.end.value - scene.start.value) / scene.every->value;
    if (rows > maxRows)
        reader.error("/output/every",
                     "asks for " + formatNumber(rows, 3) + " rows, the limit is " + formatNumber(maxRows),
                     "a larger interval");
}

void checkStability(Reader& reader, const System& system, const Scene& scene, const SchemeSpec& scheme,
                    double stabilityLimit, const std::string& pointer) {
    if (!(stabilityLimit > 0) || std::isinf(stabilityLimit) || scheme.tolerance) return;
    const double frequency = highestFrequency(system, initialState(scene, system));
    const double h = scheme.step.value, limit = stabilityLimit / frequency;
    if (!(frequency > 0) || !(h > limit)) return;
    reader.warning(pointer + "/step",
                   formatNumber(h) + " is beyond the linear stability limit " + formatNumber(limit, 3) +
                       ": step times frequency may be at most " + formatNumber(stabilityLimit, 3) +
                       ", and the highest frequency at the start is " + formatNumber(frequency, 3),
                   "a smaller step, or another scheme");
}

/// Three-level schemes of wave functions: known exactly, so a step beyond the limit is not a doubt but an
/// error.
void checkWaveStep(Reader& reader, const System& system, const Scene& scene, const SchemeSpec& scheme,
                   const std::optional<Discretization>& pair, double stabilityLimit,
                   const std::string& pointer) {
    // Split-step is unitary: the limit of a splitting is that of mechanics.
    const BaselineEntry* baseline = findBaseline(scheme.baseline.type);
    if (baseline &&
        claimsOf(*baseline, scheme.baseline).conserves != std::vector<std::string>{"bilinear form"})
        return;
    if (std::isinf(stabilityLimit) || !(stabilityLimit > 0)) return;
    const Settings unshifted{"fourier", {{"energy_shift", 0.0}}, {}};
    const double frequency =
        waveFrequency(system, pair ? pair->space : unshifted, initialState(scene, system));
    const double h = scheme.step.value, limit = stabilityLimit / frequency;
    if (!(h > limit)) return;
    const std::string message = formatNumber(h) + " is beyond the stability limit " + formatNumber(limit, 6) +
                                ": the phase of the largest energy advances by " +
                                formatNumber(h * frequency, 4) + " per step, the limit is " +
                                formatNumber(stabilityLimit, 4);
    if (scheme.allowsUnstable)
        reader.warning(pointer + "/step", message);
    else
        reader.error(pointer + "/step", message,
                     "a smaller step, fewer modes, the one-step form, or \"allow_unstable\": true");
}

/// A rule with fewer nodes than it would have by itself, which costs the pair its order.
void warnOfFewNodes(Reader& reader, const SchemeSpec& scheme, const PairProperties& properties,
                    const std::string& pointer) {
    const Settings usual = completeQuadrature(scheme.space, {scheme.quadrature.type, {}, {}});
    if (!usual.find("nodes")) {
        reader.warning(pointer + "/quadrature", "falls short: " + properties.shortfall,
                       "gauss has the order of the space");
    } else if (scheme.quadrature.integer("nodes") < usual.integer("nodes")) {
        reader.warning(pointer + "/quadrature/nodes", "falls short: " + properties.shortfall,
                       "usual are " + std::to_string(usual.integer("nodes")));
    }
}

/// A step of an oscillatory pair near one at which it is singular.
void checkResonance(Reader& reader, const System& system, const Scene& scene, const SchemeSpec& scheme,
                    const Discretization& pair, const std::string& pointer) {
    const double h = scheme.step.value;
    const auto found = resonanceOf(system, settled(pair, system, initialState(scene, system)), h);
    if (!found) return;
    reader.warning(pointer + "/step",
                   formatNumber(h) + " may be near a resonance of the space: it has " +
                       formatNumber(2 * found->periods, 6) +
                       " half periods of the fast motion, and only a fractional part from 0.1 to 0.5 is "
                       "safe; conditioning of "
                       "the step " +
                       formatNumber(found->conditioning, 2) + ", at the next safe one " +
                       formatNumber(found->usual, 2),
                   "the step " + formatNumber(found->near), found->near);
}

/// Steps of a body that turn it so far that the attitude may lose a thousandth of what it turns. Measured
/// over 60 rad on free bodies and a top with Gauss(s): 1e-3 is reached between 1.25 and 1.5 at degree 2, 2.25
/// and 2.5 at 3, 3 and 3.5 at 4. Newton's method goes on finding solutions up to about 4. A symmetric scheme
/// takes two half steps.
void checkTurn(Reader& reader, const System& system, const Scene& scene, const SchemeSpec& scheme,
               const Discretization& pair, const std::string& pointer) {
    constexpr double farthest[] = {1.25, 2.25, 3};  // of degrees 2, 3, 4
    if (!isBody(system) || pair.space.type != "lie-polynomial" || !scheme.composition.type.empty()) return;
    const int degree = pair.space.integer("degree");
    if (degree < 2 || degree > 4) return;
    const std::vector<double> x = initialState(scene, system).x;
    double rate = 0;
    for (std::size_t i = 0; i < 3; ++i) rate = std::hypot(rate, x[4 + i] / system.body().inertia[i]);
    const double limit = farthest[degree - 2] * (pair.space.flag("symmetric") ? 2 : 1), h = scheme.step.value;
    if (!(h * rate > limit) || !std::isfinite(h * rate)) return;
    const double perUnit = std::pow(10, 1 - std::floor(std::log10(limit / rate)));  // two digits
    const double usual = std::floor(limit / rate * perUnit) / perUnit;
    reader.warning(pointer + "/step",
                   formatNumber(h) + " rotates the body by " + formatNumber(h * rate, 3) +
                       " rad per step initially: beyond " + formatNumber(limit, 3) +
                       " rad a scheme of degree " + std::to_string(degree) +
                       " may have a relative error of a thousandth or more",
                   "a higher degree, or the step " + formatNumber(usual, 2), usual);
}

/// Refused and unstable pairs. False: the scheme cannot be made.
bool checkPair(Reader& reader, const SchemeSpec& scheme, const PairProperties& properties,
               const std::string& pointer) {
    if (!properties.refusal.empty()) {
        reader.error(pointer, "unsupported combination: " + properties.refusal,
                     properties.hint.empty() ? "another quadrature, or auto" : properties.hint);
        return false;
    }
    if (properties.stabilityLimit <= 0 && !scheme.allowsUnstable) {
        reader.error(pointer, "is unstable for every step, even on the harmonic oscillator",
                     "another quadrature, or \"allow_unstable\": true");
        return false;
    }
    if (!properties.shortfall.empty() && scheme.kind == SchemeSpec::Kind::pair)
        warnOfFewNodes(reader, scheme, properties, pointer);
    return true;
}

std::string durationText(double seconds) {
    if (seconds < 120) return formatNumber(std::round(seconds)) + " s";
    if (seconds < 7200) return formatNumber(std::round(seconds / 60)) + " min";
    if (seconds < 172800) return formatNumber(std::round(seconds / 3600)) + " h";
    return formatNumber(seconds / 86400, 2) + " days";
}

/// A trial is worth its time only for a scheme that may take long: no step takes more than some milliseconds,
/// but those of large wave functions.
void checkCost(Reader& reader, const System& system, const Scene& scene, const SchemeSpec& scheme,
               const std::string& pointer) {
    constexpr double longest = 60;
    const double slowestStep =
        5e-3 * (isWave(system) ? std::max(1.0, system.hamiltonian()->size() / 1024.0) : 1);
    const double duration = scene.end.value - scene.start.value;
    if (!scheme.isEnabled || (!scheme.tolerance && duration / scheme.step.value * slowestStep < longest))
        return;
    const double seconds = predictSeconds(scene, system, scheme);
    if (seconds > longest)
        reader.warning(pointer, "will take about " + durationText(seconds) + " of computing",
                       "a larger step, or an earlier end");
}

/// The makers know best what they cannot do.
void tryToMake(Reader& reader, const System& system, const Scene& scene, const SchemeSpec& scheme,
               const std::string& pointer) {
    try {
        const State initial = initialState(scene, system);
        makeScheme(system, scheme, scheme.step.value, initial);
        schemeStart(scene, system, scheme, scheme.step.value, initial);
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) reader.error(pointer + p.pointer, p.message, p.hint);
        return;
    }
    if (isWave(system))
        checkWaveStep(reader, system, scene, scheme, innerPairOf(scheme), stabilityLimitOf(scheme), pointer);
    else
        checkStability(reader, system, scene, scheme, stabilityLimitOf(scheme), pointer);
    if (const auto pair = innerPairOf(scheme)) {
        if (const std::string caution = describe(pair->space, pair->quadrature).caution; !caution.empty())
            reader.warning(pointer, caution);
        checkResonance(reader, system, scene, scheme, *pair, pointer);
        checkTurn(reader, system, scene, scheme, *pair, pointer);
    }
    checkCost(reader, system, scene, scheme, pointer);
}

void checkScheme(Reader& reader, const System* system, const Scene& scene, const SchemeSpec& scheme,
                 const std::string& pointer) {
    const std::size_t errorsBefore = reader.errors.size();
    const bool isTimeKnown = scene.end.value > scene.start.value;
    if (isTimeKnown) checkStepCount(reader, scene, scheme, pointer);
    const auto pair = innerPairOf(scheme);
    if (pair && !checkPair(reader, scheme, describe(pair->space, pair->quadrature), pointer)) return;
    if (system && isTimeKnown && reader.errors.size() == errorsBefore)
        tryToMake(reader, *system, scene, scheme, pointer);
}

/// False: the system cannot start from the initial data.
bool checkStart(Reader& reader, const System& system, const Scene& scene) {
    const ModelEntry* entry = findModel(scene.model.type);
    if (!entry || !entry->checkInitial || !reader.errors.empty()) return true;
    try {
        entry->checkInitial(scene.model, system, initialState(scene, system));
        return true;
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) reader.error("/model" + p.pointer, p.message, p.hint);
        return false;
    }
}

/// What is doubtful about the start itself.
void checkCaution(Reader& reader, const System& system, const Scene& scene) {
    if (!system.caution || !reader.errors.empty()) return;
    const std::string caution = system.caution(initialState(scene, system).x.data());
    if (!caution.empty()) reader.warning("/initial", "is " + caution, "raise /model/modes");
}

}  // namespace

void checkWhole(Reader& reader, const System* system, const Scene& scene,
                const std::vector<std::size_t>& places) {
    if (system && !checkStart(reader, *system, scene)) return;
    if (scene.end.value > scene.start.value) checkRows(reader, scene);
    if (system) checkCaution(reader, *system, scene);
    for (std::size_t i = 0; i < scene.schemes.size(); ++i)
        checkScheme(reader, system, scene, scene.schemes[i], childPointer("/schemes", places[i]));
    for (const SchemeSpec& scheme : scene.reference.scheme)
        checkScheme(reader, system, scene, scheme, "/reference/scheme");
    if (!system || !reader.errors.empty() || scene.reference.kind != ReferenceSpec::Kind::exact) return;
    if (!system->exact || !system->exact(initialState(scene, *system)))
        reader.error("/reference",
                     "no exact solution of " + scene.model.type + " is known for these initial data",
                     "take auto");
}

}  // namespace extremal
