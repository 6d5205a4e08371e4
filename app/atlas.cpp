// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "app/offscreen.hpp"
#include "app/report.hpp"
#include "app/study_work.hpp"
#include "app/verbs.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/figure/studies/study_figure.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/study/atlas/atlas.hpp"
#include "engine/study/search/pareto.hpp"
#include "engine/study/search/proposal.hpp"
#include "engine/study/sweep_log.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::app {
namespace {

/// "Intel(R) Xeon(R) ..., 2 cores, kernels for avx512".
std::string machineText() {
    std::string processor = "this machine";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) {
            processor = line.substr(line.find(':') + 2);
            break;
        }
    return processor + ", " + std::to_string(std::thread::hardware_concurrency()) + " cores, kernels for " +
           std::string(name(instructionSet()));
}

std::filesystem::path partLog(const AtlasSystem& system, const AtlasPart& part,
                              const std::filesystem::path& folder) {
    return folder / (part.logName(system.id) + ".log");
}

/// Before the work: what it writes may be written.
void checkFiles(const std::vector<AtlasSystem>& systems, const std::filesystem::path& folder,
                const Replacing& replacing) {
    requireReplaceable(folder / "index.html", replacing);
    for (const AtlasSystem& system : systems) {
        requireReplaceable(folder / (system.id + ".svg"), replacing);
        for (const AtlasPart& part : system.parts)
            requireReplaceable(partLog(system, part, folder), replacing);
    }
}

/// What its log knows, and what is left to run. True: it was interrupted.
bool runPart(const AtlasSystem& system, AtlasPart& part, InterruptWatch& watch, const AtlasRunOptions& given,
             const CommonOptions& options) {
    const Replacing replacing{options.isForced, {}};
    const auto file = partLog(system, part, given.out);
    const std::string head = headOf("atlas", part.sweep);
    std::vector<std::string> known;
    StudyLog log = given.isResumed ? StudyLog::resume(file, head, known, replacing)
                                   : StudyLog::begin(file, head, replacing);
    for (const std::string& line : known) (void)takeLine(line, part.sweep);
    if (part.sweep.isComplete()) return false;
    return runAndWait(part.sweep, log, watch, options, system.id + ", " + part.metric);
}

/// Of dozens of schemes those that have a point on the front, and the ten cheapest for an error of 1e-6.
Figure pictureOf(const AtlasSystem& system) {
    constexpr std::size_t most = 10;
    const Sweep& sweep = system.errors();
    const auto labelOf = [&](std::size_t scheme) { return sweep.scene().scene.schemes[scheme].label; };
    std::set<std::string> shown;
    const std::vector<bool> front = paretoFront(sweep);
    for (std::size_t i = 0; i < front.size(); ++i)
        if (front[i]) shown.insert(labelOf(sweep.rows()[i].point.scheme));
    std::vector<Proposal> proposals = proposalsFor(sweep, 1e-6);
    if (proposals.size() > most) proposals.resize(most);
    for (const Proposal& p : proposals) shown.insert(labelOf(p.scheme));
    Figure figure = studyFigure("work-precision", sweep);
    std::erase_if(figure.layers, [&](const Layer& layer) {
        if (const auto* series = std::get_if<Series>(&layer)) return !shown.contains(series->label);
        if (const auto* area = std::get_if<Area>(&layer)) return !shown.contains(area->label);
        return false;
    });
    figure.subtitle.clear();
    return figure;
}

void writePicture(const AtlasSystem& system, const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / (system.id + ".svg");
    const QString problem =
        saveFigure(QString::fromStdString(file.string()), pictureOf(system), {860, 520}, Theme::light(), 1);
    if (!problem.isEmpty()) throw ExportError(file, problem.toStdString());
}

Value documentOf(const std::vector<AtlasSystem>& systems, bool isComplete) {
    Value::Array all;
    const auto number = [](double value) { return std::isfinite(value) ? Value(value) : Value(nullptr); };
    for (const AtlasSystem& system : systems)
        for (const AtlasRow& row : rowsOf(system)) {
            Value each;
            each.set("system", system.id);
            each.set("label", row.label);
            each.set("order_claimed", row.claims.order);
            each.set("order_measured", number(row.order.order));
            each.set("error", number(row.error));
            each.set("cpu_seconds", number(row.seconds));
            each.set("cpu_seconds_for_1e-6", number(row.secondsForError));
            for (const AtlasRow::Measured& m : row.metrics) each.set(m.metric, number(m.value));
            each.set("cause", row.cause);
            all.push_back(std::move(each));
        }
    Value document;
    document.set("rows", std::move(all));
    document.set("complete", isComplete);
    return document;
}

}  // namespace

int atlasVerb(const AtlasRunOptions& given, const CommonOptions& common) {
    return guarded("", [&] {
        AtlasOptions options;
        options.isQuick = given.isQuick;
        options.threads = common.threads;
        const std::vector<std::string>& wanted = given.systems.empty() ? atlasSystems() : given.systems;
        std::vector<AtlasSystem> systems;
        for (const std::string& id : wanted) systems.push_back(atlasSystem(id, options));
        const Replacing replacing{common.isForced, {}};
        checkFiles(systems, given.out, replacing);
        prepareFolder(given.out);
        InterruptWatch watch;
        bool isInterrupted = false;
        for (AtlasSystem& system : systems)
            for (AtlasPart& part : system.parts)
                isInterrupted = isInterrupted || runPart(system, part, watch, given, common);
        const Offscreen qt;
        for (const AtlasSystem& system : systems) writePicture(system, given.out);
        const std::filesystem::path page = std::filesystem::path(given.out) / "index.html";
        const std::string html = atlasPage(systems, EXTREMAL_VERSION, machineText(), !isInterrupted);
        writeFile(page, markedAsOwn(html, "<!-- ", " -->", 1), replacing);
        const int code = isInterrupted ? interrupted : done;
        if (common.isJson) return print(writeJson(documentOf(systems, !isInterrupted)), code);
        if (isInterrupted) printProblem("", "interrupted: the atlas is partial", "--resume goes on");
        return common.isQuiet ? code : print("index.html in " + given.out + "\n", code);
    });
}

}  // namespace extremal::app
