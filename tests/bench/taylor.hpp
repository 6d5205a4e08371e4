// SPDX-License-Identifier: GPL-3.0-or-later
/// A Taylor integrator as an expert writes it for one problem: the coefficients of the solution by
/// recurrence, order and step by the tolerance (Jorba and Zou 2005; Biscani and Izzo 2021), Horner's scheme.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace extremal::bench {

/// Coefficients of one variable; only the first ones are in use.
using Taylor = std::array<double, 32>;

/// The coefficient n of u v.
inline double product(const Taylor& u, const Taylor& v, std::size_t n) {
    double sum = 0;
    for (std::size_t j = 0; j <= n; ++j) sum += u[j] * v[n - j];
    return sum;
}
/// The coefficient n of u^a, n > 0, from its lower ones in w.
inline double power(const Taylor& u, const Taylor& w, double a, std::size_t n) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j)
        sum += (a * static_cast<double>(n - j) - static_cast<double>(j)) * u[n - j] * w[j];
    return sum / (static_cast<double>(n) * u[0]);
}

/// x'' = f(x) to the time `end`: positions, then velocities. `acceleration(x, n)` is the coefficient n of all
/// accelerations, from the coefficients of the positions up to n.
template <std::size_t d, class Acceleration>
void integrateByTaylor(std::array<double, 2 * d>& y, double end, double tolerance,
                       Acceleration&& acceleration) {
    const auto order =
        std::min<std::size_t>(30, static_cast<std::size_t>(std::ceil(-0.5 * std::log(tolerance) + 1)));
    std::array<Taylor, d> x;
    double t = 0;
    while (t < end) {
        double size = 0;
        for (std::size_t i = 0; i < d; ++i) {
            x[i][0] = y[i];
            x[i][1] = y[d + i];
            size = std::max(size, std::abs(y[i]));
        }
        for (std::size_t n = 0; n + 2 <= order; ++n) {
            const std::array<double, d> a = acceleration(x, n);
            for (std::size_t i = 0; i < d; ++i) x[i][n + 2] = a[i] / static_cast<double>((n + 1) * (n + 2));
        }
        double last = 0, before = 0;
        for (std::size_t i = 0; i < d; ++i) {
            last = std::max(last, std::abs(x[i][order]));
            before = std::max(before, std::abs(x[i][order - 1]));
        }
        const double n = static_cast<double>(order),
                     radius = std::min(std::pow(size / last, 1 / n), std::pow(size / before, 1 / (n - 1)));
        const double h = std::min(end - t, radius * std::exp(-2 - 0.7 / (n - 1)));
        for (std::size_t i = 0; i < d; ++i) {
            double position = x[i][order], velocity = n * x[i][order];
            for (std::size_t k = order; k-- > 0;) {
                position = position * h + x[i][k];
                if (k > 0) velocity = velocity * h + static_cast<double>(k) * x[i][k];
            }
            y[i] = position;
            y[d + i] = velocity;
        }
        t = t + h >= end * (1 - 1e-15) ? end : t + h;
    }
}

}  // namespace extremal::bench
