#include "app/watch_run.hpp"

#include <algorithm>
#include <cstdlib>

#include "app/progress.hpp"
#include "app/report.hpp"
#include "engine/core/text.hpp"
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
           (entry->needsReference && !comparison.reference.problems.empty());
}

}  // namespace

void printFailures(const Comparison& comparison, const std::string& scene) {
    printProblems(scene, comparison.reference.problems,
                  "warning: there is no reference, so errors are unknown: ");
    for (const auto& scheme : comparison.schemes) {
        const Summary& s = scheme->summary;
        if (s.status == RunStatus::failed)
            printProblem(s.label,
                         "failed at t = " + formatNumber(s.failedAt, 6) + ": " + std::string(name(s.cause)),
                         s.advice);
        else if (!s.caution.empty())
            printProblem(s.label, "warning: " + s.caution);
        if (s.status != RunStatus::done) continue;
        for (const Missing& m : missingFrom(comparison, *scheme))
            if (!isSaidAlready(m, comparison))
                printProblem(s.label, "warning: " + m.observable + " is not known: " + m.reason);
    }
}

int exitCode(const Comparison& comparison, bool isInterrupted) {
    if (isInterrupted) return interrupted;
    const auto isFailed = [](const auto& scheme) { return scheme->summary.status == RunStatus::failed; };
    return std::any_of(comparison.schemes.begin(), comparison.schemes.end(), isFailed) ? failed : done;
}

}  // namespace extremal::app
