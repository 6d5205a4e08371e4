// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "app/load.hpp"
#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/files/answer_files.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/study/orbits/arrivals.hpp"
#include "engine/study/orbits/orbit_request.hpp"

namespace extremal::app {
namespace {

std::string multiplierText(const PeriodicOrbit& orbit) {
    std::string text;
    for (std::size_t i = 0; i < orbit.multipliers.size(); ++i) {
        const auto& each = orbit.multipliers[i];
        if (each.imag() < 0) continue;  // said with the one above
        if (!text.empty()) text += ", ";
        text += formatNumber(each.real(), 6);
        if (each.imag() > 0) text += " ± " + formatNumber(each.imag(), 6) + "i";
    }
    return text;
}

std::string closesText(const std::vector<double>& closes) {
    std::string text;
    for (const double gap : closes) text += (text.empty() ? "" : ", ") + formatNumber(gap, 2);
    return text;
}

std::string orbitText(const OrbitAnswer& answer) {
    const PeriodicOrbit& orbit = *answer.orbit;
    std::string text = answer.scheme + ": period " + formatNumber(orbit.period, 13) + " in " +
                       std::to_string(answer.steps) + " steps";
    if (std::isfinite(answer.periodBias) && answer.periodBias != 0)
        text += " (" + formatNumber(std::abs(answer.periodBias), 2) +
                (answer.periodBias > 0 ? " longer" : " shorter") + " than with half the step)";
    if (answer.periodBias == 0 && std::isfinite(answer.startBias))
        text += " (its start is off by " + formatNumber(answer.startBias, 2) +
                " of its size from that with half the step)";
    if (std::isfinite(orbit.energy)) text += ", energy " + formatNumber(orbit.energy, 9);
    const std::size_t steps = orbit.closes.size() - 1;
    text += "\ncloses after " + std::to_string(steps) + (steps == 1 ? " step" : " steps") +
            " of Newton's method: " + closesText(orbit.closes) + "\n" +
            "multipliers: " + multiplierText(orbit) + "; " + std::string(name(answer.stability)) + "\n";
    return text;
}

std::string familyText(const OrbitAnswer& answer) {
    Table table;
    table.isRightAligned = {true, true, true, true, false, false};
    table.rows.push_back({answer.table.columns.front(), "period", "energy", "trace", "stability", ""});
    for (const OrbitRow& row : answer.family.rows)
        table.rows.push_back({formatNumber(row.value, 7), formatNumber(row.orbit.period, 10),
                              std::isfinite(row.orbit.energy) ? formatNumber(row.orbit.energy, 7) : "",
                              formatNumber(row.orbit.trace, 8), std::string(name(row.stability)), row.mark});
    return table.text();
}

/// The answer, once it is known, or nothing where it was interrupted.
std::optional<OrbitAnswer> seekWatched(const ResolvedScene& scene, const OrbitRequest& request,
                                       const CommonOptions& options) {
    InterruptWatch watch;
    OrbitAnswer answer;
    const bool isInterrupted =
        workAndWait([&](const std::stop_token& stop) { answer = seekOrbit(scene, request, stop); },
                    [] { return 0.0; }, [] { return std::string("seeking the orbit"); }, watch, options);
    if (isInterrupted && !answer.isFound()) return {};
    return answer;
}

std::string arrivalsText(const std::vector<Arrival>& arrivals) {
    Table table;
    table.isRightAligned = {false, true, false, false, false};
    table.rows.push_back({"scheme", "steps", "momentum", "misses", ""});
    for (const Arrival& each : arrivals) {
        std::string p;
        for (std::size_t i = each.start.size() / 2; i < each.start.size(); ++i)
            p += (p.empty() ? "" : ", ") + formatNumber(each.start[i], 13);
        table.rows.push_back({each.scheme, std::to_string(each.steps), p, closesText(each.misses),
                              std::string(name(each.outcome))});
    }
    return table.text();
}

int betweenVerb(const std::string& scene, const ReadScene& read, const OrbitOptions& orbit,
                const CommonOptions& options) {
    for (const auto& [option, isGiven] : {std::pair{"--period", !orbit.period.empty()},
                                          {"--energy", orbit.energy.has_value()},
                                          {"--hold", !orbit.hold.empty()},
                                          {"--follow", !orbit.follow.empty()},
                                          {"--manifold", !orbit.manifold.empty()},
                                          {"--starts", orbit.starts != 0}})
        if (isGiven)
            throw InvalidScene(option, "is for periodic orbits, and the scene has two positions",
                               "p or v in place of /initial/q1");
    const Replacing replacing = replacingOf(scene, read, options);
    const std::vector<Arrival> arrivals = seekArrivals(*read.resolved, orbit.scheme, orbit.momenta);
    const StudyTable table = arrivalsTable(*read.resolved, arrivals);
    int code = done;
    for (const Arrival& each : arrivals)
        if (each.outcome != Outcome::converged) {
            code = failed;
            printProblem(
                sceneName(scene) + ": " + each.scheme,
                "Newton's method finds no motion to the second position: " + std::string(name(each.outcome)),
                "a smaller step, or another momentum to begin with: --guess");
        }
    Value document{Value::Object{}};
    document.set("arrivals", rowsValue(table));
    const bool isFirstDone = arrivals.front().outcome == Outcome::converged;
    writeAnswer(
        {"orbit",
         document,
         isFirstDone ? writeScene(readScene(arrivalScene(*read.resolved, arrivals.front())).scene) : "",
         {{"arrivals.csv", csvText(table)}}},
        orbit.out, replacing);
    if (options.isJson) return print(writeJson(document), code);
    return options.isQuiet ? code
                           : print(arrivalsText(arrivals) + "\nscene.json, arrivals.csv and orbit.json in " +
                                       orbit.out + "\n",
                                   code);
}

}  // namespace

int orbitVerb(const std::string& scene, const OrbitOptions& orbit, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    return guarded(sceneName(scene), [&] {
        if (read.scene.initial.second == Initial::Second::position)
            return betweenVerb(scene, read, orbit, options);
        if (!orbit.momenta.empty())
            throw InvalidScene("--guess",
                               "is for motions between two positions, which the scene does not have",
                               "the start of the scene is the guess of a periodic orbit");
        const Replacing replacing = replacingOf(scene, read, options);
        const std::filesystem::path folder(orbit.out);
        for (const char* file : {"scene.json", "orbits.csv", "orbit.json"})
            requireReplaceable(folder / file, replacing);
        const std::optional<OrbitAnswer> answer = seekWatched(*read.resolved, orbit, options);
        if (!answer) {
            printProblem("", "interrupted: no orbit is known yet");
            return static_cast<int>(interrupted);
        }
        const Value document = orbitValue(*answer);
        if (!answer->isFound()) {
            printProblem(sceneName(scene) + ": " + answer->scheme, answer->problem, answer->remedy);
            return options.isJson ? print(writeJson(document), failed) : static_cast<int>(failed);
        }
        const ReadScene made = readScene(answer->scene);
        printProblems("orbit", made.errors);
        writeAnswer({"orbit",
                     document,
                     made.errors.empty() ? writeScene(made.scene) : "",
                     {{"orbits.csv", csvText(answer->table)}}},
                    folder, replacing);
        const bool isWhole = answer->family.end.empty() && !answer->family.isStopped;
        if (!isWhole)
            printProblem(sceneName(scene) + ": " + answer->scheme, answer->family.isStopped
                                                                       ? "interrupted: the family is partial"
                                                                       : answer->family.end);
        const int code = answer->family.isStopped ? interrupted : isWhole ? done : failed;
        if (options.isJson) return print(writeJson(document), code);
        if (options.isQuiet) return code;
        std::string text = orbitText(*answer);
        if (!answer->family.rows.empty()) text += "\n" + familyText(*answer);
        if (answer->manifold)
            text += orbit.manifold + " manifold of the multiplier " +
                    formatNumber(answer->manifold->multiplier, 6) + ": " +
                    std::to_string(answer->manifold->starts.size()) +
                    " starts in the section of scene.json\n";
        return print(text + "\nscene.json, orbits.csv and orbit.json in " + orbit.out + "\n", code);
    });
}

}  // namespace extremal::app
