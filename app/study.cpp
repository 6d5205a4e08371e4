// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/load.hpp"
#include "app/offscreen.hpp"
#include "app/report.hpp"
#include "app/signals.hpp"
#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "app/watch_run.hpp"
#include "engine/core/text/fingerprint.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/studies/study_figure.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/request.hpp"
#include "engine/study/stability/stability_study.hpp"
#include "engine/study/study_log.hpp"
#include "engine/study/sweep_log.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::app {
namespace {

std::filesystem::path logOf(const std::filesystem::path& folder, const std::string& study) {
    return folder / (study + ".log");
}

/// Of a log, which knows what was asked for.
const StudyEntry& entryOf(const std::string& id) {
    if (const StudyEntry* const study = findStudy(id)) return *study;
    throw InvalidScene("arguments", "the log is of an unknown study \"" + id + "\"",
                       "a folder that extremal study has written");
}

template <class Study>
void writeResults(const StudyEntry& study, const Study& work, const std::vector<StudyTable>& tables,
                  const std::filesystem::path& folder, bool isPlotted, const Replacing& replacing) {
    for (const StudyTable& table : tables)
        writeFile(folder / (table.name + ".csv"), csvText(table), replacing);
    const std::vector<Figure> figures = studyFigures(study.item.id, work);
    if (!isPlotted || figures.front().view.empty()) return;
    const Offscreen qt;
    for (const Figure& figure : figures)
        for (const char* ending : {".svg", ".png"}) {
            const std::string& stem = &figure == &figures.front() ? study.item.id : figure.view;
            const std::filesystem::path file = folder / (stem + ending);
            requireReplaceable(file, replacing);
            const QString problem =
                saveFigure(QString::fromStdString(file.string()), figure, {900, 640}, Theme::light(), 2);
            if (!problem.isEmpty()) throw ExportError(file, problem.toStdString());
        }
}

std::string cellText(const Value& value) {
    if (value.isNumber()) return formatNumber(value.asNumber(), 4);
    if (value.isBool()) return value.asBool() ? "yes" : "";
    return value.isString() ? value.asString() : "";
}

/// Columns that no row fills are left out.
std::string tableText(const StudyTable& summary) {
    Table table;
    table.rows.resize(summary.rows.size() + 1);
    for (std::size_t c = 0; c < summary.columns.size(); ++c) {
        const auto isEmpty = [&](const Value::Array& row) { return cellText(row[c]).empty(); };
        if (std::all_of(summary.rows.begin(), summary.rows.end(), isEmpty)) continue;
        table.rows[0].push_back(summary.columns[c]);
        table.isRightAligned.push_back(
            std::any_of(summary.rows.begin(), summary.rows.end(),
                        [&](const Value::Array& row) { return row[c].isNumber(); }));
        for (std::size_t r = 0; r < summary.rows.size(); ++r)
            table.rows[r + 1].push_back(cellText(summary.rows[r][c]));
    }
    return table.text();
}

/// Where every scheme holds more than it may, the one that holds least; else null.
const SweepRow* leastOfRefused(const Sweep& sweep) {
    const SweepRow* least = nullptr;
    for (const SweepRow& row : sweep.rows()) {
        if (!(sweep.options().mostBytes > 0 && row.result.bytes > sweep.options().mostBytes)) return nullptr;
        if (!least || row.result.bytes < least->result.bytes) least = &row;
    }
    return least;
}

/// Whether a wanted error was reached; if none did, says which scheme came nearest.
bool isReached(const StudyEntry& study, const Sweep& sweep, const StudyTable& table) {
    if (study.over != StudyEntry::Over::wantedError) return true;
    const auto isDone = [](const SweepRow& row) { return row.result.isDone(); };
    if (std::any_of(sweep.rows().begin(), sweep.rows().end(), isDone)) return true;
    if (const SweepRow* const least = leastOfRefused(sweep)) {
        const std::string& reason = least->result.reason;
        printProblem("--memory",
                     "no scheme holds so little: the leanest, " +
                         sweep.scene().scene.schemes[least->point.scheme].label + ", " +
                         reason.substr(std::min(reason.find("holds"), reason.size())),
                     "a larger one, or --candidates all");
        return false;
    }
    if (sweep.options().budget > 0) {
        printProblem("--budget", "no scheme runs within it", "a larger one, or --candidates all");
        return false;
    }
    if (const std::string unjudged = sweep.unjudged(sweep.options().wantedError); !unjudged.empty()) {
        printProblem("--error", unjudged, "an earlier end (--set /time/end=...), or --metric energy");
        return false;
    }
    const Value rows = rowsValue(table);
    std::string nearest = "no scheme ran to the end";
    if (!rows.asArray().empty() && rows.asArray().front().find("error")->isNumber()) {
        const Value& first = rows.asArray().front();
        nearest = first.find("label")->asString() + ", " + formatNumber(first.find("error")->asNumber(), 3);
        if (const Value* const reason = first.find("reason"); reason && reason->isString())
            nearest += ": " + reason->asString();
    }
    std::string wished = formatNumber(sweep.options().wantedError, 3);
    for (const Wish& wish : sweep.options().wishes)
        wished += " with " + wish.metric + ' ' + formatNumber(wish.value, 3);
    printProblem("--error", "no scheme reaches " + wished, "the nearest: " + nearest);
    return false;
}
template <class Study>
bool isReached(const StudyEntry&, const Study&, const StudyTable&) {
    return true;  // no other study has a wanted error
}

/// The files, and what the terminal shows.
template <class Study>
int report(const StudyEntry& study, const Study& work, const StudyOptions& given, bool isInterrupted,
           const CommonOptions& options, const Replacing& replacing) {
    const std::vector<StudyTable> tables = tablesOf(study, work);
    writeResults(study, work, tables, given.out, given.isPlotted, replacing);
    const int code = isInterrupted ? interrupted : isReached(study, work, tables.front()) ? done : failed;
    if (options.isJson) {
        Value document;
        document.set("study", study.item.id);
        document.set("rows", rowsValue(tables.front()));
        for (std::size_t i = 1; i < tables.size(); ++i) document.set(tables[i].name, rowsValue(tables[i]));
        document.set("complete", work.isComplete());
        if (const double seconds = work.announced().seconds; seconds > 0)
            document.set("announced_seconds", std::round(1e3 * seconds) / 1e3);
        return print(writeJson(document), code);
    }
    if (isInterrupted) printProblem("", "interrupted: the results are partial", "--resume goes on");
    if (options.isQuiet) return code;
    std::string besides;
    for (std::size_t i = 1; i < tables.size() && study.besides; ++i) besides += tableText(tables[i]) + "\n";
    return print(
        tableText(summaryOf(study, work)) + "\n" + besides + study.item.id + ".csv in " + given.out + "\n",
        code);
}

std::string textOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InvalidScene("arguments", "cannot read " + file.string(), "a folder of extremal study");
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The folder's log; exactly one is expected.
std::filesystem::path onlyLogIn(const std::string& folder) {
    std::vector<std::filesystem::path> logs;
    for (const StudyEntry& e : studyEntries())
        if (std::filesystem::exists(logOf(folder, e.item.id))) logs.push_back(logOf(folder, e.item.id));
    if (logs.size() != 1)
        throw InvalidScene(
            "arguments", folder + (logs.empty() ? " has no log of a study" : " has logs of several studies"),
            "the folders that extremal study --shard I/N has written");
    return logs.front();
}

/// Before the work: what it writes may be written. `scene`: null of a study that has none.
void writeScene(const StudyEntry& study, const Scene* scene, const StudyOptions& options,
                const Replacing& replacing) {
    const std::filesystem::path folder = options.out;
    const std::string text = scene ? extremal::writeScene(*scene) : std::string();
    if (scene) requireReplaceable(folder / "scene.json", replacing, text);
    requireReplaceable(folder / (study.item.id + ".csv"), replacing,
                       csvText({study.item.id, study.columns, {}}));
    if (options.isPlotted)
        for (const char* ending : {".svg", ".png"})
            requireReplaceable(folder / (study.item.id + ending), replacing);
    prepareFolder(folder);
    if (scene) writeFile(folder / "scene.json", text, replacing);
}

template <class Study>
int runStudy(const StudyEntry& study, Study work, const Scene* scene, const StudyOptions& options,
             const CommonOptions& common, const Replacing& replacing) {
    InterruptWatch watch;
    const auto file = logOf(options.out, study.item.id);
    requireReplaceable(file, replacing);
    writeScene(study, scene, options, replacing);
    const std::string head = headOf(study.item.id, work);
    std::vector<std::string> known;
    StudyLog log = options.isResumed ? StudyLog::resume(file, head, known, replacing)
                                     : StudyLog::begin(file, head, replacing);
    for (const std::string& line : known) (void)takeLine(line, work);
    const bool isInterrupted = runAndWait(work, log, watch, common);
    return report(study, work, options, isInterrupted, common, replacing);
}

/// `heads`: the first lines of the logs, all alike.
template <class Study>
int mergeLogs(const StudyEntry& study, Study work, const Scene* scene, const StudyOptions& options,
              const CommonOptions& common) {
    std::vector<int> owners(work.size(), -1);
    for (std::size_t f = 0; f < options.folders.size(); ++f)
        for (const std::string& line : linesOf(logOf(options.folders[f], study.item.id))) {
            const std::optional<std::size_t> point = takeLine(line, work);
            if (!point) continue;
            int& owner = owners[*point];
            if (owner >= 0 && owner != static_cast<int>(f))
                throw InvalidScene("arguments",
                                   options.folders[f] + " and " +
                                       options.folders[static_cast<std::size_t>(owner)] +
                                       " both have point " + std::to_string(*point),
                                   "every shard once");
            owner = static_cast<int>(f);
        }
    const auto missing = std::count(owners.begin(), owners.end(), -1);
    if (missing > 0)
        throw InvalidScene(
            "arguments",
            std::to_string(missing) + " of " + std::to_string(work.size()) + " points are missing",
            "every shard, each run to its end");
    Replacing replacing{common.isForced, {}};
    for (const std::string& folder : options.folders)
        for (const std::string& name : {study.item.id + ".log", std::string("scene.json")})
            replacing.read.push_back(std::filesystem::path(folder) / name);
    writeScene(study, scene, options, replacing);
    return report(study, work, options, false, common, replacing);
}

}  // namespace

int studyVerb(const std::string& scene, const StudyOptions& options, const CommonOptions& common) {
    return guarded(sceneName(scene), [&] {
        const StudyEntry& study = knownStudy(options);
        ReadScene read;
        const bool hasOwnScenes = study.over == StudyEntry::Over::extremes && options.x.empty();
        const bool hasScene = !hasOwnScenes && !scene.empty();
        if (hasScene) {
            read = loadScene(scene, common);
            if (!reportScene(scene, read, common)) return static_cast<int>(unusable);
        }
        return std::visit(
            [&](auto&& work) {
                return runStudy(study, std::forward<decltype(work)>(work), hasScene ? &read.scene : nullptr,
                                options, common, replacingOf(scene, read, common));
            },
            makeStudy(study, options, hasScene ? read.resolved.get() : nullptr, common.threads));
    });
}

int mergeVerb(const StudyOptions& options, const CommonOptions& common) {
    return guarded("", [&] {
        std::string head;
        for (const std::string& folder : options.folders) {
            const std::vector<std::string> lines = linesOf(onlyLogIn(folder));
            if (lines.empty())
                throw InvalidScene("arguments", folder + ": its log has no line that can be read",
                                   "a folder that extremal study has written");
            if (head.empty()) head = lines.front();
            if (lines.front() != head)
                throw InvalidScene(
                    "arguments",
                    folder + " is of another study, scene or option than " + options.folders.front(),
                    "shards of one study");
        }
        const std::filesystem::path first = options.folders.front();
        const Value what = parseJson(head);
        const StudyEntry& study = entryOf(what.find("study")->asString());
        const bool isChanged = what.find("options")->find("x") != nullptr;
        if (study.over == StudyEntry::Over::extremes && !isChanged) {
            const Value* const withLong = what.find("options")->find("long");
            return mergeLogs(study, ExtremesStudy({}, 0, withLong && withLong->asBool()), nullptr, options,
                             common);
        }
        const ReadScene read = readScene(textOf(first / "scene.json"), {}, first.string());
        if (!read.resolved) {
            printProblems((first / "scene.json").string(), read.errors);
            return static_cast<int>(unusable);
        }
        if (!what.find("scene") || fingerprint(writeScene(read.scene)) != what.find("scene")->asString())
            throw InvalidScene("arguments", first.string() + ": scene.json is not the scene of the log",
                               "the folder as extremal study wrote it");
        const Value& given = *what.find("options");
        if (study.over == StudyEntry::Over::extremes)
            return mergeLogs(study, ExtremesStudy(*read.resolved, extremesOptionsOf(given)), &read.scene,
                             options, common);
        if (study.over == StudyEntry::Over::usableSteps)
            return mergeLogs(study, LimitsStudy(*read.resolved, limitsOptionsOf(given)), &read.scene, options,
                             common);
        if (study.over == StudyEntry::Over::numbers)
            return mergeLogs(study, StabilityStudy(*read.resolved, stabilityOptionsOf(given)), &read.scene,
                             options, common);
        if (study.over == StudyEntry::Over::testEquation)
            return mergeLogs(study, LinearStudy(*read.resolved, linearOptionsOf(given)), &read.scene, options,
                             common);
        return mergeLogs(study, Sweep(*read.resolved, optionsOf(given)), &read.scene, options, common);
    });
}

}  // namespace extremal::app
