// SPDX-License-Identifier: GPL-3.0-or-later
/// The trial curve of the product form in one coordinate, q = P F (product.hpp), with its first and second
/// derivatives by the unknowns X = (p_0..p_n, alpha, beta, and w where it is free): what the chain rule of
/// action/chain_rule.hpp needs of a nonlinear curve.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/algebra/jet.hpp"

namespace extremal {

/// A function of time and its rate.
using Moving = Dual<double, 1>;

/// The curve of one coordinate on a step: X = (p_0..p_n, alpha, beta), and w where it is free.
struct ProductCurve {
    int degree;
    bool isFree;
    double frequency;  ///< where it is not

    int size() const { return degree + (isFree ? 4 : 3); }

    struct At {
        Moving q;
        std::vector<Moving> first, second;  ///< dq/dX_j; d^2 q / dX_j dX_k at j * size + k
    };
    void evaluate(double t, double h, const double* X, At& at) const {
        const int n = size(), alpha = degree + 1, beta = alpha + 1, omega = beta + 1;
        const double a = X[alpha], b = X[beta], w = isFree ? X[omega] : frequency;
        at.first.resize(static_cast<std::size_t>(n));
        at.second.assign(static_cast<std::size_t>(n * n), Moving(0.0));
        const Moving time = Moving::variable(t, 0), x = time * (2 / h) - 1.0;
        const Moving s = sin(time * w), c = cos(time * w), F = 1.0 + s * a + c * b,
                     G = time * (c * a - s * b);
        const auto pair = [&](int j, int k, const Moving& value) {
            at.second[static_cast<std::size_t>(j * n + k)] = at.second[static_cast<std::size_t>(k * n + j)] =
                value;
        };
        Moving P(1.0), lower(0.0), slow(0.0);
        for (int j = 0; j <= degree; ++j) {
            slow += P * X[j];
            at.first[static_cast<std::size_t>(j)] = P * F;
            pair(j, alpha, P * s);
            pair(j, beta, P * c);
            if (isFree) pair(j, omega, P * G);
            const Moving next = (x * P * (2.0 * j + 1) - lower * static_cast<double>(j)) * (1.0 / (j + 1));
            lower = P;
            P = next;
        }
        at.q = slow * F;
        at.first[static_cast<std::size_t>(alpha)] = slow * s;
        at.first[static_cast<std::size_t>(beta)] = slow * c;
        if (!isFree) return;
        at.first[static_cast<std::size_t>(omega)] = slow * G;
        pair(alpha, omega, slow * time * c);
        pair(beta, omega, slow * time * s * -1.0);
        pair(omega, omega, slow * time * time * (s * a + c * b) * -1.0);
    }
};

}  // namespace extremal
