// SPDX-License-Identifier: GPL-3.0-or-later
/// The scheme of the framework on the three rods of the four-bar, as an expert writes it for this one
/// mechanism: what a step in the four coordinates of the joints could cost.
///
/// The curve of a step is the polynomial through the places u_0..u_s at Lobatto nodes, where the rods hold;
/// the action and the forces have s Gauss nodes. With the tests l_a through the same nodes
///     R_a = sum_i b_i [h l_a (L_q + F) + l_a' L_v] + rods at u_a = -p_0 (a = 0), 0 (0 < a < s), p_1 (a = s),
/// is linear in places but for the rods, as weights, torque and damper are. Along the one motion tau(u) that
/// rods leave free they drop out: s equations for s steps along tau in place of seven times as many unknowns.
/// Their matrix is nearly tau_a.M tau_b K_ab / h with the constant K = sum_i b_i l_a' l_b', so that its
/// inverse is K^-1 between the roots of the masses along tau, and nothing is factorised in a step.
#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/core/algebra/lanes.hpp"
#include "engine/quadrature/rule.hpp"
#include "tests/bench/four_bar.hpp"

namespace extremal::bench {

/// The matrices of s stages by columns, the equation or the node in the lanes; tests a = 0..s-1, and the last
/// one apart, on increments of the nodes b = 1..s from the start.
struct RodTables {
    struct Form {
        std::array<Lanes, 8> column{};
        Lanes last;  ///< of the test at the end, node by node
    };
    Form slopes, values, mixed;  ///< l_a' l_b', l_a l_b, l_a l_b'
    Lanes weight;                ///< of l_a
    double lastWeight = 0;
    std::array<Lanes, 8> inverse{};    ///< of `slopes`: nodes by equations
    std::array<Lanes, 8> continued{};  ///< increments in the next step by those of this one

    explicit RodTables(int s) {
        const Rule<double> nodes = lobatto<double>(s + 1), rule = extremal::gauss<double>(s);
        const auto size = static_cast<Eigen::Index>(s + 1);
        Eigen::MatrixXd value(s, size), slope(s, size), next(s, size);
        for (Eigen::Index b = 0; b < size; ++b)
            for (Eigen::Index i = 0; i < s; ++i) {
                std::tie(value(i, b), slope(i, b)) = lagrange(nodes.c, b, rule.c[at(i)]);
                next(i, b) = lagrange(nodes.c, b, 1 + nodes.c[at(i + 1)]).first;
            }
        const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(rule.b.data(), s);
        const Eigen::MatrixXd K = slope.transpose() * b.asDiagonal() * slope;
        take(slopes, K);
        take(values, value.transpose() * b.asDiagonal() * value);
        take(mixed, value.transpose() * b.asDiagonal() * slope);
        const Eigen::VectorXd w = value.transpose() * b;
        const Eigen::MatrixXd inverted = K.block(0, 1, s, s).inverse();
        lastWeight = w(s);
        for (Eigen::Index i = 0; i < s; ++i) {
            weight.lane[at(i)] = w(i);
            for (Eigen::Index j = 0; j < s; ++j) {
                inverse[at(j)].lane[at(i)] = inverted(i, j);
                continued[at(j)].lane[at(i)] = next(i, j + 1) - (j + 1 == s ? 1 : 0);
            }
        }
    }
    template <std::size_t stages>
    static const RodTables& of() {
        static const RodTables tables(static_cast<int>(stages));
        return tables;
    }

private:
    static std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }
    static void take(Form& form, const Eigen::MatrixXd& all) {
        const Eigen::Index s = all.rows() - 1;
        for (Eigen::Index b = 0; b < s; ++b) {
            for (Eigen::Index a = 0; a < s; ++a) form.column[at(b)].lane[at(a)] = all(a, b + 1);
            form.last.lane[at(b)] = all(s, b + 1);
        }
    }
    /// l_b and l_b' at x.
    static std::pair<double, double> lagrange(const std::vector<double>& c, Eigen::Index b, double x) {
        double value = 1, slope = 0;
        for (std::size_t k = 0; k < c.size(); ++k) {
            if (k == at(b)) continue;
            const double gap = c[at(b)] - c[k];
            slope = (slope * (x - c[k]) + value) / gap;
            value *= (x - c[k]) / gap;
        }
        return {value, slope};
    }
};

/// The motion that the rods leave free at some places, by the angle of the crank, and what brings the places
/// back onto the rods.
template <class T>
struct FreeOfRods {
    std::array<T, 4> tangent, back;

    FreeOfRods(const T& x1, const T& y1, const T& x2, const T& y2) {
        const T dx = x2 - x1, dy = y2 - y1, ex = x2 - T(FourBar::base), ey = y2;
        const T inverse = T(1.0) / (ex * dy - ey * dx), turn = (dy * x1 - dx * y1) * inverse;
        tangent = {-y1, x1, -(turn * ey), turn * ex};
        const T half(0.5), crank = half * (x1 * x1 + y1 * y1 - T(1.0)),
                           coupler = half * (dx * dx + dy * dy - T(FourBar::coupler * FourBar::coupler)),
                           rocker = half * (ex * ex + ey * ey - T(FourBar::rocker * FourBar::rocker));
        const T bx = -(crank * x1), by = -(crank * y1), along = dx * bx + dy * by - coupler;
        back = {bx, by, -((along * ey + rocker * dy) * inverse), (along * ex + rocker * dx) * inverse};
    }
    T mass() const {
        return T(FourBar::m1) * (tangent[0] * tangent[0] + tangent[1] * tangent[1]) +
               T(FourBar::m2) * (tangent[2] * tangent[2] + tangent[3] * tangent[3]);
    }
};

/// Places, and the momentum along the free motion there.
struct OnRods {
    std::array<double, 4> u;
    double momentum;
};

/// Sums over s nodes.
template <std::size_t s>
struct OverNodes {
    static Lanes product(const std::array<Lanes, 8>& columns, const Lanes& x) {
        Lanes sum(0.0);
        for (std::size_t j = 0; j < s; ++j) sum += columns[j] * Lanes(x.lane[j]);
        return sum;
    }
    static double dot(const Lanes& a, const Lanes& b) {
        double sum = 0;
        for (std::size_t j = 0; j < s; ++j) sum += a.lane[j] * b.lane[j];
        return sum;
    }
    /// Of nodes 0..s-1, from the start's and those of nodes 1..s.
    static Lanes behind(double first, const Lanes& nodes) {
        Lanes all(first);
        for (std::size_t j = 1; j < 8; ++j) all.lane[j] = nodes.lane[j - 1];
        return all;
    }
};

/// n steps, each until no place moves by more than `tolerance`, or at round-off.
template <std::size_t s>
void integrateOnRods(OnRods& state, double end, double n, double tolerance) {
    using Four = std::array<Lanes, 4>;
    constexpr auto product = &OverNodes<s>::product;
    constexpr auto dot = &OverNodes<s>::dot;
    constexpr auto behind = &OverNodes<s>::behind;
    const RodTables& tables = RodTables::of<s>();
    const double h = end / n;
    constexpr double m1 = FourBar::m1, m2 = FourBar::m2, g = FourBar::g;
    RodTables::Form rocker;  // m2 l_a' l_b' / h - damping l_a l_b'
    for (std::size_t j = 0; j < s; ++j)
        rocker.column[j] =
            Lanes(m2 / h) * tables.slopes.column[j] - Lanes(FourBar::damping) * tables.mixed.column[j];
    rocker.last = Lanes(m2 / h) * tables.slopes.last - Lanes(FourBar::damping) * tables.mixed.last;
    const Lanes crank(m1 / h), torque(h * FourBar::torque);

    auto& u = state.u;
    FreeOfRods<double> start(u[0], u[1], u[2], u[3]);
    Four U;  // increments of nodes 1..s, 0 beyond
    for (std::size_t k = 0; k < 4; ++k) U[k] = Lanes(0.0);
    for (double step = 0; step < n; ++step) {
        const auto place = [&](std::size_t k) { return Lanes(u[k]) + U[k]; };
        Lanes root, startRoot;
        double before = HUGE_VAL;
        for (int iteration = 0; iteration < 60; ++iteration) {
            const FreeOfRods<Lanes> free(place(0), place(1), place(2), place(3));
            if (iteration == 0) {
                root = Lanes(1.0) / sqrt(free.mass());
                startRoot = behind(1 / std::sqrt(start.mass()), root) * Lanes(-h);
            }
            for (std::size_t k = 0; k < 4; ++k) U[k] += free.back[k];
            const Lanes& w = tables.weight;
            const Lanes R0 = crank * product(tables.slopes.column, U[0]) -
                             torque * (w * Lanes(u[1]) + product(tables.values.column, U[1])),
                        R1 = crank * product(tables.slopes.column, U[1]) +
                             torque * (w * Lanes(u[0]) + product(tables.values.column, U[0])) -
                             Lanes(h * m1 * g) * w,
                        R2 = product(rocker.column, U[2]),
                        R3 = product(rocker.column, U[3]) - Lanes(h * m2 * g) * w;
            Lanes E = behind(start.tangent[0], free.tangent[0]) * R0 +
                      behind(start.tangent[1], free.tangent[1]) * R1 +
                      behind(start.tangent[2], free.tangent[2]) * R2 +
                      behind(start.tangent[3], free.tangent[3]) * R3;
            E.lane[0] += state.momentum;
            const Lanes along = root * product(tables.inverse, startRoot * E);
            double change = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const Lanes by = free.tangent[k] * along;
                for (std::size_t j = 0; j < s; ++j)
                    change = std::max(change, std::abs(by.lane[j]) + std::abs(free.back[k].lane[j]));
                U[k] += by;
            }
            if (change <= tolerance || (change < 1e-13 && change >= before) || !(change < 1e3)) break;
            before = change;
        }
        std::array<double, 4> last{
            m1 / h * dot(tables.slopes.last, U[0]) -
                h * FourBar::torque * (tables.lastWeight * u[1] + dot(tables.values.last, U[1])),
            m1 / h * dot(tables.slopes.last, U[1]) +
                h * FourBar::torque * (tables.lastWeight * u[0] + dot(tables.values.last, U[0])) -
                h * m1 * g * tables.lastWeight,
            dot(rocker.last, U[2]), dot(rocker.last, U[3]) - h * m2 * g * tables.lastWeight};
        for (std::size_t k = 0; k < 4; ++k) u[k] += U[k].lane[s - 1];
        start = FreeOfRods<double>(u[0], u[1], u[2], u[3]);
        state.momentum = 0;
        for (std::size_t k = 0; k < 4; ++k) state.momentum += start.tangent[k] * last[k];
        for (std::size_t k = 0; k < 4; ++k) U[k] = product(tables.continued, U[k]);
    }
}

}  // namespace extremal::bench
