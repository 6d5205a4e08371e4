// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/heap_use.hpp"

#include <malloc.h>
#ifdef __SANITIZE_ADDRESS__
extern "C" std::size_t __sanitizer_get_current_allocated_bytes();  // g++ 12 comes without the header of it
#endif

namespace extremal {

std::size_t heapInUse() {
#ifdef __SANITIZE_ADDRESS__
    return __sanitizer_get_current_allocated_bytes();  // its allocator takes the place of the C library's
#else
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
#endif
}

}  // namespace extremal
