// SPDX-License-Identifier: GPL-3.0-or-later
/// What computes nodes and weights: Legendre polynomials on [-1, 1], Newton's method, and the way to [0, 1].
/// Internal to engine/quadrature.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>

#include "engine/quadrature/rule.hpp"

namespace extremal {

template <class T>
T pi() {
    if constexpr (std::is_same_v<T, boost::multiprecision::float128>)
        return 4 * atan(T(1));
    else
        return std::numbers::pi_v<T>;
}

/// Double rules are computed with 64 bits of mantissa, quadruple ones in quadruple precision.
template <class T>
using Wide = std::conditional_t<std::is_same_v<T, double>, long double, T>;

/// Legendre polynomials P_n(x), P_{n-1}(x) and P_n'(x) by the three-term recurrence.
template <class W>
struct Legendre {
    W p, previous, derivative;
    Legendre(int n, const W& x) : p(1), previous(0), derivative(0) {
        W dPrevious(0);
        for (int k = 1; k <= n; ++k) {
            const W next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
            const W dNext = dPrevious + (2 * k - 1) * p;
            previous = p;
            p = next;
            dPrevious = derivative;
            derivative = dNext;
        }
    }
};

/// Newton from x until the correction no longer shrinks; f returns (value, derivative).
template <class W, class F>
W newtonRoot(W x, F f) {
    using std::abs;
    W last(2);
    for (int i = 0; i < 100; ++i) {
        const auto [value, slope] = f(x);
        const W delta = value / slope;
        x -= delta;
        const W size = abs(delta);
        if (size == 0 || (size >= last && size < W(1e-12))) break;
        last = size;
    }
    return x;
}

/// The node x in [-1, 1] and its weight, on [0, 1].
template <class T, class W>
void appendNode(Rule<T>& rule, const W& x, const W& weight) {
    rule.c.push_back(static_cast<T>((1 + x) / 2));
    rule.b.push_back(static_cast<T>(weight / 2));
}

/// Gives a rule that is symmetric in theory exact mirror images: c_i + c_{n-1-i} = 1, b_i = b_{n-1-i}.
template <class T>
void symmetrise(Rule<T>& rule) {
    const std::size_t n = rule.c.size();
    for (std::size_t i = 0; i < n / 2; ++i) {
        rule.c[n - 1 - i] = T(1) - rule.c[i];
        rule.b[n - 1 - i] = rule.b[i];
    }
    if (n % 2 == 1) rule.c[n / 2] = T(0.5);
}

}  // namespace extremal
