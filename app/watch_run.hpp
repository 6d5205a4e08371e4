// SPDX-License-Identifier: GPL-3.0-or-later
/// Waiting for a run, or a study, on the command line: progress, Ctrl-C, and what became of it.
#pragma once

#include <functional>
#include <string>

#include "app/signals.hpp"
#include "app/verbs.hpp"
#include "engine/run/run.hpp"
#include "engine/study/progress.hpp"

namespace extremal::app {

/// Work on another thread.
struct Work {
    std::function<bool()> isFinished;
    std::function<double()> fraction;
    std::function<std::string()> doing;             ///< what the line of progress says
    std::function<void()> stop;                     ///< returns at once
    std::function<AnnouncedTime()> announced = {};  ///< empty: it never says
};
/// Waits until the work is finished; a first Ctrl-C stops it, a second one ends the program. True: it was
/// interrupted.
bool waitFor(const Work& work, InterruptWatch& watch, const CommonOptions& options);

/// Waits for the run; a first Ctrl-C stops it and keeps what is done, a second one ends the program. True: it
/// was interrupted, and the results are partial.
bool waitFor(Run& run, InterruptWatch& watch, const CommonOptions& options);

/// One line on standard error for every scheme that failed: when, why, and what to try.
void printFailures(const Comparison& comparison, const std::string& scene);

/// Interrupted, failed if a scheme failed numerically, or done.
int exitCode(const Comparison& comparison, bool isInterrupted);

}  // namespace extremal::app
