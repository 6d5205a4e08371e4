// SPDX-License-Identifier: GPL-3.0-or-later
/// Eight numbers that go through the same arithmetic together.
///
/// Plain loops of fixed length, which the compiler turns into the vector instructions of whatever it compiles
/// for: the same operations in the same order on every machine, so results do not depend on it. Elementary
/// functions other than sqrt, sin and cos (lanes_trigonometry.hpp) are computed one lane after the other.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace extremal {

struct alignas(64) Lanes {
    static constexpr std::size_t size = 8;
    std::array<double, size> lane{};

    Lanes() = default;
    Lanes(double v) { lane.fill(v); }

    static Lanes load(const double* from) {
        Lanes r;
        for (std::size_t i = 0; i < size; ++i) r.lane[i] = from[i];
        return r;
    }
    void store(double* to) const {
        for (std::size_t i = 0; i < size; ++i) to[i] = lane[i];
    }
    Lanes& operator+=(const Lanes& b) {
        for (std::size_t i = 0; i < size; ++i) lane[i] += b.lane[i];
        return *this;
    }
    Lanes& operator-=(const Lanes& b) {
        for (std::size_t i = 0; i < size; ++i) lane[i] -= b.lane[i];
        return *this;
    }
    Lanes& operator*=(const Lanes& b) {
        for (std::size_t i = 0; i < size; ++i) lane[i] *= b.lane[i];
        return *this;
    }
    Lanes& operator/=(const Lanes& b) {
        for (std::size_t i = 0; i < size; ++i) lane[i] /= b.lane[i];
        return *this;
    }
    /// f of every lane.
    template <class F>
    Lanes map(F f) const {
        Lanes r;
        for (std::size_t i = 0; i < size; ++i) r.lane[i] = f(lane[i]);
        return r;
    }
    Lanes operator-() const {
        return map([](double v) { return -v; });
    }
};

/// A count with what fills the last eight.
template <class Count>
constexpr Count inWholeLanes(Count count) {
    constexpr auto size = static_cast<Count>(Lanes::size);
    return (count + size - 1) / size * size;
}

inline Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a) += b; }
inline Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a) -= b; }
inline Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a) *= b; }
inline Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a) /= b; }

inline Lanes sqrt(const Lanes& a) {
    return a.map([](double v) { return __builtin_sqrt(v); });
}
inline Lanes exp(const Lanes& a) {
    return a.map([](double v) { return std::exp(v); });
}
inline Lanes log(const Lanes& a) {
    return a.map([](double v) { return std::log(v); });
}

}  // namespace extremal
