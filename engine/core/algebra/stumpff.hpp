// SPDX-License-Identifier: GPL-3.0-or-later
/// Stumpff's functions c_k(x) = sum_j (-x)^j / (k + 2j)!, k = 0, 1, 2, ...: c_0(x) = cos sqrt(x),
/// c_1(x) = sin(sqrt(x)) / sqrt(x), and c_{k+2} = (1/k! - c_k) / x; hyperbolic for negative x.
///
/// The functions 1, tau, tau^2 c_2((z tau)^2), tau^3 c_3((z tau)^2) span the same space as 1, tau, cos z tau,
/// sin z tau, and become the polynomials of degree 3 where z goes to 0: a basis without cancellation.
/// Derivative: c_k'(x) = (k c_{k+2}(x) - c_{k+1}(x)) / 2.
///
/// The recurrence is used where it loses nothing, x > (k + 2)^2, and the series elsewhere, whose terms grow
/// to e^{k+2} at most. T: double or a number of more digits. An order k that is not an integer from 0 to 40,
/// or an x that is not finite, gives not a number. Source: Stumpff, Himmelsmechanik I (1959), sec. 38.
#pragma once

#include <cmath>
#include <limits>

namespace extremal {

inline constexpr int maxStumpffOrder = 40;

namespace detail {

template <class T>
T stumpffOf(int k, const T& x) {
    using std::abs;
    using std::cos;
    using std::sin;
    using std::sqrt;
    if (x > T((k + 2) * (k + 2))) {
        const T root = sqrt(x);
        T c = k % 2 == 0 ? T(cos(root)) : T(sin(root) / root), factorial(1);
        for (int j = k % 2; j < k; j += 2) {
            c = (T(1) / factorial - c) / x;
            factorial *= T((j + 1) * (j + 2));
        }
        return c;
    }
    T term(1), sum(0);
    for (int j = 2; j <= k; ++j) term /= T(j);
    for (int j = 0; j < 100000; ++j) {
        const T next = sum + term;
        if (next == sum) break;
        sum = next;
        term *= -x / T((k + 2 * j + 1) * (k + 2 * j + 2));
    }
    return sum;
}

}  // namespace detail

template <class T>
T stumpff(const T& order, const T& x) {
    const auto k = static_cast<double>(order);
    const auto size = static_cast<double>(x);
    // Beyond, the series of a negative x takes too many terms, and overflows.
    if (!(k >= 0 && k <= maxStumpffOrder && k == std::floor(k)) || !(size >= -1e6 && size <= 1e12))
        return std::numeric_limits<T>::quiet_NaN();
    return detail::stumpffOf(static_cast<int>(k), x);
}

}  // namespace extremal
