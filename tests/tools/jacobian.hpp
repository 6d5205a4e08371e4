// SPDX-License-Identifier: GPL-3.0-or-later
/// The Jacobian of a step by central differences of order 6, and how far it is from symplectic.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/state.hpp"

namespace extremal {

/// The weights of f(x + k delta) - f(x - k delta), k = 1, 2, 3, in delta f'(x).
inline constexpr std::array<double, 3> centralDifferences = {45. / 60, -9. / 60, 1. / 60};

/// A square matrix, row after row.
struct Jacobian {
    std::size_t size = 0;
    std::vector<double> entries;
    double operator()(std::size_t i, std::size_t j) const { return entries[i * size + j]; }
};

/// Of `step`, a function from a state to std::optional<State>, at `start`; entry (i, j) and the displacements
/// `delta` in units of `own`, one per entry of the state (empty: all 1). Nothing where a step fails.
template <class Step>
std::optional<Jacobian> jacobianOf(const Step& step, const State& start, double delta,
                                   std::span<const double> own = {}) {
    const std::size_t n = start.x.size();
    const auto unit = [&](std::size_t i) { return own.empty() ? 1.0 : own[i]; };
    Jacobian M{n, std::vector<double>(n * n)};
    for (std::size_t j = 0; j < n; ++j)
        for (int k = 1; k <= 3; ++k)
            for (const int sign : {1, -1}) {
                State from = start;
                from.x[j] += sign * k * delta * unit(j);
                const std::optional<State> end = step(from);
                if (!end) return std::nullopt;
                for (std::size_t i = 0; i < n; ++i)
                    M.entries[i * n + j] += sign * centralDifferences[static_cast<std::size_t>(k - 1)] *
                                            end->x[i] / (delta * unit(i));
            }
    return M;
}

/// The largest entry of M^T J M - J for coordinates before their momenta, relative to the largest entry of M.
/// `action` is the product of the units of a coordinate and its momentum (empty: all 1). On a manifold the
/// columns of `tangent` are those of its tangents B at the start, those of M their images, and the form is
/// B^T J B.
inline double symplecticDefect(const Jacobian& M, std::span<const double> action = {},
                               const Jacobian* tangent = nullptr) {
    const std::size_t d = M.size / 2;
    const auto unit = [&](std::size_t i) { return action.empty() ? 1.0 : action[i % d]; };
    double largest = 0, defect = 0;
    for (std::size_t i = 0; i < M.size; ++i)
        for (std::size_t j = 0; j < M.size; ++j) {
            largest = std::max(largest, std::abs(M(i, j)));
            double w = tangent ? 0 : j == i + d ? -unit(i) : i == j + d ? unit(j) : 0;
            const auto form = [&](const Jacobian& of, std::size_t k) {
                return unit(k) * (of(k, i) * of(k + d, j) - of(k + d, i) * of(k, j));
            };
            for (std::size_t k = 0; k < d; ++k) w += form(M, k) - (tangent ? form(*tangent, k) : 0);
            defect = std::max(defect, std::abs(w) / std::sqrt(unit(i) * unit(j)));
        }
    return defect / largest;
}

/// The largest entry of a matrix.
inline double largestEntry(const Jacobian& M) {
    double largest = 0;
    for (const double v : M.entries) largest = std::max(largest, std::abs(v));
    return largest;
}

}  // namespace extremal
