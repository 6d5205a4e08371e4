#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/load.hpp"
#include "app/offscreen.hpp"
#include "app/report.hpp"
#include "app/study_work.hpp"
#include "app/signals.hpp"
#include "app/verbs.hpp"
#include "app/watch_run.hpp"
#include "engine/core/text.hpp"
#include "engine/figure/study_figure.hpp"
#include "engine/run/export.hpp"
#include "engine/scene/json.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/stability_study.hpp"
#include "engine/study/study_log.hpp"
#include "engine/study/sweep_log.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::app {
namespace {

std::filesystem::path logOf(const std::filesystem::path& folder, const std::string& study) {
    return folder / (study + ".log");
}

const StudyEntry& knownStudy(const std::string& id) {
    std::vector<std::string> names;
    for (const StudyEntry& e : studyEntries()) names.push_back(e.item.id);
    const StudyEntry* study = findStudy(id);
    if (!study) throw InvalidScene("arguments", "there is no study \"" + id + "\"", suggestName(id, names));
    return *study;
}

/// "2/4".
Shard parseShard(const std::string& text) {
    const std::size_t slash = text.find('/');
    const auto index = slash == std::string::npos ? std::nullopt : parseNumber(text.substr(0, slash)),
               count = slash == std::string::npos ? std::nullopt : parseNumber(text.substr(slash + 1));
    if (!index || !count || *index != std::floor(*index) || *count != std::floor(*count) || *count > 1e6 ||
        *index < 1 || *index > *count)
        throw InvalidScene("--shard", "must be I/N with I from 1 to N, got \"" + text + "\"",
                           "for example 1/4");
    return {static_cast<int>(*index), static_cast<int>(*count)};
}

/// Options that belong to another study are errors, so that none is silently ignored.
void refuseStrangers(const StudyEntry& entry, const StudyOptions& study) {
    using Over = StudyEntry::Over;
    const auto refuse = [&](bool isGiven, Over over, const char* option, const char* whose) {
        if (isGiven && entry.over != over)
            throw InvalidScene(option, "is not an option of " + entry.item.id,
                               std::string(whose) + " has it");
    };
    refuse(study.error != 0, Over::wantedError, "--error", "cheapest");
    refuse(!study.x.empty(), Over::numbers, "--x", "stability");
    refuse(!study.y.empty(), Over::numbers, "--y", "stability");
    refuse(study.findsLimits, Over::numbers, "--limit", "stability");
    refuse(study.isLong, Over::extremes, "--long", "extremes");
    for (const auto& [isGiven, option] :
         {std::pair{!study.steps.empty(), "--steps"}, {study.from != 0, "--from"}, {study.to != 0, "--to"}})
        refuse(isGiven, Over::steps, option, "convergence");
    if (entry.over == Over::wantedError && study.error == 0)
        throw InvalidScene("--error", "is required for " + entry.item.id, "for example --error 1e-6");
    if (entry.over == Over::numbers && study.x.empty())
        throw InvalidScene("--x", "is required for " + entry.item.id,
                           "for example '/schemes/*/step=0.01:1:50:log'");
}

Sweep sweepOf(const ResolvedScene& scene, const StudyOptions& study, const CommonOptions& common) {
    SweepOptions options;
    options.wantedError = study.error;
    options.metric = study.metric;
    options.isAtEnd = study.isFinal;
    options.ladder = {study.steps, study.from, study.to, study.points};
    if (study.steps.empty() && (study.from != 0 || study.to != 0) && study.points == 0)
        options.ladder.points = 12;
    if (study.points > 0 && study.from == 0 && study.to == 0)
        throw InvalidScene("--points", "needs --from and --to");
    options.repeat = study.repeat;
    options.only = study.only;
    if (!study.shard.empty()) options.shard = parseShard(study.shard);
    options.threads = common.threads;
    return {scene, options};
}

StabilityStudy stabilityOf(const ResolvedScene& scene, const StudyOptions& study,
                           const CommonOptions& common) {
    StabilityOptions options;
    options.x = parseAxis(study.x, "--x");
    if (!study.y.empty()) options.y = parseAxis(study.y, "--y");
    options.findsLimits = study.findsLimits;
    options.only = study.only;
    if (!study.shard.empty()) options.shard = parseShard(study.shard);
    options.threads = common.threads;
    return {scene, options};
}

LinearStudy linearOf(const ResolvedScene& scene, const StudyOptions& study, const CommonOptions& common) {
    LinearOptions options;
    options.only = study.only;
    if (!study.shard.empty()) options.shard = parseShard(study.shard);
    options.threads = common.threads;
    return {scene, options};
}

template <class Study>
void writeResults(const StudyEntry& study, const Study& work, const std::vector<StudyTable>& tables,
                  const std::filesystem::path& folder, bool isPlotted) {
    for (const StudyTable& table : tables) writeFile(folder / (table.name + ".csv"), csvText(table));
    const std::vector<Figure> figures = studyFigures(study.item.id, work);
    if (!isPlotted || figures.front().view.empty()) return;
    const Offscreen qt;
    for (const Figure& figure : figures)
        for (const char* ending : {".svg", ".png"}) {
            const std::string& stem = &figure == &figures.front() ? study.item.id : figure.view;
            const std::filesystem::path file = folder / (stem + ending);
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

/// Whether a wanted error was reached; if none did, says which scheme came nearest.
bool isReached(const StudyEntry& study, const Sweep& sweep, const StudyTable& table) {
    if (study.over != StudyEntry::Over::wantedError) return true;
    const auto isDone = [](const SweepRow& row) { return row.result.isDone(); };
    if (std::any_of(sweep.rows().begin(), sweep.rows().end(), isDone)) return true;
    const Value rows = rowsValue(table);
    std::string nearest = "no scheme ran to the end";
    if (!rows.asArray().empty() && rows.asArray().front().find("error")->isNumber())
        nearest = rows.asArray().front().find("label")->asString() + ", " +
                  formatNumber(rows.asArray().front().find("error")->asNumber(), 3);
    printProblem("--error", "no scheme reaches " + formatNumber(sweep.options().wantedError, 3),
                 "the nearest: " + nearest);
    return false;
}
template <class Study>
bool isReached(const StudyEntry&, const Study&, const StudyTable&) {
    return true;  // no other study has a wanted error
}

/// The files, and what the terminal shows.
template <class Study>
int report(const StudyEntry& study, const Study& work, const StudyOptions& given, bool isInterrupted,
           const CommonOptions& options) {
    const std::vector<StudyTable> tables = tablesOf(study, work);
    writeResults(study, work, tables, given.out, given.isPlotted);
    const int code = isInterrupted ? interrupted : isReached(study, work, tables.front()) ? done : failed;
    if (options.isJson) {
        Value document;
        document.set("study", study.item.id);
        document.set("rows", rowsValue(tables.front()));
        for (std::size_t i = 1; i < tables.size(); ++i) document.set(tables[i].name, rowsValue(tables[i]));
        document.set("complete", work.isComplete());
        return print(writeJson(document), code);
    }
    if (isInterrupted) printProblem("", "interrupted: the results are partial", "--resume goes on");
    if (options.isQuiet) return code;
    return print(tableText(summaryOf(study, work)) + "\n" + study.item.id + ".csv in " + given.out + "\n",
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

/// `scene`: null of a study that has none.
void writeScene(const Scene* scene, const std::filesystem::path& folder) {
    prepareFolder(folder);
    if (scene) writeFile(folder / "scene.json", extremal::writeScene(*scene));
}

template <class Study>
int runStudy(const StudyEntry& study, Study work, const Scene* scene, const StudyOptions& options,
             const CommonOptions& common) {
    InterruptWatch watch;
    writeScene(scene, options.out);
    const auto file = logOf(options.out, study.item.id);
    const std::string head = headOf(study.item.id, work);
    std::vector<std::string> known;
    StudyLog log = options.isResumed ? StudyLog::resume(file, head, known) : StudyLog::begin(file, head);
    for (const std::string& line : known) (void)takeLine(line, work);
    const bool isInterrupted = runAndWait(work, log, watch, common);
    return report(study, work, options, isInterrupted, common);
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
    writeScene(scene, options.out);
    return report(study, work, options, false, common);
}

}  // namespace

int studyVerb(const std::string& scene, const StudyOptions& options, const CommonOptions& common) {
    return guarded(sceneName(scene), [&] {
        const StudyEntry& study = knownStudy(options.kind);
        refuseStrangers(study, options);
        if (study.over == StudyEntry::Over::extremes) {
            const Shard shard = options.shard.empty() ? Shard{} : parseShard(options.shard);
            return runStudy(study, ExtremesStudy(shard, common.threads, options.isLong), nullptr, options,
                            common);
        }
        if (scene.empty()) throw InvalidScene("arguments", "SCENE is required", "see extremal study --help");
        const ReadScene read = loadScene(scene, common);
        if (!reportScene(scene, read, common)) return static_cast<int>(unusable);
        if (study.over == StudyEntry::Over::numbers)
            return runStudy(study, stabilityOf(*read.resolved, options, common), &read.scene, options,
                            common);
        if (study.over == StudyEntry::Over::testEquation)
            return runStudy(study, linearOf(*read.resolved, options, common), &read.scene, options, common);
        return runStudy(study, sweepOf(*read.resolved, options, common), &read.scene, options, common);
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
        const StudyEntry& study = knownStudy(what.find("study")->asString());
        if (study.over == StudyEntry::Over::extremes) {
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
