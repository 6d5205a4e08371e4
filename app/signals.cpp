// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/signals.hpp"

#include <ctime>

#include <pthread.h>

namespace extremal::app {

InterruptWatch::InterruptWatch() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    // A terminal that is closed; under nohup the signal is ignored, and work goes on.
    struct sigaction hangUp {};
    if (sigaction(SIGHUP, nullptr, &hangUp) == 0 && hangUp.sa_handler != SIG_IGN)
        sigaddset(&signals_, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals_, &previous_);
}

InterruptWatch::~InterruptWatch() {
    // A signal that arrives after the work is done is ignored: the results are complete.
    while (wait(0)) {
    }
    pthread_sigmask(SIG_SETMASK, &previous_, nullptr);
}

bool InterruptWatch::wait(int milliseconds) {
    const timespec timeout{milliseconds / 1000, milliseconds % 1000 * 1000000L};
    return sigtimedwait(&signals_, nullptr, &timeout) > 0;
}

}  // namespace extremal::app
