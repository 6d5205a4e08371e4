/// Waiting for a run on the command line: progress, Ctrl-C, and what became of it.
#pragma once

#include "app/signals.hpp"
#include "app/verbs.hpp"
#include "engine/run/run.hpp"

namespace extremal::app {

/// Waits for the run; a first Ctrl-C stops it and keeps what is done, a second one ends the program. True: it
/// was interrupted, and the results are partial.
bool waitFor(Run& run, InterruptWatch& watch, const CommonOptions& options);

/// One line on standard error for every scheme that failed: when, why, and what to try.
void printFailures(const Comparison& comparison, const std::string& scene);

/// Interrupted, failed if a scheme failed numerically, or done.
int exitCode(const Comparison& comparison, bool isInterrupted);

}  // namespace extremal::app
