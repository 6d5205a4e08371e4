// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/stage_tables.hpp"

#include <Eigen/Core>

#include <cmath>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/family/time_table.hpp"
#include "engine/quadrature/collocation.hpp"

namespace extremal {
namespace {

constexpr std::size_t block = Lanes::size;

inline void stageLanes(const double* table, std::size_t stages, std::size_t width, const double* U,
                       const double* V, const double* G, double* Y) {
    for (std::size_t m = 0; m < width; m += block) {
        const Lanes u = Lanes::load(U + m), v = Lanes::load(V + m);
        for (std::size_t i = 0; i < stages; ++i) {
            Lanes sum = Lanes::load(table) * u + Lanes::load(table + block) * v;
            table += 2 * block;
            for (std::size_t j = 0; j < stages; ++j, table += block)
                sum += Lanes::load(table) * Lanes::load(G + j * width + m);
            sum.store(Y + i * width + m);
        }
    }
}

inline void endLanes(const double* table, std::size_t stages, std::size_t width, const double* G, double* U,
                     double* V) {
    for (std::size_t m = 0; m < width; m += block) {
        const Lanes u = Lanes::load(U + m), v = Lanes::load(V + m);
        Lanes sumU = Lanes::load(table) * u + Lanes::load(table + 2 * block) * v,
              sumV = Lanes::load(table + block) * u + Lanes::load(table + 3 * block) * v;
        table += 4 * block;
        for (std::size_t j = 0; j < stages; ++j, table += 2 * block) {
            const Lanes g = Lanes::load(G + j * width + m);
            sumU += Lanes::load(table) * g;
            sumV += Lanes::load(table + block) * g;
        }
        sumU.store(U + m);
        sumV.store(V + m);
    }
}

inline void aheadLanes(const double* table, std::size_t stages, std::size_t width, const double* G,
                       double* next) {
    for (std::size_t m = 0; m < width; m += block)
        for (std::size_t i = 0; i < stages; ++i) {
            Lanes sum;
            for (std::size_t j = 0; j < stages; ++j)
                sum += Lanes(table[i * stages + j]) * Lanes::load(G + j * width + m);
            sum.store(next + i * width + m);
        }
}

}  // namespace

StageTables::StageTables(int degree, const Rule<double>& rule, double h, const std::vector<double>& stiffness)
    : stages_(static_cast<std::size_t>(rule.size())),
      width_(widthOf(stiffness.size())),
      stage_(width_ * stages_ * (stages_ + 2)),
      end_(width_ * 2 * (stages_ + 2)),
      ahead_(extrapolationTable(rule)) {
    fill(degree, rule, h, stiffness);
}

void StageTables::fill(int degree, const Rule<double>& rule, double h, const std::vector<double>& stiffness) {
    const TimeTable time(degree, rule);
    const auto s = static_cast<Eigen::Index>(degree), q = static_cast<Eigen::Index>(stages_);
    // Row l: psi_l at the nodes; what is known comes in columns of u, h v and h^2 G.
    Eigen::MatrixXd psi(s + 1, q), slope(s + 1, q), known = Eigen::MatrixXd::Zero(q, q + 2);
    for (Eigen::Index i = 0; i < q; ++i)
        for (Eigen::Index l = 0; l <= s; ++l) {
            psi(l, i) = time.value(static_cast<int>(i), static_cast<int>(l));
            slope(l, i) = time.slope(static_cast<int>(i), static_cast<int>(l));
        }
    const Eigen::Map<const Eigen::VectorXd> b(rule.b.data(), q), c(rule.c.data(), q);
    known.col(0).setOnes();
    known.col(1) = c;
    const Eigen::MatrixXd weighted = psi.topRows(s) * b.asDiagonal(),
                          mass = slope.topRows(s) * b.asDiagonal() * slope.bottomRows(s).transpose(),
                          values = psi.bottomRows(s).transpose();
    Eigen::VectorXd start = slope.topRows(s) * b;  // e_l
    start(0) += 1;
    Eigen::MatrixXd all(q, q + 2), right(s, q + 2), ends(2, q + 2);
    const auto solve = [&](double K) {
        right = K * weighted * known;
        right.col(1) -= start;
        right.rightCols(q) -= weighted;
        const Eigen::MatrixXd d = dense::solve<double>(mass - K * weighted * values, right);
        all = known + values * d;
        // h^2 (G_q - K u_q): the acceleration at the nodes.
        Eigen::MatrixXd rate = -K * all;
        rate.rightCols(q) += Eigen::MatrixXd::Identity(q, q);
        ends.row(0) = d.row(s - 1);
        ends(0, 0) += 1;
        ends(0, 1) += 1;
        ends.row(1) = b.transpose() * rate;
        ends(1, 1) += 1;
        ends.row(1) /= h;
        for (auto* rows : {&all, &ends}) {
            rows->col(1) *= h;
            rows->rightCols(q) *= h * h;
        }
    };
    for (std::size_t number = 0; number < stiffness.size(); ++number) {
        // Real and imaginary parts have one K.
        if (number == 0 || stiffness[number] != stiffness[number - 1]) solve(h * h * stiffness[number]);
        const std::size_t lane = number % block, first = number - lane;
        double* at = stage_.data() + first * stages_ * (stages_ + 2) + lane;
        for (Eigen::Index i = 0; i < q; ++i)
            for (Eigen::Index j = 0; j < q + 2; ++j, at += block) *at = all(i, j);
        at = end_.data() + first * 2 * (stages_ + 2) + lane;
        for (Eigen::Index j = 0; j < q + 2; ++j)
            for (Eigen::Index i = 0; i < 2; ++i, at += block) *at = ends(i, j);
    }
}

void StageTables::toStages(const double* U, const double* V, const double* G, double* Y) const {
    static const auto call = ForThisMachine<&stageLanes>::call();
    call(stage_.data(), stages_, width_, U, V, G, Y);
}

void StageTables::toEnd(const double* G, double* U, double* V) const {
    static const auto call = ForThisMachine<&endLanes>::call();
    call(end_.data(), stages_, width_, G, U, V);
}

void StageTables::extrapolate(const double* G, double* next) const {
    static const auto call = ForThisMachine<&aheadLanes>::call();
    call(ahead_.data(), stages_, width_, G, next);
}

}  // namespace extremal
