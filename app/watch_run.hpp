/// Waiting for a run on the command line: progress, and Ctrl-C.
#pragma once

#include "app/signals.hpp"
#include "app/verbs.hpp"
#include "engine/run/run.hpp"

namespace extremal::app {

/// Waits for the run; a first Ctrl-C stops it and keeps what is done, a second one ends the program. True: it
/// was interrupted, and the results are partial.
bool waitFor(Run& run, InterruptWatch& watch, const CommonOptions& options);

}  // namespace extremal::app
