// SPDX-License-Identifier: GPL-3.0-or-later
/// Integrators of x' = f(x) as an expert writes them by hand, with the number of unknowns known to the
/// compiler: Gauss collocation by fixed-point iteration with its nodes side by side in vector registers
/// (Hairer, Lubich, Wanner 2006, VIII.6), and Taylor series of order and step by the tolerance (Jorba and
/// Zou 2005).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "engine/core/algebra/lanes.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal::bench {

/// Of Gauss collocation with up to eight nodes, one in each lane.
struct GaussLanes {
    std::array<Lanes, 8> a{};          ///< a[j]: the share of node j in the places of all nodes
    std::array<Lanes, 8> continued{};  ///< what the polynomial through the rates of a step says of the next
    std::array<double, 8> b{};

    explicit GaussLanes(std::size_t stages) {
        const Rule<double> rule = extremal::gauss<double>(static_cast<int>(stages));
        std::array<double, 8> share{};
        for (std::size_t i = 0; i < stages; ++i) {
            partialWeights(rule, rule.c[i], std::span<double>(share.data(), stages));
            b[i] = rule.b[i];
            for (std::size_t j = 0; j < stages; ++j) {
                a[j].lane[i] = share[j];
                double l = 1;
                for (std::size_t k = 0; k < stages; ++k)
                    if (k != j) l *= (1 + rule.c[i] - rule.c[k]) / (rule.c[j] - rule.c[k]);
                continued[j].lane[i] = l;
            }
        }
    }
    template <std::size_t stages>
    static const GaussLanes& of() {
        static const GaussLanes tables(stages);
        return tables;
    }
};

/// n steps, each until the rates of all nodes move no place by more than `tolerance`, or at round-off.
/// `rates(x, dx)` on d numbers and on d lanes. Unused lanes repeat the last node, to stay harmless.
template <std::size_t d, std::size_t stages, class Rates>
void integrateByGauss(std::array<double, d>& y, double end, double n, double tolerance, Rates&& rates) {
    const GaussLanes& tables = GaussLanes::of<stages>();
    const double h = end / n;
    std::array<Lanes, d> K, next, x;
    std::array<double, d> start, lost{};
    rates(y.data(), start.data());
    for (std::size_t k = 0; k < d; ++k) K[k] = Lanes(start[k]);
    for (double step = 0; step < n; ++step) {
        double before = HUGE_VAL;
        for (int iteration = 0; iteration < 60; ++iteration) {
            for (std::size_t k = 0; k < d; ++k) {
                Lanes sum(0.0);
                for (std::size_t j = 0; j < stages; ++j) sum += tables.a[j] * Lanes(K[k].lane[j]);
                x[k] = Lanes(y[k]) + Lanes(h) * sum;
            }
            rates(x.data(), next.data());
            Lanes most(0.0);
            for (std::size_t k = 0; k < d; ++k) {
                for (std::size_t i = 0; i < 8; ++i)
                    most.lane[i] = std::max(most.lane[i], std::abs(next[k].lane[i] - K[k].lane[i]));
                K[k] = next[k];
            }
            double change = 0;
            for (std::size_t i = 0; i < stages; ++i) change = std::max(change, h * most.lane[i]);
            if (change <= tolerance || (change < 1e-13 && change >= before) || !(change < 1e3)) break;
            before = change;
        }
        for (std::size_t k = 0; k < d; ++k) {
            double sum = 0;
            Lanes continued(0.0);
            for (std::size_t j = 0; j < stages; ++j) {
                sum += tables.b[j] * K[k].lane[j];
                continued += tables.continued[j] * Lanes(K[k].lane[j]);
            }
            K[k] = continued;
            const double more = h * sum + lost[k], total = y[k] + more;
            lost[k] = (y[k] - total) + more;
            y[k] = total;
        }
    }
}

/// Series of order up to 30 of d unknowns; `Series` gives the coefficients n of all rates from those up to n
/// of the unknowns: `rates(x, n, dx)` with x[n][i].
template <std::size_t d, class Series>
void integrateByTaylorRates(std::array<double, d>& y, double end, double tolerance, Series&& rates) {
    const auto order =
        std::min<std::size_t>(30, static_cast<std::size_t>(std::ceil(-0.5 * std::log(tolerance) + 1)));
    std::array<std::array<double, d>, 31> x;
    for (double t = 0; t < end;) {
        x[0] = y;
        for (std::size_t n = 0; n < order; ++n) {
            rates(x, n, x[n + 1]);
            for (double& each : x[n + 1]) each /= static_cast<double>(n + 1);
        }
        double size = 0, last = 0, before = 0;
        for (std::size_t i = 0; i < d; ++i) {
            size = std::max(size, std::abs(y[i]));
            last = std::max(last, std::abs(x[order][i]));
            before = std::max(before, std::abs(x[order - 1][i]));
        }
        const double n = static_cast<double>(order),
                     radius = std::min(std::pow(size / last, 1 / n), std::pow(size / before, 1 / (n - 1)));
        const double h = std::min(end - t, radius * std::exp(-2 - 0.7 / (n - 1)));
        y = x[order];
        for (std::size_t k = order; k-- > 0;)
            for (std::size_t i = 0; i < d; ++i) y[i] = y[i] * h + x[k][i];
        t = t + h >= end * (1 - 1e-15) ? end : t + h;
    }
}

}  // namespace extremal::bench
