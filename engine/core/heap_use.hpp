// SPDX-License-Identifier: GPL-3.0-or-later
/// What the program holds on the heap.
#pragma once

#include <cstddef>

namespace extremal {

/// Bytes that all threads hold now, as the allocator counts them (mallinfo2 of the C library). Blocks of up
/// to about a kilobyte that were freed a moment ago may still count: of few small blocks it tells little.
std::size_t heapInUse();

}  // namespace extremal
