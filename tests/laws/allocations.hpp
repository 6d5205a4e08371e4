// SPDX-License-Identifier: GPL-3.0-or-later
/// Counts what the test program allocates: allocations.cpp replaces operator new.
#pragma once

#include <atomic>

namespace extremal::laws {

extern std::atomic<long long> allocations;

}  // namespace extremal::laws
