// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/heap_use.hpp"

#include <malloc.h>

namespace extremal {

std::size_t heapInUse() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

}  // namespace extremal
