// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers for fuzzing: the same on every machine, from two numbers that name a case.
#pragma once

#include <cstddef>
#include <cstdint>

namespace extremal::fuzz {

/// The generator of Steele, Lea and Flood (2014), "splitmix".
class Random {
public:
    Random(std::uint64_t seed, std::uint64_t number) : state_(seed * 0x9e3779b97f4a7c15 + number) { next(); }
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    /// From 0 to n - 1.
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
    bool oneIn(std::size_t n) { return below(n) == 0; }
    template <class List>
    const auto& of(const List& list) {
        return list[below(list.size())];
    }

private:
    std::uint64_t state_;
};

}  // namespace extremal::fuzz
