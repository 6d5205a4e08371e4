// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "app/load.hpp"
#include "app/report.hpp"
#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "app/watch_run.hpp"
#include "engine/core/known_value.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/cases/many_run.hpp"
#include "engine/run/cases/starts_file.hpp"
#include "engine/run/files/event_files.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/missing.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/study/catalog.hpp"

namespace extremal::app {
namespace {

std::string number(double value, int digits = 3) {
    return std::isfinite(value) ? formatNumber(value, digits) : "";
}

std::string duration(double seconds) {
    if (!std::isfinite(seconds)) return "";
    if (seconds < 1e-3) return formatNumber(seconds * 1e6, 3) + " µs";
    return seconds < 1 ? formatNumber(seconds * 1e3, 3) + " ms" : formatNumber(seconds, 3) + " s";
}

/// A number that the scene may have asked for in vain.
class Wanted {
public:
    Wanted(const Comparison& comparison, const SchemeResult& scheme)
        : missing_(missingFrom(comparison, scheme)) {}
    bool lacks(std::string_view observable) const {
        return std::any_of(missing_.begin(), missing_.end(),
                           [&](const Missing& m) { return m.observable == observable; });
    }
    std::string text(double value, std::string_view observable) const {
        return !std::isfinite(value) && lacks(observable) ? "not known" : number(value);
    }

private:
    std::vector<Missing> missing_;
};

std::string order(const Summary& s, const Wanted& wanted) {
    const std::string claimed = s.orderClaimed > 0 ? std::to_string(s.orderClaimed) : "";
    if (wanted.lacks("order")) return "not known" + (claimed.empty() ? "" : " of " + claimed);
    if (!std::isfinite(s.orderMeasured)) return claimed;
    return claimed.empty() ? number(s.orderMeasured) : number(s.orderMeasured) + " of " + claimed;
}

std::string summaryTable(const Comparison& comparison) {
    Table table;
    table.isRightAligned = {false, false, true, true, true, true, true, true, true, true, false, false};
    table.rows.push_back({"scheme", "status", "steps", "cpu", "evaluations", "energy error", "momentum error",
                          "max error", "final error", "order", "events", "solver"});
    for (const auto& scheme : comparison.schemes) {
        const Summary& s = scheme->summary;
        const Wanted wanted(comparison, *scheme);
        table.rows.push_back({s.label, name(s.status), std::to_string(s.steps), duration(s.cpuSeconds),
                              std::to_string(s.cost.evaluations), wanted.text(s.maxEnergyError, "energy"),
                              wanted.text(s.maxMomentumError, "momentum"), wanted.text(s.maxError, "error"),
                              wanted.text(s.finalError, "error"), order(s, wanted), eventsText(*scheme),
                              s.about});
    }
    // A column that no scheme fills says nothing.
    for (std::size_t c = table.rows[0].size(); c-- > 0;) {
        const auto isEmpty = [c](const auto& row) { return row[c].empty(); };
        if (!std::all_of(table.rows.begin() + 1, table.rows.end(), isEmpty)) continue;
        for (auto& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(c));
        table.isRightAligned.erase(table.isRightAligned.begin() + static_cast<std::ptrdiff_t>(c));
    }
    return table.text();
}

int printResult(const Comparison& comparison, const std::string& folder, int code,
                const CommonOptions& options) {
    if (options.isJson) return print(writeJson(summaryValue(comparison)), code);
    if (options.isQuiet) return code;
    std::string text = summaryTable(comparison);
    text.append("\n").append(std::to_string(summaryValue(comparison).find("files")->asArray().size()));
    text.append(code == interrupted ? " files with partial results in " : " files in ")
        .append(folder)
        .append("\n");
    return print(text, code);
}

}  // namespace

int runVerb(const std::string& scene, const RunVerbOptions& given, const CommonOptions& options) {
    const std::string& folder = given.out;
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    try {
        const Replacing replacing = replacingOf(scene, read, options);
        checkExport(read.scene, folder, replacing);
        InterruptWatch watch;
        RunOptions how{options.threads};
        constexpr double never = 1e6;
        if (given.checkpoint > 0 || given.isResumed)
            how.checkpoints = {folder, versionText(), given.checkpoint > 0 ? given.checkpoint : never,
                               given.isResumed};
        Run run(read.scene, how);
        prepareFolder(folder);
        run.start();
        const bool isInterrupted = waitFor(run, watch, options);
        const Comparison result = run.latest();
        exportComparison(result, folder, replacing);
        printFailures(result, sceneName(scene));
        const int code = printResult(result, folder, exitCode(result, isInterrupted), options);
        if (const std::string failure = run.checkpointFailure(); !failure.empty())
            printProblem(folder, "warning: a checkpoint could not be written: " + failure);
        if (isInterrupted)
            printProblem("", "interrupted: the results are partial",
                         run.hasCheckpoints() ? "--resume goes on from the last checkpoint" : "");
        else
            run.removeCheckpoints();
        return code;
    } catch (const InvalidScene& e) {
        return tellUnusable(e, sceneName(scene));
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    }
}

namespace {

struct MotionsAnswer {
    std::string scheme, problem, remedy, scene;
    std::vector<std::string> columns;  ///< of a state
    std::vector<std::vector<double>> starts;
    ManyMotions motions;
    bool isFound() const { return true; }

    std::size_t unfinished() const {
        return static_cast<std::size_t>(std::count_if(
            motions.all.begin(), motions.all.end(),
            [](const ManyMotions::Motion& motion) { return motion.outcome != Outcome::converged; }));
    }
    double largestError() const {
        double most = 0;
        for (const auto& motion : motions.all) most = std::max(most, std::abs(motion.energyError));
        return most;
    }
};

StudyTable motionsTable(const MotionsAnswer& answer) {
    StudyTable table{"motions", {"start"}, {}};
    for (const std::string& name : answer.columns) table.columns.push_back("start." + name);
    table.columns.emplace_back("t");
    for (const std::string& name : answer.columns) table.columns.push_back(name);
    for (const char* name : {"steps", "cause", "energy_error"}) table.columns.emplace_back(name);
    for (std::size_t i = 0; i < answer.starts.size(); ++i) {
        const ManyMotions::Motion& motion = answer.motions.all[i];
        Value::Array row{static_cast<double>(i)};
        for (const double x : answer.starts[i]) row.emplace_back(x);
        row.emplace_back(motion.t);
        for (const double x : motion.x) row.push_back(knownNumber(x));
        row.emplace_back(static_cast<double>(motion.steps));
        row.emplace_back(std::string(name(motion.outcome)));
        row.push_back(knownNumber(motion.energyError));
        table.rows.push_back(std::move(row));
    }
    return table;
}

Value motionsValue(const MotionsAnswer& answer) {
    Value document{Value::Object{}};
    document.set("scheme", answer.scheme);
    document.set("motions", static_cast<double>(answer.starts.size()));
    document.set("together", static_cast<double>(answer.motions.together));
    document.set("unfinished", static_cast<double>(answer.unfinished()));
    document.set("max_energy_error", knownNumber(answer.largestError()));
    return document;
}

}  // namespace

int motionsVerb(const std::string& scene, const MotionsOptions& given, const CommonOptions& options) {
    return runAnswerVerb<MotionsAnswer>(
        scene,
        {.out = given.out,
         .files = {"scene.json", "motions.csv", "motions.json"},
         .inputs = {given.starts},
         .doing = "computing motions",
         .unknown = "nothing is written",
         .work =
             [&](const ResolvedScene& resolved, const std::stop_token& stop) {
                 const std::size_t scheme = schemeNamed(resolved, given.scheme);
                 const System& system = *systemOf(resolved, resolved.schemes[scheme]);
                 MotionsAnswer answer;
                 answer.scheme = resolved.scene.schemes[scheme].label;
                 answer.scene = writeScene(resolved.scene);
                 for (const Quantity& column : stateColumns(system)) answer.columns.push_back(column.name);
                 answer.starts = readStartsFile(given.starts, system);
                 answer.motions = runMany(resolved, scheme, answer.starts, {options.threads, true, {}}, stop);
                 return answer;
             },
         .document = motionsValue,
         .written =
             [](const MotionsAnswer& answer, const Value& document) {
                 return AnswerFiles{
                     "motions", document, answer.scene, {{"motions.csv", csvText(motionsTable(answer))}}};
             },
         .text =
             [](const MotionsAnswer& answer) {
                 const std::size_t count = answer.starts.size(), unfinished = answer.unfinished();
                 return answer.scheme + ": " + std::to_string(count) + " motions, " +
                        std::to_string(answer.motions.together) + " of them together, " +
                        std::to_string(unfinished) + " not to the end; largest energy error " +
                        number(answer.largestError()) + "\n";
             }},
        options);
}

}  // namespace extremal::app
