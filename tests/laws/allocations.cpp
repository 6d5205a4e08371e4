// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/laws/allocations.hpp"

#include <cstdlib>
#include <new>

std::atomic<long long> extremal::laws::allocations{0};

// Eigen's matrices come from malloc and not from operator new. Sanitizers have a malloc of their own.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define EXTREMAL_COUNTS_MALLOC 1
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* p, std::size_t size);
void* malloc(std::size_t size) {
    ++extremal::laws::allocations;
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    ++extremal::laws::allocations;
    return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) {
    ++extremal::laws::allocations;
    return __libc_realloc(p, size);
}
}
#else
#define EXTREMAL_COUNTS_MALLOC 0
#endif

void* operator new(std::size_t size) {
    if (!EXTREMAL_COUNTS_MALLOC) ++extremal::laws::allocations;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    if (!EXTREMAL_COUNTS_MALLOC) ++extremal::laws::allocations;
    return std::malloc(size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
