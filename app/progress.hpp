// SPDX-License-Identifier: GPL-3.0-or-later
/// One line on a terminal's standard error that says how far the work is, and how long it should take. When
/// it is piped, only that, where it is two seconds or more.
#pragma once

#include <chrono>
#include <string>

#include "engine/study/progress.hpp"

namespace extremal::app {

class ProgressLine {
public:
    explicit ProgressLine(bool isWanted);
    ~ProgressLine() { clear(); }
    void announce(const AnnouncedTime& time);
    /// Redraws at most ten times a second, and only when the work lasts longer than half a second.
    void show(double fraction, const std::string& what);
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    bool isShown_ = false, isWanted_ = false, isTerminal_ = false;
    AnnouncedTime announced_;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace extremal::app
