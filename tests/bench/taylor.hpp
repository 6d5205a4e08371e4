// SPDX-License-Identifier: GPL-3.0-or-later
/// A Taylor integrator as an expert writes it for one problem: the coefficients of the solution by
/// recurrence, order and step by the tolerance (Jorba and Zou 2005; Biscani and Izzo 2021), Horner's scheme.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace extremal::bench {

/// Coefficients of one variable; only the first ones are in use.
template <class T>
using TaylorOf = std::array<T, 32>;
using Taylor = TaylorOf<double>;

/// The coefficient n of u v.
template <class T>
T product(const std::array<T, 32>& u, const std::array<T, 32>& v, std::size_t n) {
    T sum = 0;
    for (std::size_t j = 0; j <= n; ++j) sum += u[j] * v[n - j];
    return sum;
}
/// The coefficient n of u^a, n > 0, from its lower ones in w.
template <class T>
T power(const std::array<T, 32>& u, const std::array<T, 32>& w, double a, std::size_t n) {
    T sum = 0;
    for (std::size_t j = 0; j < n; ++j)
        sum += (a * static_cast<double>(n - j) - static_cast<double>(j)) * u[n - j] * w[j];
    return sum / (static_cast<T>(n) * u[0]);
}

/// x'' = f(x) to the time `end`: positions, then velocities. `acceleration(x, n)` is the coefficient n of all
/// accelerations, from the coefficients of the positions up to n.
template <std::size_t d, class T, class Acceleration>
void integrateByTaylor(std::array<T, 2 * d>& y, std::type_identity_t<T> end,
                       std::type_identity_t<T> tolerance, Acceleration&& acceleration) {
    const auto order = std::min<std::size_t>(
        30, static_cast<std::size_t>(std::ceil(-0.5 * std::log(static_cast<double>(tolerance)) + 1)));
    std::array<TaylorOf<T>, d> x;
    T t = 0;
    while (t < end) {
        T size = 0;
        for (std::size_t i = 0; i < d; ++i) {
            x[i][0] = y[i];
            x[i][1] = y[d + i];
            size = std::max(size, std::abs(y[i]));
        }
        for (std::size_t n = 0; n + 2 <= order; ++n) {
            const std::array<T, d> a = acceleration(x, n);
            for (std::size_t i = 0; i < d; ++i) x[i][n + 2] = a[i] / static_cast<T>((n + 1) * (n + 2));
        }
        T last = 0, before = 0;
        for (std::size_t i = 0; i < d; ++i) {
            last = std::max(last, std::abs(x[i][order]));
            before = std::max(before, std::abs(x[i][order - 1]));
        }
        const T n = static_cast<T>(order),
                radius = std::min(std::pow(size / last, 1 / n), std::pow(size / before, 1 / (n - 1)));
        const T h = std::min(end - t, radius * std::exp(-2 - T(0.7) / (n - 1)));
        for (std::size_t i = 0; i < d; ++i) {
            T position = x[i][order], velocity = n * x[i][order];
            for (std::size_t k = order; k-- > 0;) {
                position = position * h + x[i][k];
                if (k > 0) velocity = velocity * h + static_cast<T>(k) * x[i][k];
            }
            y[i] = position;
            y[d + i] = velocity;
        }
        t = t + h >= end * (1 - 1e-15) ? end : t + h;
    }
}

}  // namespace extremal::bench
