// SPDX-License-Identifier: GPL-3.0-or-later
/// The CPU time that a thread has used.
#pragma once

#include <ctime>

namespace extremal {

inline double secondsOf(clockid_t clock) {
    std::timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}
/// Of this thread.
inline double threadSeconds() { return secondsOf(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace extremal
