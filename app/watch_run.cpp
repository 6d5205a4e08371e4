#include "app/watch_run.hpp"

#include <algorithm>
#include <cstdlib>

#include "app/progress.hpp"

namespace extremal::app {

bool waitFor(Run& run, InterruptWatch& watch, const CommonOptions& options) {
    ProgressLine progress(!options.isQuiet);
    bool isInterrupted = false;
    for (int pause = 1; !run.isFinished(); pause = std::min(2 * pause, 30)) {
        if (watch.wait(pause)) {
            if (isInterrupted) std::_Exit(interrupted);
            isInterrupted = true;
            run.stop();
        }
        progress.show(run.fraction(), isInterrupted ? "stopping" : "running");
    }
    run.wait();
    return isInterrupted;
}

}  // namespace extremal::app
