// SPDX-License-Identifier: GPL-3.0-or-later
/// One line on a terminal's standard error that says how far the work is; nothing when it is piped.
#pragma once

#include <chrono>
#include <string>

namespace extremal::app {

class ProgressLine {
public:
    explicit ProgressLine(bool isWanted);
    ~ProgressLine() { clear(); }
    /// Redraws at most ten times a second, and only when the work lasts longer than half a second.
    void show(double fraction, const std::string& what);
    void clear();

private:
    using Clock = std::chrono::steady_clock;
    bool isShown_ = false, isTerminal_ = false;
    Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace extremal::app
