// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/progress.hpp"

#include <algorithm>
#include <cstdio>

#include <unistd.h>

namespace extremal::app {

ProgressLine::ProgressLine(bool isWanted)
    : isWanted_(isWanted), isTerminal_(isWanted && ::isatty(STDERR_FILENO) == 1) {}

void ProgressLine::announce(const AnnouncedTime& time) {
    constexpr double worthSaying = 2;
    const bool isNew = announced_.seconds == 0 && time.seconds > 0;
    announced_ = time;
    if (isNew && isWanted_ && !isTerminal_ && time.seconds >= worthSaying)
        std::fprintf(stderr, "this takes %s\n", textOf(time).c_str());
}

void ProgressLine::show(double fraction, const std::string& what) {
    using namespace std::chrono_literals;
    const auto now = Clock::now();
    if (!isTerminal_ || now - start_ < 500ms || now - last_ < 100ms) return;
    last_ = now;
    isShown_ = true;
    constexpr int width = 30;
    const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(width - filled), '.');
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const bool isAhead = announced_.seconds > seconds;
    const std::string all = isAhead ? " of " + textOf(announced_) : "";
    std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s, %.0f s%s", bar.c_str(), 100 * fraction, what.c_str(),
                 seconds, all.c_str());
    std::fflush(stderr);
}

void ProgressLine::clear() {
    if (isShown_) std::fputs("\r\033[K", stderr);
    isShown_ = false;
}

}  // namespace extremal::app
