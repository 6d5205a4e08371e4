// SPDX-License-Identifier: GPL-3.0-or-later
/// The CPU time that this thread has used.
#pragma once

#include <ctime>

namespace extremal {

inline double threadSeconds() {
    std::timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace extremal
