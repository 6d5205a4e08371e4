// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/laws/allocations.hpp"

#include <cstdlib>
#include <new>

std::atomic<long long> extremal::laws::allocations{0};

void* operator new(std::size_t size) {
    ++extremal::laws::allocations;
    if (void* p = std::malloc(size)) return p;
    throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++extremal::laws::allocations;
    return std::malloc(size);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
