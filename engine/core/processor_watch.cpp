// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/processor_watch.hpp"

#include <pthread.h>

#include <chrono>
#include <cmath>
#include <condition_variable>

#include "engine/core/thread_clock.hpp"

namespace extremal {

ProcessorWatch::Armed::Armed(ProcessorWatch& watch, double seconds, const std::stop_source& source)
    : watch_(watch) {
    clockid_t clock{};
    if (!std::isfinite(seconds) || pthread_getcpuclockid(pthread_self(), &clock) != 0) return;
    const std::scoped_lock lock(watch_.mutex_);
    watch_.limit_ = Limit{clock, threadSeconds() + seconds, source};
    if (!watch_.thread_.joinable())
        watch_.thread_ = std::jthread([&watch](const std::stop_token& end) { watch.look(end); });
}

ProcessorWatch::Armed::~Armed() {
    const std::scoped_lock lock(watch_.mutex_);
    watch_.limit_.reset();
}

ProcessorWatch::Pause::Pause(ProcessorWatch* watch) : watch_(watch) {
    if (!watch_) return;
    const std::scoped_lock lock(watch_->mutex_);
    if (!watch_->limit_) return;
    watch_->limit_->isPaused = true;
    begin_ = secondsOf(watch_->limit_->clock);
}

ProcessorWatch::Pause::~Pause() {
    if (!watch_) return;
    const std::scoped_lock lock(watch_->mutex_);
    if (!watch_->limit_) return;
    watch_->limit_->isPaused = false;
    watch_->limit_->end += secondsOf(watch_->limit_->clock) - begin_;
}

void ProcessorWatch::look(const std::stop_token& end) {
    using namespace std::chrono_literals;
    std::condition_variable_any isEnded;
    std::unique_lock lock(mutex_);
    while (!end.stop_requested()) {
        // There is no notification: it wakes up to look, and at the end at once.
        isEnded.wait_for(lock, end, 3ms, [] { return false; });
        const bool isOver = limit_ && !limit_->isPaused && secondsOf(limit_->clock) > limit_->end;
        if (isOver) limit_->source.request_stop();
    }
}

}  // namespace extremal
