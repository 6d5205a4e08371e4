// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/tableau/tableau.hpp"

namespace extremal {
namespace {

Quad valueAt(const std::vector<Quad>& polynomial, const Quad& x) {
    Quad sum(0);
    for (auto c = polynomial.rbegin(); c != polynomial.rend(); ++c) sum = sum * x + *c;
    return sum;
}

}  // namespace

/// Faddeev and LeVerrier: M_k = M (M_{k-1} + e_{k-1} I) with alternating signs, e_k = trace / k.
std::vector<Quad> expandedDeterminant(const Tableau::Matrix& M) {
    constexpr double noise = 1e-28;
    const Eigen::Index n = M.rows();
    std::vector<Quad> e{Quad(1)};
    Tableau::Matrix power = Tableau::Matrix::Identity(n, n);
    for (Eigen::Index k = 1; k <= n; ++k) {
        const Tableau::Matrix product = M * power;
        e.push_back(product.trace() / Quad(static_cast<int>(k)));
        power = e.back() * Tableau::Matrix::Identity(n, n) - product;
    }
    while (e.size() > 1 && abs(e.back()) <= noise) e.pop_back();
    return e;
}

Quad RationalFunction::operator()(const Quad& x) const {
    return valueAt(numerator, x) / valueAt(denominator, x);
}

RationalFunction stabilityFunction(const Tableau& t) {
    const auto ones = Tableau::Vector::Ones(t.velocities());
    return {expandedDeterminant(ones * t.b.transpose() - t.A), expandedDeterminant(-t.A)};
}

/// q_1 = q_0 + b^T P, p_1 = p_0 - z^2 bHat^T Q, with P = p_0 - z^2 Ahat Q and Q = q_0 + A P eliminated; both
/// entries of the diagonal by det(I + u v^T) = 1 + v^T u.
RationalFunction oscillatorTrace(const Tableau& t) {
    const auto ofV = Tableau::Vector::Ones(t.velocities()), ofF = Tableau::Vector::Ones(t.forces());
    const Tableau::Matrix forth = t.Ahat * t.A, back = t.A * t.Ahat;
    const Tableau::Matrix atQ = forth - (t.Ahat * ofF) * t.b.transpose(),
                          atP = back - (t.A * ofV) * t.bHat.transpose();
    std::vector<Quad> sum = expandedDeterminant(atQ), other = expandedDeterminant(atP);
    sum.resize(std::max(sum.size(), other.size()), Quad(0));
    for (std::size_t k = 0; k < other.size(); ++k) sum[k] += other[k];
    for (Quad& c : sum) c /= 2;
    return {sum, expandedDeterminant(forth)};
}

std::string fractionText(const Quad& x, double known) {
    constexpr double most = 1e6;
    const double enough = std::max(100 * known, 1e-29);
    // Continued fractions: the convergents p/q.
    Quad p0(0), q0(1), p1(1), q1(0), rest = x;
    for (int k = 0; k < 40; ++k) {
        const Quad whole = floor(rest);
        const Quad p2 = whole * p1 + p0, q2 = whole * q1 + q0;
        if (q2 > most || abs(p2) > 1e12) return {};
        p0 = p1;
        q0 = q1;
        p1 = p2;
        q1 = q2;
        if (abs(p1 / q1 - x) <= enough * std::max(Quad(1), Quad(abs(x)))) {
            const std::string over = q1 == 1 ? "" : "/" + std::to_string(static_cast<long long>(q1));
            return std::to_string(static_cast<long long>(p1)) + over;
        }
        rest = 1 / (rest - whole);
    }
    return {};
}

std::string numberText(const Quad& x, int digits, double known) {
    if (const std::string fraction = fractionText(x, known); !fraction.empty()) return fraction;
    return x.str(digits, abs(x) < 1e-6 ? std::ios_base::scientific : std::ios_base::fixed);
}

}  // namespace extremal
