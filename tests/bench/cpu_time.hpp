// SPDX-License-Identifier: GPL-3.0-or-later
/// Processor time, for ratios.
#pragma once

#include <time.h>

namespace extremal {

/// Seconds this process has computed.
inline double cpuSeconds() {
    timespec ts{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &ts);
    return static_cast<double>(ts.tv_sec) + 1e-9 * static_cast<double>(ts.tv_nsec);
}

}  // namespace extremal
