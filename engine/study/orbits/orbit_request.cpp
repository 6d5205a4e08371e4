// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/orbits/orbit_request.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/known_value.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/orbits/orbit_family.hpp"
#include "engine/study/orbits/orbit_search.hpp"
#include "engine/view/catalog.hpp"
#include "engine/view/plane.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Shared = std::shared_ptr<const ResolvedScene>;

/// The scene with --period as its end, from 0: an expression is worth what it is in the scene's parameters.
Shared withPeriod(const ResolvedScene& scene, const std::string& period) {
    const auto number = parseNumber(period);
    const Value value = number ? Value(*number) : Value(period);
    const ReadScene read = readScene(toValue(scene.scene), {{"/time/end", value}});
    if (!read.resolved)
        throw InvalidScene("--period", read.errors.front().message,
                           "a positive number, or an expression in the scene's parameters: '2*pi/omega'");
    if (!(read.scene.end.value > 0))
        throw InvalidScene("--period", "must be positive, got " + formatNumber(read.scene.end.value));
    return read.resolved;
}

double periodIn(const ResolvedScene& scene, bool isGiven) {
    return isGiven ? scene.scene.end.value : std::abs(scene.scene.end.value - scene.scene.start.value);
}

void requireHold(const OrbitRequest& request, OrbitKind kind) {
    if (!request.hold.empty() && request.hold != "energy" && request.hold != "period")
        throw InvalidScene("--hold", "must be energy or period, got \"" + request.hold + "\"");
    if (kind == OrbitKind::conservative) {
        if (request.hold == "period" && request.energy)
            throw InvalidScene("--energy", "contradicts --hold period", "one of them");
        return;
    }
    const std::string why = kind == OrbitKind::forced
                                ? "the equations change with time, so that the period is given"
                                : "no energy is kept, so that the orbit is isolated";
    for (const auto& [option, isUsed] :
         {std::pair{"--hold", !request.hold.empty()}, std::pair{"--energy", request.energy.has_value()}})
        if (isUsed) throw InvalidScene(option, why, std::string("leave ") + option + " out");
}

OrbitPath pathOf(const OrbitRequest& request, bool isPeriodGiven) {
    const std::size_t equals = request.follow.find('=');
    const auto to =
        equals == std::string::npos ? std::nullopt : parseNumber(request.follow.substr(equals + 1));
    if (!to || !std::isfinite(*to) || equals == 0)
        throw InvalidScene(
            "--follow", "must be energy=VALUE, period=VALUE or POINTER=VALUE, got \"" + request.follow + "\"",
            "for example energy=0.125, or /model/k=2");
    constexpr int usual = 20;
    const int points = request.points == 0 ? usual : request.points;
    if (points < 2 || points > 10000)
        throw InvalidScene("--points", "must be 2 to 10000, got " + std::to_string(request.points));
    return {request.follow.substr(0, equals), *to, points,
            [isPeriodGiven](const ResolvedScene& scene) { return periodIn(scene, isPeriodGiven); }};
}

/// The orbit with twice as many steps from the one found, less which it is.
void measureBias(const Shared& scene, std::size_t scheme, const OrbitEquations& equations, double held,
                 OrbitAnswer& answer, const std::stop_token& stop) {
    const OrbitGuess orbit = guessOf(*answer.orbit);
    OrbitEquations finer(scene, scheme, 2 * answer.steps);
    finer.hold(answer.hold, held);
    finer.measureAs(equations, orbit);
    const OrbitSearch search = findOrbit(finer, orbit, stop);
    if (!search.orbit) return;
    answer.periodBias = orbit.period - search.orbit->period;
    const Vector by = equations.between(guessOf(*search.orbit), orbit);
    answer.startBias = by.head(by.size() - (equations.isPeriodFree() ? 1 : 0)).cwiseAbs().maxCoeff();
}

/// The document with an orbit as its motion.
Value sceneOf(const ResolvedScene& scene, std::size_t scheme, const OrbitAnswer& answer,
              const Value& document) {
    const bool isFamily = !answer.family.rows.empty();
    const PeriodicOrbit& orbit = isFamily ? answer.family.rows.back().orbit : *answer.orbit;
    Value written = document;
    const auto numbers = [&](std::size_t from, std::size_t count) {
        Value::Array all;
        for (std::size_t i = from; i < from + count; ++i) all.emplace_back(orbit.x[i]);
        return all;
    };
    const std::size_t n = orbit.x.size();
    Value initial{Value::Object{}};
    if (scene.system->hasCoordinates()) {
        initial.set("q", numbers(0, n / 2));
        initial.set("p", numbers(n / 2, n / 2));
    } else {
        initial.set("x", numbers(0, n));
    }
    written.set("initial", std::move(initial));
    const double start = scene.scene.start.value;
    written.find("time")->set("end", start + orbit.period);
    Value& own = written.find("schemes")->asArray()[scheme];
    own.set("step", orbit.period / static_cast<double>(answer.steps));
    own.set("enabled", true);
    return written;
}

StudyTable tableOf(const ResolvedScene& scene, const OrbitAnswer& answer, const std::string& number) {
    StudyTable table{"orbits", {}, {}};
    if (!number.empty()) table.columns = {number, "mark"};
    for (const char* column : {"period", "energy", "gap", "newton_steps", "stability", "trace"})
        table.columns.emplace_back(column);
    for (const Quantity& entry : stateColumns(*scene.system)) table.columns.push_back(entry.name);
    const auto add = [&](const PeriodicOrbit& orbit, OrbitStability stability, Value::Array lead) {
        Value::Array row = std::move(lead);
        for (const double value : {orbit.period, orbit.energy, orbit.gap}) row.push_back(knownNumber(value));
        row.emplace_back(static_cast<double>(orbit.closes.size()) - 1);
        row.emplace_back(std::string(name(stability)));
        row.emplace_back(orbit.trace);
        for (const double x : orbit.x) row.emplace_back(x);
        for (const auto& each : orbit.multipliers) {
            row.emplace_back(each.real());
            row.emplace_back(each.imag());
        }
        table.rows.push_back(std::move(row));
    };
    for (std::size_t k = 1; k <= answer.orbit->multipliers.size(); ++k)
        for (const char* part : {"re", "im"})
            table.columns.push_back("multiplier." + std::to_string(k) + "." + part);
    if (answer.family.rows.empty()) add(*answer.orbit, answer.stability, {});
    for (const OrbitRow& row : answer.family.rows) add(row.orbit, row.stability, {row.value, row.mark});
    return table;
}

/// Finds the manifold, and puts its starts into the section of the scene, or into a new one.
void addManifold(const Shared& scene, std::size_t scheme, const OrbitRequest& request, OrbitAnswer& answer,
                 const std::stop_token& stop) {
    constexpr int usual = 200;
    const int count = request.starts == 0 ? usual : request.starts;
    if (count < 2 || count > ViewStarts::most)
        throw InvalidScene("--starts", "must be 2 to " + std::to_string(ViewStarts::most) + ", got " +
                                           std::to_string(request.starts));
    Scene shown = readScene(answer.scene).scene;
    auto view = std::find_if(shown.views.begin(), shown.views.end(),
                             [](const View& each) { return keysOf(each.id, nullptr).hasZeros; });
    if (view == shown.views.end()) view = shown.views.insert(view, View{"section", {}, {}});
    const ViewPlane plane = *planeOf(*view, *scene->system);
    answer.manifold =
        manifoldOf(scene, scheme, answer.steps, *answer.orbit, plane, request.manifold, count, stop);
    view->starts = {};
    for (const auto& [x, y] : answer.manifold->starts) view->starts.points.push_back({{x, {}}, {y, {}}});
    const double time = answer.manifold->time;
    shown.end = Number{shown.start.value + (request.manifold == "stable" ? -time : time), {}};
    answer.scene = toValue(shown);
}

Value::Array numbersValue(const std::vector<double>& numbers) {
    Value::Array all;
    for (const double number : numbers) all.emplace_back(number);
    return all;
}

}  // namespace

OrbitAnswer seekOrbit(const ResolvedScene& given, const OrbitRequest& request, const std::stop_token& stop) {
    OrbitAnswer answer;
    const bool isPeriodGiven = !request.period.empty();
    const Shared scene =
        isPeriodGiven ? withPeriod(given, request.period) : std::make_shared<const ResolvedScene>(given);
    const std::size_t place = schemeNamed(*scene, request.scheme);
    const ResolvedScheme& scheme = scene->schemes[place];
    answer.scheme = scheme.spec.label;
    if (scene->scene.initial.second == Initial::Second::position)
        throw InvalidScene("/initial/q1", "the scene asks for a motion between two positions", "give p or v");
    const OrbitEquations trial(scene, place, 1);  // refuses before a guess is sought
    answer.kind = trial.kind();
    requireHold(request, answer.kind);
    if (request.points != 0 && request.follow.empty())
        throw InvalidScene("--points", "is of a family: without --follow there is one orbit",
                           "--follow energy=VALUE, or leave --points out");
    if (!request.manifold.empty() && !request.follow.empty())
        throw InvalidScene("--manifold", "is of one orbit, and --follow finds a family",
                           "--manifold with the scene.json of the family, whose start is the last orbit");
    if (request.starts != 0 && request.manifold.empty())
        throw InvalidScene("--starts", "is of a manifold", "--manifold unstable, or leave --starts out");
    const bool isFree = answer.kind != OrbitKind::forced && !isPeriodGiven;
    OrbitGuess guess;
    if (isFree) {
        guess = nearestReturn(*scene, place, answer.kind);
    } else {
        const auto entries = static_cast<Eigen::Index>(stateColumns(trial.system()).size());
        guess = {Eigen::Map<const Vector>(initialOf(*scene, scheme).x.data(), entries),
                 periodIn(*scene, isPeriodGiven)};
    }
    answer.steps = std::max(1LL, std::llround(guess.period / std::abs(scheme.spec.step.value)));
    OrbitEquations equations(scene, place, answer.steps);
    double held = 0;
    if (answer.kind == OrbitKind::conservative) {
        answer.hold = request.hold == "period" ? OrbitHold::period : OrbitHold::energy;
        held = answer.hold == OrbitHold::period ? guess.period
                                                : request.energy.value_or(equations.energyAt(guess.x));
    }
    equations.hold(answer.hold, held);
    equations.measure(guess);
    OrbitSearch search = findOrbit(equations, guess, stop);
    answer.closes = std::move(search.closes);
    answer.orbit = std::move(search.orbit);
    answer.problem = std::move(search.problem);
    answer.remedy = std::move(search.remedy);
    if (!answer.orbit) return answer;
    const PeriodicOrbit& orbit = *answer.orbit;
    answer.stability = equations.stabilityOf(orbit);
    measureBias(scene, place, equations, held, answer, stop);
    Value document = toValue(scene->scene);
    std::string number;
    if (!request.follow.empty()) {
        const OrbitPath path = pathOf(request, isPeriodGiven);
        number = path.name;
        answer.family = followFamily(*scene, place, equations, orbit, path, stop);
        if (number.starts_with('/'))
            document = toValue(readScene(document, {{number, answer.family.rows.back().value}}).scene);
    }
    answer.scene = sceneOf(*scene, place, answer, document);
    answer.table = tableOf(*scene, answer, number);
    if (!request.manifold.empty()) addManifold(scene, place, request, answer, stop);
    return answer;
}

Value orbitValue(const OrbitAnswer& answer) {
    Value document{Value::Object{}};
    document.set("scheme", answer.scheme);
    document.set("kind", answer.kind == OrbitKind::forced         ? "forced"
                         : answer.kind == OrbitKind::conservative ? "conservative"
                                                                  : "dissipative");
    document.set("held", answer.hold == OrbitHold::energy   ? Value("energy")
                         : answer.hold == OrbitHold::period ? Value("period")
                                                            : Value());
    document.set("steps", static_cast<double>(answer.steps));
    document.set("found", answer.isFound());
    document.set("closes", numbersValue(answer.closes));
    if (!answer.isFound()) {
        document.set("problem", answer.problem);
        document.set("remedy", answer.remedy);
        return document;
    }
    const PeriodicOrbit& orbit = *answer.orbit;
    document.set("period", orbit.period);
    document.set("period_bias", knownNumber(answer.periodBias));
    document.set("start_bias", knownNumber(answer.startBias));
    document.set("energy", knownNumber(orbit.energy));
    document.set("gap", orbit.gap);
    document.set("start", numbersValue(orbit.x));
    Value::Array multipliers;
    for (const auto& each : orbit.multipliers) multipliers.push_back(Value::Array{each.real(), each.imag()});
    document.set("multipliers", std::move(multipliers));
    document.set("trace", orbit.trace);
    document.set("stability", std::string(name(answer.stability)));
    if (answer.manifold) {
        Value::Array starts;
        for (const auto& [x, y] : answer.manifold->starts) starts.push_back(Value::Array{x, y});
        document.set("manifold_multiplier", answer.manifold->multiplier);
        document.set("manifold", std::move(starts));
    }
    if (!answer.family.rows.empty()) {
        document.set("family", rowsValue(answer.table));
        document.set("reached", answer.family.end.empty() && !answer.family.isStopped);
        document.set("end", answer.family.end);
    }
    return document;
}

}  // namespace extremal
