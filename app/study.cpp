#include <QApplication>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <sstream>
#include <thread>

#include "app/load.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/signals.hpp"
#include "app/verbs.hpp"
#include "engine/core/text.hpp"
#include "engine/figure/study_figure.hpp"
#include "engine/run/export.hpp"
#include "engine/scene/json.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/point_log.hpp"
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

SweepOptions optionsOf(const StudyEntry& entry, const StudyOptions& study, const CommonOptions& common) {
    SweepOptions options;
    if (entry.needsWantedError && study.error == 0)
        throw InvalidScene("--error", "is required for " + entry.item.id, "for example --error 1e-6");
    if (!entry.needsWantedError && study.error != 0)
        throw InvalidScene("--error", "is not an option of " + entry.item.id, "study cheapest has it");
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
    return options;
}

void writeResults(const StudyEntry& study, const Sweep& sweep, const std::filesystem::path& folder,
                  bool isPlotted) {
    writeFile(folder / (study.item.id + ".csv"), studyCsv(study, sweep));
    const Figure figure = studyFigure(study.item.id, sweep);
    if (!isPlotted || figure.view.empty()) return;
    qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
    qputenv("QT_QPA_PLATFORM", "offscreen");
    int argc = 1;
    char program[] = "extremal";
    char* argv[] = {program, nullptr};
    const QApplication application(argc, argv);
    for (const char* ending : {".svg", ".png"}) {
        const std::filesystem::path file = folder / (study.item.id + ending);
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

/// The study's summary; columns that no row fills are left out.
std::string tableOf(const StudyEntry& study, const Sweep& sweep) {
    const std::vector<Value::Array> rows = study.summary(sweep);
    Table table;
    table.rows.resize(rows.size() + 1);
    for (std::size_t c = 0; c < study.summaryColumns.size(); ++c) {
        const bool isEmpty = std::all_of(rows.begin(), rows.end(),
                                         [&](const Value::Array& row) { return cellText(row[c]).empty(); });
        if (isEmpty) continue;
        table.rows[0].push_back(study.summaryColumns[c]);
        table.isRightAligned.push_back(std::any_of(
            rows.begin(), rows.end(), [&](const Value::Array& row) { return row[c].isNumber(); }));
        for (std::size_t r = 0; r < rows.size(); ++r) table.rows[r + 1].push_back(cellText(rows[r][c]));
    }
    return table.text();
}

/// Which scheme came nearest to an error that none reaches.
void printUnreached(const StudyEntry& study, const Sweep& sweep) {
    const Value rows = studyRows(study, sweep);
    if (rows.asArray().empty()) return;
    const Value& nearest = rows.asArray().front();
    const Value* error = nearest.find("error");
    const std::string what =
        error->isNumber() ? nearest.find("label")->asString() + ", " + formatNumber(error->asNumber(), 3)
                          : "no scheme ran to the end";
    printProblem("--error", "no scheme reaches " + formatNumber(sweep.options().wantedError, 3),
                 "the nearest: " + what);
}

int report(const StudyEntry& study, const Sweep& sweep, const std::string& folder, bool isInterrupted,
           const CommonOptions& options) {
    int code = isInterrupted ? interrupted : done;
    const bool isReached = std::any_of(sweep.rows().begin(), sweep.rows().end(),
                                       [](const SweepRow& row) { return row.result.isDone(); });
    if (study.needsWantedError && !isReached && !isInterrupted) {
        code = failed;
        printUnreached(study, sweep);
    }
    if (options.isJson) {
        Value document;
        document.set("study", study.item.id);
        document.set("rows", studyRows(study, sweep));
        document.set("complete", sweep.isComplete());
        return print(writeJson(document), code);
    }
    if (isInterrupted) printProblem("", "interrupted: the results are partial", "--resume goes on");
    if (options.isQuiet) return code;
    return print(tableOf(study, sweep) + "\n" + study.item.id + ".csv in " + folder + "\n", code);
}

/// Waits for the sweep on another thread; Ctrl-C stops it, and a second one ends the program.
bool waitFor(Sweep& sweep, PointLog& log, InterruptWatch& watch, const CommonOptions& options) {
    ProgressLine progress(!options.isQuiet);
    std::atomic<bool> isFinished{false};
    std::exception_ptr failure;
    std::jthread worker([&](const std::stop_token& stop) {
        try {
            sweep.run([&](const ReferenceInfo& info) { log.add(info); },
                      [&](std::size_t i, const PointResult& result) { log.add(i, result); }, stop);
        } catch (...) {
            failure = std::current_exception();
        }
        isFinished = true;
    });
    bool isInterrupted = false;
    for (int pause = 1; !isFinished; pause = std::min(2 * pause, 30)) {
        if (watch.wait(pause)) {
            if (isInterrupted) std::_Exit(interrupted);
            isInterrupted = true;
            worker.request_stop();
        }
        progress.show(sweep.fraction(), isInterrupted ? "stopping" : "studying");
    }
    worker.join();
    if (failure) std::rethrow_exception(failure);
    return isInterrupted;
}

template <class Work>
int guarded(const std::string& file, Work&& work) {
    try {
        return work();
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) {
            if (!p.pointer.empty() && p.pointer.front() == '/')
                printProblems(file, {p});
            else
                printProblem(p.pointer, p.message, p.hint);
        }
        return unusable;
    } catch (const ExportError& e) {
        printProblem(e.path.string(), std::string("cannot be written: ") + e.what(), "another --out DIR");
        return unwritable;
    }
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

}  // namespace

int studyVerb(const std::string& scene, const StudyOptions& options, const CommonOptions& common) {
    return guarded(sceneName(scene), [&] {
        const StudyEntry& study = knownStudy(options.kind);
        const ReadScene read = loadScene(scene, common.overrides);
        if (!reportScene(scene, read, common)) return static_cast<int>(unusable);
        Sweep sweep(*read.resolved, optionsOf(study, options, common));
        InterruptWatch watch;
        prepareFolder(options.out);
        writeFile(std::filesystem::path(options.out) / "scene.json", writeScene(read.scene));
        const auto file = logOf(options.out, study.item.id);
        PointLog log = options.isResumed ? PointLog::resume(file, study.item.id, sweep)
                                         : PointLog::begin(file, study.item.id, sweep);
        const bool isInterrupted = waitFor(sweep, log, watch, common);
        writeResults(study, sweep, options.out, options.isPlotted);
        return report(study, sweep, options.out, isInterrupted, common);
    });
}

int mergeVerb(const StudyOptions& options, const CommonOptions& common) {
    return guarded("", [&] {
        const std::filesystem::path first = options.folders.front();
        const auto firstLog = onlyLogIn(first);
        const LogHead head = readLogHead(firstLog);
        const ReadScene read = readScene(textOf(first / "scene.json"), {}, first.string());
        if (!read.resolved) {
            printProblems((first / "scene.json").string(), read.errors);
            return static_cast<int>(unusable);
        }
        if (fingerprint(writeScene(read.scene)) != head.scene)
            throw InvalidScene("arguments", first.string() + ": scene.json is not the scene of the log",
                               "the folder as extremal study wrote it");
        const StudyEntry& study = knownStudy(head.study);
        Sweep sweep(*read.resolved, head.options);
        std::vector<int> owners(sweep.size(), -1);
        for (std::size_t f = 0; f < options.folders.size(); ++f) {
            const auto log = onlyLogIn(options.folders[f]);
            const LogHead other = readLogHead(log);
            if (other.study != head.study || other.scene != head.scene ||
                optionsValue(other.options) != optionsValue(head.options))
                throw InvalidScene("arguments",
                                   options.folders[f] + " is of another study, scene or option than " +
                                       options.folders.front(),
                                   "shards of one study");
            for (const std::size_t point : takePoints(log, sweep)) {
                if (owners[point] >= 0)
                    throw InvalidScene("arguments",
                                       options.folders[f] + " and " +
                                           options.folders[static_cast<std::size_t>(owners[point])] +
                                           " both have point " + std::to_string(point),
                                       "every shard once");
                owners[point] = static_cast<int>(f);
            }
        }
        const auto missing = std::count(owners.begin(), owners.end(), -1);
        if (missing > 0)
            throw InvalidScene(
                "arguments",
                std::to_string(missing) + " of " + std::to_string(sweep.size()) + " points are missing",
                "every shard, each run to its end");
        prepareFolder(options.out);
        writeFile(std::filesystem::path(options.out) / "scene.json", writeScene(read.scene));
        writeResults(study, sweep, options.out, options.isPlotted);
        return report(study, sweep, options.out, false, common);
    });
}

}  // namespace extremal::app
