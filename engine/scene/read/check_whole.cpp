// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/baseline/parts.hpp"
#include "engine/core/duration.hpp"
#include "engine/core/library_exceptions.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/work.hpp"
#include "engine/family/frequency.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/mechanism/mechanism_start.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/start_remark.hpp"
#include "engine/model/parts/varied_numbers.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/companion.hpp"
#include "engine/scene/outlook/cost.hpp"
#include "engine/scene/outlook/local_errors.hpp"
#include "engine/scene/outlook/premise.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"
#include "engine/scene/outlook/sensitivities.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"

namespace extremal {
namespace {

/// Rows of one scheme that fit in memory with ease; a larger file is hardly what was meant.
constexpr double maxRows = 2e7;
/// Of all schemes together: a scene may come from a stranger, and has to fit in memory as a whole.
constexpr double maxRowsTogether = 5e7;
/// Of a scheme in a scene that does not say how often.
constexpr double usualRows = 2000;

void checkStepCount(Reader& reader, const Scene& scene, const SchemeSpec& scheme,
                    const std::string& pointer) {
    const double h = scheme.step.value, start = scene.start.value, end = scene.end.value;
    if (scheme.tolerance) return;
    const double length = timeSpan(scene).length(), steps = length / h;
    const double largest = std::max(std::fabs(start), std::fabs(end));
    if (steps > scene.maxSteps)
        reader.error(pointer + "/step",
                     "needs " + formatNumber(steps, 3) + " steps from " + formatNumber(start) + " to " +
                         formatNumber(end) + ", the limit is " + formatNumber(scene.maxSteps),
                     "take a larger step, or raise /limits/steps");
    else if (largest + h == largest)
        reader.error(pointer + "/step",
                     "is too small to change t near " + formatNumber(largest) + ", got " + formatNumber(h));
    else if (h > length * (1 + 1e-9) + 1e-9 * h)
        reader.warning(pointer + "/step", "is longer than the run: no step is taken, got " + formatNumber(h));
}

void checkRows(Reader& reader, const Scene& scene) {
    const auto schemes = static_cast<double>(std::count_if(scene.schemes.begin(), scene.schemes.end(),
                                                           [](const SchemeSpec& s) { return s.isEnabled; }));
    const double rows = scene.every ? timeSpan(scene).length() / scene.every->value : usualRows;
    if (rows > maxRows)
        reader.error("/output/every",
                     "asks for " + formatNumber(rows, 3) + " rows, the limit is " + formatNumber(maxRows),
                     "a larger interval");
    else if (rows * schemes > maxRowsTogether)
        reader.error(scene.every ? "/output/every" : "/schemes",
                     "asks for " + formatNumber(rows * schemes, 3) +
                         " rows of all schemes together, the limit is " + formatNumber(maxRowsTogether),
                     scene.every ? "a larger interval, or fewer schemes" : "fewer schemes");
}

/// At all frequencies that are known: those of the linearisation at the start.
void checkStability(const SchemeCase& at, const ResolvedScheme& scheme, Findings& findings) {
    const auto stability = stabilityOf(scheme);
    if (!stability || stability->intervals.empty()) return;
    checkLinearStability(at, linearFrequencies(at.system, at.initial), *stability, findings);
}

/// A rule with fewer nodes than it would have by itself, which costs the discretization its order.
void warnOfFewNodes(Reader& reader, const SchemeSpec& scheme, const Properties& properties,
                    const std::string& pointer) {
    const Settings usual = completeQuadrature(scheme.space, {scheme.quadrature.type, {}, {}});
    if (const Value* nodes = usual.find("nodes"); !nodes || !nodes->isNumber()) {
        reader.warning(pointer + "/quadrature", "falls short: " + properties.shortfall,
                       "gauss has the order of the space", {}, "few-nodes");
    } else if (scheme.quadrature.integer("nodes") < usual.integer("nodes")) {
        reader.warning(pointer + "/quadrature/nodes", "falls short: " + properties.shortfall,
                       "usual are " + std::to_string(usual.integer("nodes")), {}, "few-nodes");
    }
}

/// Unsupported combinations, and those that are unstable for every step. False: the scheme cannot be made.
bool checkDiscretization(Reader& reader, const SchemeSpec& scheme, const Properties& properties,
                         const std::string& pointer) {
    if (!properties.place.empty()) {
        reader.error(pointer + properties.place, properties.refusal, properties.hint, "refused");
        return false;
    }
    if (!properties.refusal.empty()) {
        reader.error(pointer, "unsupported combination: " + properties.refusal,
                     properties.hint.empty() ? "another quadrature, or auto" : properties.hint, "refused");
        return false;
    }
    if (properties.stabilityLimit <= 0 && !scheme.allowsUnstable) {
        const std::string& reason = properties.instability;
        reader.error(pointer,
                     "is unstable for every step" +
                         (reason.empty() ? ", even on the harmonic oscillator" : ": " + reason),
                     (properties.hint.empty() ? "another quadrature" : properties.hint) +
                         ", or \"allow_unstable\": true",
                     "refused");
        return false;
    }
    if (!properties.shortfall.empty() && scheme.kind == SchemeSpec::Kind::discretization)
        warnOfFewNodes(reader, scheme, properties, pointer);
    return true;
}

SchemeCase caseOf(const ResolvedScene& scene, const ResolvedScheme& scheme) {
    return {*systemOf(scene, scheme), initialOf(scene, scheme), scheme.discretization,
            scheme.spec.step.value,   scheme.isComposed(),      scheme.spec.allowsUnstable,
            scene.scene.end.value};
}

/// A trial is worth its time only for a scheme that may take long: no step takes more than some milliseconds,
/// unless its family says so.
void checkCost(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
               const std::string& pointer) {
    constexpr double longest = longWithoutWarning;
    if (!scheme.spec.isEnabled) return;
    // A baseline that knows how much its step has to do has said so without a trial, which may take long.
    const bool isSaid = std::any_of(reader.warnings.begin(), reader.warnings.end(), [&](const Problem& p) {
        return p.topic == "duration" && p.pointer == pointer;
    });
    if (isSaid) return;
    if (!scheme.isAdaptive()) {
        const Family* const family = scheme.family ? scheme.family : familyFor(*scene.system);
        const auto* const slowest = family ? family->parts.find<SlowestStep>() : nullptr;
        const double slowestStep = slowest ? slowest->seconds(caseOf(scene, scheme)) : 5e-3;
        if (timeSpan(scene.scene).length() / scheme.spec.step.value * slowestStep < longest) return;
    }
    work::spend(1e7);                     // some milliseconds
    constexpr double longestTrial = 2e9;  // operations: some seconds
    double seconds = 0;
    bool isBound = false;
    try {
        const work::Account trial(longestTrial);
        seconds = predictSeconds(scene, scheme);
    } catch (const work::Exceeded&) {  // in the first step
        seconds = timeSpan(scene.scene).length() / scheme.spec.step.value * longestTrial * 1e-9;
        isBound = true;
    }
    constexpr double lifetime = 3e9;
    if (seconds > lifetime && scheme.isAdaptive())
        reader.warning(
            pointer,
            "its first steps are so short that they lead nowhere: the motion may end at its start, "
            "or be held there by forces that jump",
            "another start, or another formula", {}, "duration");
    else if (seconds > longest)
        reader.warning(pointer,
                       isBound ? "will take more than " + durationText(seconds) + " of computing"
                               : "will take about " + durationText(seconds) +
                                     " of computing, to within a factor of " + formatNumber(predictedWithin),
                       "a larger step, or an earlier end", {}, "duration");
}

/// Tables of forces that bend inside a step, where schemes lose their order.
void checkKinks(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
                const std::string& pointer) {
    const Force* const force = systemOf(scene, scheme)->parts.find<Force>();
    if (!force || force->kinks.empty() || scheme.isAdaptive() || !(scheme.spec.step.value > 0)) return;
    constexpr double roundOff = 1e-9;  // of a step
    const double h = scheme.spec.step.value, start = scene.scene.start.value;
    const TimeSpan span = timeSpan(scene.scene);
    const auto bends = [&](double t) {
        const double steps = std::abs(t - start) / h;
        return t > span.first && t < span.last &&
               std::abs(steps - std::round(steps)) > roundOff * (1 + steps);
    };
    const auto found = std::find_if(force->kinks.begin(), force->kinks.end(), bends);
    if (found == force->kinks.end()) return;
    reader.warning(pointer + "/step",
                   "a table of the forces bends at t = " + formatNumber(*found, 6) +
                       ", inside a step: there the error is irregular, and no better with a higher degree",
                   "steps that end at the times of the table", {}, "table-bends");
}

/// What is known to be doubtful of steps that follow a monitor.
void checkMonitor(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
                  const std::string& pointer) {
    const Settings& settings = scheme.spec.monitor;
    const auto monitor = makeMonitor(settings, *scene.system, hamiltonianFrom(*scene.system));
    if (!isEven(*monitor, scene.initial))
        reader.warning(pointer + "/monitor",
                       "is not reversible: it changes when all momenta change their sign, so that a motion "
                       "that turns back takes other steps",
                       "a function of coordinates and of even powers of momenta", {}, "monitors");
    if (settings.type == "arclength" && scheme.claims.order > 2)
        reader.warning(pointer + "/monitor",
                       "gains little at order " + std::to_string(scheme.claims.order) +
                           ": steps of equal length are long where the motion is fast",
                       "auto, or a typed one", {}, "monitors");
}

/// Of its family or its baseline, what stands against its step.
void checkStep(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
               const std::string& pointer) {
    if (scheme.isAdaptive()) return;
    const SchemeCase at = caseOf(scene, scheme);
    Findings findings;
    if (scheme.isMonitored()) return checkMonitor(reader, scene, scheme, pointer);
    const auto* const own = scheme.baseline ? scheme.baseline->parts.find<StepCheck>() : nullptr;
    if (own)
        own->check(at, findings);
    else if (!scheme.isTested() && linearTestOf(*scene.system) == LinearTest::oscillator)
        checkStability(at, scheme, findings);
    if (!scheme.properties.caution.empty()) findings.warning("", scheme.properties.caution);
    if (scheme.family && !scheme.isTested()) scheme.family->check(at, findings);
    reader.add(pointer, findings);
}

/// What is observed of tangent maps, where the scheme has none.
void checkTangent(Reader& reader, const Scene& scene, const Integrator& integrator,
                  const std::string& pointer) {
    if (integrator.tangentSize() > 0) return;
    std::vector<std::string> lacking;
    for (const std::string& id : scene.observe)
        if (const ObservableEntry* entry = findObservable(id); entry && !entry->variations.isEmpty())
            lacking.push_back(id);
    if (!lacking.empty())
        reader.warning(pointer,
                       "has no tangent map: " + integrator.tangentProblem() +
                           "; these columns stay empty for it: " + joinNames(lacking),
                       "another scheme, or do not observe them", {}, "tangent-map");
}

/// Local errors, where they are observed and the scheme has none.
void checkLocalErrors(Reader& reader, const Scene& scene, const ResolvedScheme& scheme, const System& system,
                      const Integrator& integrator, const std::string& pointer) {
    const bool isWanted = std::any_of(scene.observe.begin(), scene.observe.end(), [](const std::string& id) {
        const ObservableEntry* entry = findObservable(id);
        return entry && entry->variations.errors;
    });
    const std::string problem = localErrorProblem(scheme, system, integrator);
    if (isWanted && !problem.empty() && integrator.tangentSize() > 0)
        reader.warning(pointer,
                       "has no local errors: it has " + problem + "; their columns stay empty for it",
                       "another scheme, or do not observe them", {}, "local-errors");
}

/// Derivatives by numbers, where they are observed and the scheme has none.
void checkSensitivities(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
                        const Integrator& integrator, double step, const std::string& pointer) {
    if (!systemOf(scene, scheme)->parts.find<VariedNumbers>() || integrator.tangentSize() == 0) return;
    const std::string problem = sensitivityProblem(scene, scheme, integrator, step, initialOf(scene, scheme));
    if (!problem.empty())
        reader.warning(pointer, "has not all sensitivities: " + problem + "; such columns stay empty for it",
                       "other numbers in /sensitivity, or another scheme", {}, "sensitivity");
}

/// What is observed on the way back from the end, where the scheme has none.
void checkWayBack(Reader& reader, const Scene& scene, const ResolvedScheme& scheme,
                  const std::string& pointer) {
    if (scheme.isFixed() || scheme.isMonitored()) return;
    for (const std::string& id : scene.observe)
        if (const ObservableEntry* entry = findObservable(id); entry && entry->needsWayBack)
            reader.warning(
                pointer,
                "chooses its steps, and " + id + " needs the same steps backwards: its column stays empty",
                "a scheme with a fixed step, or do not observe it", {}, "way-back");
}

/// The makers know best what they cannot do.
void tryToMake(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
               const std::string& pointer) {
    // What integrators set up is in proportion to the state, but for tables, which are counted themselves.
    work::spend(1e3 * static_cast<double>(initialOf(scene, scheme).x.size()));
    try {
        const double step = signedStep(scene.scene, scheme.spec.step.value);
        contained("", [&] {
            const auto integrator = scheme.make(*systemOf(scene, scheme), step, initialOf(scene, scheme));
            checkTangent(reader, scene.scene, *integrator, pointer);
            checkLocalErrors(reader, scene.scene, scheme, *systemOf(scene, scheme), *integrator, pointer);
            checkWayBack(reader, scene.scene, scheme, pointer);
            checkSensitivities(reader, scene, scheme, *integrator, step, pointer);
            schemeStart(scene, scheme, step);
            checkStep(reader, scene, scheme, pointer);
            checkKinks(reader, scene, scheme, pointer);
        });
    } catch (const InvalidScene& e) {
        return reader.add(pointer, {e.problems(), {}});
    }
    if (reader.errors.empty()) checkCost(reader, scene, scheme, pointer);
}

void checkScheme(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
                 const std::string& pointer) {
    const std::size_t errorsBefore = reader.errors.size();
    const bool isTimeKnown = scene.scene.end.value != scene.scene.start.value;
    if (isBackwards(scene.scene) && scheme.grid == TimeGrid::free && !scheme.isMonitored())
        reader.error(pointer,
                     "cannot run backwards in time, because the steps are its unknowns, and positive",
                     "a scheme with given steps or under error control, or an end after the start");
    if (isTimeKnown) checkStepCount(reader, scene.scene, scheme.spec, pointer);
    if (scheme.family && !checkDiscretization(reader, scheme.spec, scheme.properties, pointer)) return;
    if (scene.system && isTimeKnown && reader.errors.size() == errorsBefore)
        tryToMake(reader, scene, scheme, pointer);
}

/// Whether the scheme has a companion, where companions are the reference.
void checkCompanion(Reader& reader, const ResolvedScene& scene, const ResolvedScheme& scheme,
                    const std::string& pointer, std::vector<Problem>& lacking) {
    const System& system = *systemOf(scene, scheme);
    try {
        contained("", [&] {
            (void)companionOf(scheme, system).make(system, scheme.spec.step.value, initialOf(scene, scheme));
        });
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) lacking.push_back({pointer, p.message, p.hint});
        return;
    }
    if (const double turned = unresolvedTurn(scheme, system, initialOf(scene, scheme)); turned > 0)
        reader.warning(pointer,
                       "has an error bar that is open from the start: its step is " +
                           formatNumber(turned, 2) +
                           " rad of the fastest motion, which neither it nor its companion needs to follow",
                       "use \"auto\" as the reference", {}, "error-bars");
}

/// A scheme without a companion has no error bar, which is a warning as long as another has one.
void checkCompanions(Reader& reader, const ResolvedScene& scene, const std::vector<std::size_t>& places) {
    if (scene.scene.reference.kind != ReferenceSpec::Kind::companion) return;
    std::vector<Problem> lacking;
    std::size_t enabled = 0;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        if (!scene.schemes[i].spec.isEnabled) continue;
        ++enabled;
        const work::Part part(childPointer("/schemes", places[i]));
        checkCompanion(reader, scene, scene.schemes[i], childPointer("/schemes", places[i]), lacking);
    }
    const bool isRefused = lacking.size() >= enabled;
    for (const Problem& p : lacking)
        isRefused ? reader.error(p.pointer, p.message, p.hint, "error-bars")
                  : reader.warning(p.pointer, p.message + "; there is no error bar for it", p.hint, {},
                                   "error-bars");
}

/// The state at the start. False: the system cannot start from the initial data.
bool checkStart(Reader& reader, ResolvedScene& scene) {
    const ModelEntry* entry = findModel(scene.scene.model.type);
    std::string prefix;
    try {
        scene.initial = contained("/initial", [&] { return initialState(scene.scene, *scene.system); });
        prefix = "/model";
        if (entry && entry->checkInitial && reader.errors.empty())
            entry->checkInitial(scene.scene.model, *scene.system, scene.initial);
        const State given = givenState(scene.scene, *scene.system);
        // Where nothing was said of velocities, motors give them.
        const bool isAtRest = scene.scene.initial.second == Initial::Second::none &&
                              std::all_of(given.x.begin() + scene.system->dimension(), given.x.end(),
                                          [](double p) { return p == 0; });
        const std::string note =
            isAtRest ? std::string() : projectionNote(*scene.system, given, scene.initial);
        if (!note.empty())
            reader.warning("/initial", note, "velocities along the constraints", {}, "mechanisms");
        if (const auto* const remark = scene.system->parts.find<StartRemark>()) {
            const StartRemark::Remark made = remark->of(scene.scene.initial.given);
            if (!made.message.empty()) reader.warning("/initial" + made.pointer, made.message, made.hint);
        }
        return true;
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) reader.error(prefix + p.pointer, p.message, p.hint);
        return false;
    }
}

/// What is doubtful about the start itself.
void checkCaution(Reader& reader, const ResolvedScene& scene) {
    if (!scene.system->caution || !reader.errors.empty()) return;
    const std::string caution = scene.system->caution(scene.initial.x.data());
    const char* const resolution = scene.scene.model.find("cells") ? "/model/cells" : "/model/modes";
    if (!caution.empty()) reader.warning("/initial", "is " + caution, std::string("raise ") + resolution);
}

bool measuresErrors(const Scene& scene) {
    return std::any_of(scene.observe.begin(), scene.observe.end(), [](const std::string& id) {
        const ObservableEntry* entry = findObservable(id);
        return entry && entry->needsReference;
    });
}

/// A typed exact solution must solve its equation, whatever it serves for. Where one that solves it does not
/// meet the boundary, the distance from it is not the error of a scheme.
void checkPremise(Reader& reader, const ResolvedScene& resolved) {
    const Scene& scene = resolved.scene;
    const System& system = *resolved.system;
    using Kind = ReferenceSpec::Kind;
    if (const std::string fault = residualFault(scene, system, resolved.initial); !fault.empty())
        return reader.error("/initial/exact", fault,
                            "for a start alone take u and u_t; else compare the formula with the wave speed, "
                            "material, coefficient and potential of the model");
    const Kind kind = scene.reference.kind;
    if ((kind != Kind::exact && kind != Kind::automatic) || !measuresErrors(scene)) return;
    const ExactPremise premise = premiseOf(scene, system, resolved.initial);
    if (!premise.isViolated) return;
    const std::string text = "exact solution: " + premise.text;
    if (kind == Kind::automatic && isComputedInstead(scene, system))
        reader.warning("/reference", text + ": a computed reference is used");
    else if (!premise.pointer.empty())
        reader.warning(premise.pointer, text + ": " + premise.consequence, premise.remedy);
    else
        reader.warning("/reference", text + ": its estimated error contains that",
                       isBackwards(scene) ? "a larger domain" : "take auto");
}

/// Exact solutions go either way in time; others are computed forwards.
void checkReference(Reader& reader, const ResolvedScene& resolved) {
    const Scene& scene = resolved.scene;
    using Kind = ReferenceSpec::Kind;
    const Kind kind = scene.reference.kind;
    const bool needsForwards = isBackwards(scene) && measuresErrors(scene) && kind != Kind::exact &&
                               kind != Kind::none && kind != Kind::file;
    if (kind != Kind::exact && !needsForwards) return;
    if (kind != Kind::scheme && kind != Kind::companion &&
        exactSolution(scene, *resolved.system, resolved.initial))
        return;
    if (needsForwards)
        reader.error("/reference", "is computed forwards in time, and this run goes backwards",
                     "take none, or an end after the start");
    else
        reader.error("/reference",
                     "no exact solution of " + scene.model.type + " is known for these initial data",
                     "take auto");
}

/// Puts a scheme on the mesh of its own, if it has one. Whether it can be there.
bool checkMesh(Reader& reader, ResolvedScheme& scheme, const Scene& scene, const std::string& place) {
    try {
        contained("", [&] { resolveSystem(scheme, scene); });
        return true;
    } catch (const InvalidScene& e) {
        // What the model says of a key that the space has set is said of the space.
        for (const Problem& p : e.problems()) {
            const bool isKey =
                p.pointer.size() > 1 && scheme.discretization.space.find(p.pointer.substr(1)) != nullptr;
            reader.error(place + "/space" + (isKey ? p.pointer : ""), p.message, p.hint);
        }
    }
    return false;
}

}  // namespace

void checkWhole(Reader& reader, ResolvedScene& resolved, const std::vector<std::size_t>& places) {
    const Scene& scene = resolved.scene;
    if (resolved.system && !checkStart(reader, resolved)) return;
    if (scene.end.value != scene.start.value) checkRows(reader, scene);
    if (resolved.system) checkCaution(reader, resolved);
    std::vector<bool> areThere(resolved.schemes.size(), true);
    for (std::size_t i = 0; i < resolved.schemes.size() && resolved.system; ++i) {
        if (!resolved.schemes[i].properties.refusal.empty()) continue;
        const std::string place = childPointer("/schemes", places[i]);
        const work::Part part(place);
        areThere[i] = checkMesh(reader, resolved.schemes[i], scene, place);
    }
    for (std::size_t i = 0; i < resolved.schemes.size(); ++i) {
        const std::string place = childPointer("/schemes", places[i]);
        const work::Part part(place);
        if (areThere[i]) checkScheme(reader, resolved, resolved.schemes[i], place);
    }
    if (resolved.system && reader.errors.empty()) checkCompanions(reader, resolved, places);
    for (const ResolvedScheme& scheme : resolved.reference)
        checkScheme(reader, resolved, scheme, "/reference/scheme");
    if (!resolved.system || !reader.errors.empty()) return;
    checkReference(reader, resolved);
    checkPremise(reader, resolved);
    checkStarts(reader, resolved);
}

}  // namespace extremal
