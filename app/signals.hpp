// SPDX-License-Identifier: GPL-3.0-or-later
/// Ctrl-C while work is going on: the signal is held back from all threads and asked for, so that no handler
/// runs.
#pragma once

#include <csignal>

namespace extremal::app {

/// While it lives, SIGINT, SIGTERM and, unless it is ignored, SIGHUP are blocked in this thread and those it
/// starts.
class InterruptWatch {
public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    /// Waits so long at most; true if the user asked to stop meanwhile.
    bool wait(int milliseconds);

private:
    sigset_t signals_, previous_;
};

}  // namespace extremal::app
