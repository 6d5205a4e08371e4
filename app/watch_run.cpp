// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/watch_run.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <vector>

#include "app/progress.hpp"
#include "app/report.hpp"
#include "engine/core/text/text.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/missing.hpp"

namespace extremal::app {

bool waitFor(const Work& work, InterruptWatch& watch, const CommonOptions& options) {
    ProgressLine progress(!options.isQuiet);
    bool isInterrupted = false;
    for (int pause = 1; !work.isFinished(); pause = std::min(2 * pause, 30)) {
        if (watch.wait(pause)) {
            if (isInterrupted) std::_Exit(interrupted);
            isInterrupted = true;
            work.stop();
        }
        if (work.announced) progress.announce(work.announced());
        progress.show(work.fraction(), isInterrupted ? "stopping" : work.doing());
    }
    return isInterrupted;
}

bool waitFor(Run& run, InterruptWatch& watch, const CommonOptions& options) {
    const Work work{[&] { return run.isFinished(); }, [&] { return run.fraction(); },
                    [&] { return std::string(run.isPreparing() ? "computing the reference" : "running"); },
                    [&] { run.stop(); }};
    const bool isInterrupted = waitFor(work, watch, options);
    run.wait();
    return isInterrupted;
}

namespace {

/// By the warnings of the scene, or of the reference that all schemes share.
bool isSaidAlready(const Missing& missing, const Comparison& comparison) {
    const ObservableEntry* entry = findObservable(missing.observable);
    if (!entry) return false;
    return !entry->variations.isEmpty() || entry->needsWayBack ||
           (entry->needsReference &&
            (!comparison.reference.problems.empty() || comparison.reference.type == "none" ||
             comparison.reference.type == "companion"));
}

/// What schemes that are done lack, one line for all that lack it for the same reason.
void printMissing(const Comparison& comparison) {
    std::map<std::string, std::vector<std::string>> labels;
    std::vector<std::string> order;
    for (const auto& scheme : comparison.schemes) {
        if (scheme->summary.status != RunStatus::done) continue;
        for (const Missing& m : missingFrom(comparison, *scheme)) {
            if (isSaidAlready(m, comparison)) continue;
            const std::string text = m.observable + " is not known: " + m.reason;
            auto& all = labels[text];
            if (all.empty()) order.push_back(text);
            all.push_back(scheme->summary.label);
        }
    }
    for (const std::string& text : order) printProblem(joinNames(labels[text]), "warning: " + text);
}

}  // namespace

void printFailures(const Comparison& comparison, const std::string& scene) {
    printProblems(scene, comparison.reference.problems,
                  "warning: there is no reference, so errors are unknown: ");
    if (!comparison.reference.caution.empty())
        printProblem("/reference", "warning: " + comparison.reference.caution);
    for (const auto& scheme : comparison.schemes) {
        const Summary& s = scheme->summary;
        if (s.status == RunStatus::failed)
            printProblem(s.label,
                         "failed at t = " + formatNumber(s.failedAt, 6) + ": " + std::string(name(s.cause)),
                         s.advice);
        else if (!s.caution.empty())
            printProblem(s.label, "warning: " + s.caution);
    }
    printMissing(comparison);
}

int exitCode(const Comparison& comparison, bool isInterrupted) {
    if (isInterrupted) return interrupted;
    const auto isFailed = [](const auto& scheme) { return scheme->summary.status == RunStatus::failed; };
    return std::any_of(comparison.schemes.begin(), comparison.schemes.end(), isFailed) ? failed : done;
}

}  // namespace extremal::app
