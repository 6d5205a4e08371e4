// SPDX-License-Identifier: GPL-3.0-or-later
/// The end of the program by a signal: SIGTERM, SIGINT and SIGHUP, as when a session ends or a terminal is
/// closed.
///
/// A handler may do next to nothing, so that it only wakes the event loop, which then does what is to be done
/// before the end. A second signal ends the program at once, should the loop be busy. A signal that was
/// ignored, as SIGHUP is under nohup, stays so.
#pragma once

#include <functional>
#include <memory>

class QSocketNotifier;

namespace extremal {

class Termination {
public:
    /// `prepare` is called in the event loop of this thread; then `end` with the number of the signal, by
    /// default its own effect. One object at a time.
    explicit Termination(std::function<void()> prepare, std::function<void(int)> end = {});
    ~Termination();
    Termination(const Termination&) = delete;
    Termination& operator=(const Termination&) = delete;

private:
    void meet();

    std::function<void()> prepare_;
    std::function<void(int)> end_;
    int ends_[2] = {-1, -1};  ///< of a pipe: read, write
    std::unique_ptr<QSocketNotifier> notifier_;
};

}  // namespace extremal
