// SPDX-License-Identifier: GPL-3.0-or-later
/// Vectors of numbers as wide as the registers of an instruction set, for kernels that are compiled for each
/// of these (instruction_set.hpp). Wider vectors than the machine has are no substitute: the compiler takes
/// those apart in memory, at two to four times the cost. They are handed on by reference alone, as how they
/// are returned depends on the set.
#pragma once

#include <cstddef>
#include <cstring>

namespace extremal::registers {

using Two [[gnu::vector_size(16)]] = double;
using Four [[gnu::vector_size(32)]] = double;
using Eight [[gnu::vector_size(64)]] = double;

/// What a comparison gives: as many integers, all bits set where it holds.
template <class Pack>
using Mask = decltype(Pack{} < Pack{});
template <class Pack>
constexpr int lanesOf = static_cast<int>(sizeof(Pack) / sizeof(double));

template <class Pack>
[[gnu::always_inline]] inline void load(Pack& to, const double* from) {
    std::memcpy(&to, from, sizeof(Pack));
}
template <class Pack>
[[gnu::always_inline]] inline void store(double* to, const Pack& from) {
    std::memcpy(to, &from, sizeof(Pack));
}

}  // namespace extremal::registers
