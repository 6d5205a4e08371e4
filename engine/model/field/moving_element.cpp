// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/moving_element.hpp"

#include "engine/quadrature/rule.hpp"

namespace extremal {
namespace {

constexpr std::size_t gaussPoints = 4;

const Rule<double>& potentialRule() {
    static const Rule<double> rule = gauss<double>(static_cast<int>(gaussPoints));
    return rule;
}

/// z enters through d = y_R - y_L and h = X_R - X_L, but for the potential: z_i counts with this sign in
/// entry i % 2 of (d, h).
constexpr double endSign[4] = {-1, -1, 1, 1};

/// The kinetic energy as a function of (d, h, v), with what its derivatives share.
struct Motion {
    double h, s, wL, wR;
    double A, B;  ///< derivatives by w_L and w_R
    double k;     ///< kinetic energy over h

    Motion(const double* z, const double* v) {
        h = z[3] - z[1];
        s = (z[2] - z[0]) / h;
        wL = v[0] - s * v[1];
        wR = v[2] - s * v[3];
        A = h * (2 * wL + wR) / 6;
        B = h * (wL + 2 * wR) / 6;
        k = (wL * wL + wL * wR + wR * wR) / 6;
    }
};

}  // namespace

PotentialMomentsOf::PotentialMomentsOf(const FieldPotential& potential, std::size_t elements)
    : potential_(potential), moments_(elements) {
    for (auto* buffer : {&u_, &W_, &slope_, &curvature_}) buffer->resize(gaussPoints * elements);
}

void PotentialMomentsOf::evaluate(const double* y, bool withCurvature) {
    const Rule<double>& rule = potentialRule();
    if (potential_.kind() == FieldPotential::Kind::none) return;
    for (std::size_t e = 0; e < moments_.size(); ++e)
        for (std::size_t q = 0; q < gaussPoints; ++q)
            u_[gaussPoints * e + q] = (1 - rule.c[q]) * y[e] + rule.c[q] * y[e + 1];
    potential_.evaluate(u_.data(), u_.size(), W_.data(), slope_.data(),
                        withCurvature ? curvature_.data() : nullptr);
    for (std::size_t e = 0; e < moments_.size(); ++e) {
        PotentialMoments m;
        for (std::size_t q = 0; q < gaussPoints; ++q) {
            const double xi = rule.c[q], b = rule.b[q];
            const std::size_t p = gaussPoints * e + q;
            m.W += b * W_[p];
            m.left += b * (1 - xi) * slope_[p];
            m.right += b * xi * slope_[p];
            if (!withCurvature) continue;
            m.leftLeft += b * (1 - xi) * (1 - xi) * curvature_[p];
            m.leftRight += b * (1 - xi) * xi * curvature_[p];
            m.rightRight += b * xi * xi * curvature_[p];
        }
        moments_[e] = m;
    }
}

ElementEnergy elementEnergy(const double* z, const double* v, double c2, double W) {
    const Motion m(z, v);
    return {m.h * m.k, m.h * (c2 * m.s * m.s / 2 + W)};
}

void elementGradient(const double* z, const double* v, double c2, const PotentialMoments& W,
                     ElementDerivatives& to) {
    const Motion m(z, v);
    to.v = {m.A, -m.s * m.A, m.B, -m.s * m.B};
    // by d and by h
    const double Q = (m.A * v[1] + m.B * v[3]) / m.h;
    const double d = -Q - c2 * m.s, h = Q * m.s + m.k + c2 * m.s * m.s / 2 - W.W;
    to.z = {-d - m.h * W.left, -h, d - m.h * W.right, h};
}

void elementDerivatives(const double* z, const double* v, double c2, const PotentialMoments& W,
                        ElementDerivatives& to) {
    elementGradient(z, v, c2, W, to);
    const Motion m(z, v);
    const double h = m.h, s = m.s;
    // w_L and w_R as functions of q = (d, h, v): first derivatives, and those second ones that are not 0.
    const double wL[6] = {-v[1] / h, s * v[1] / h, 1, -s, 0, 0},
                 wR[6] = {-v[3] / h, s * v[3] / h, 0, 0, 1, -s};
    double T[6][6];
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            T[i][j] = h / 3 * (wL[i] * wL[j] + wR[i] * wR[j]) + h / 6 * (wL[i] * wR[j] + wR[i] * wL[j]);
    const auto add = [&](int i, int j, double value) {
        T[i][j] += value;
        if (i != j) T[j][i] += value;
    };
    const double Q = m.A * v[1] + m.B * v[3];
    add(0, 1, Q / (h * h) + c2 * s / h);
    T[1][1] += -2 * s * Q / (h * h) - c2 * s * s / h;
    T[0][0] -= c2 / h;
    add(0, 3, -m.A / h);
    add(1, 3, m.A * s / h);
    add(0, 5, -m.B / h);
    add(1, 5, m.B * s / h);
    // the explicit h of l: k + ..., whose derivatives by q are (A wL_j + B wR_j) / h
    for (int j = 0; j < 6; ++j) {
        const double cross = (m.A * wL[j] + m.B * wR[j]) / h;
        T[1][j] += cross;
        T[j][1] += cross;
    }
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            to.zz[i][j] = endSign[i] * endSign[j] * T[i % 2][j % 2];
            to.zv[i][j] = endSign[i] * T[i % 2][2 + j];
            to.vv[i][j] = T[2 + i][2 + j];
        }
    const auto both = [&](std::size_t i, std::size_t j, double value) {
        to.zz[i][j] += value;
        if (i != j) to.zz[j][i] += value;
    };
    both(0, 0, -h * W.leftLeft);
    both(0, 2, -h * W.leftRight);
    both(2, 2, -h * W.rightRight);
    both(0, 1, W.left);
    both(0, 3, -W.left);
    both(2, 1, W.right);
    both(2, 3, -W.right);
}

void elementMass(const double* z, ElementDerivatives::Matrix& mass) {
    const double h = z[3] - z[1], s = (z[2] - z[0]) / h;
    const double w[2][4] = {{1, -s, 0, 0}, {0, 0, 1, -s}};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            mass[i][j] = h / 3 * (w[0][i] * w[0][j] + w[1][i] * w[1][j]) +
                         h / 6 * (w[0][i] * w[1][j] + w[1][i] * w[0][j]);
}

}  // namespace extremal
