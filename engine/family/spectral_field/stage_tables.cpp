// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/spectral_field/stage_tables.hpp"

#include <Eigen/Core>

#include <cmath>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
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

StageTables::StageTables(const Rule<double>& rule, double h, const std::vector<double>& stiffness)
    : stages_(static_cast<std::size_t>(rule.size())),
      width_(widthOf(stiffness.size())),
      stage_(width_ * stages_ * (stages_ + 2)),
      end_(width_ * 2 * (stages_ + 2)),
      ahead_(extrapolationTable(rule)) {
    fill(rule, h, stiffness);
}

void StageTables::fill(const Rule<double>& rule, double h, const std::vector<double>& stiffness) {
    const auto s = static_cast<Eigen::Index>(stages_);
    const Eigen::MatrixXd A = collocationMatrix(rule);
    const Eigen::Map<const Eigen::VectorXd> b(rule.b.data(), s), c(rule.c.data(), s);
    const Eigen::MatrixXd A2 = A * A;
    const Eigen::VectorXd bA = A.transpose() * b;
    Eigen::MatrixXd right(s, s + 2), all(s, s + 2), ends(2, s + 2);
    right.col(0).setOnes();
    right.col(1) = h * c;
    right.rightCols(s) = h * h * A2;
    for (std::size_t mode = 0; mode < stiffness.size(); ++mode) {
        const double K = stiffness[mode];
        all = dense::inverse<double>(Eigen::MatrixXd::Identity(s, s) + h * h * K * A2) * right;
        // G_j - K u_j: the acceleration at stage j.
        Eigen::MatrixXd rate = -K * all;
        rate.rightCols(s) += Eigen::MatrixXd::Identity(s, s);
        ends.row(0) = h * h * bA.transpose() * rate;
        ends.row(1) = h * b.transpose() * rate;
        ends(0, 0) += 1;
        ends(0, 1) += h;
        ends(1, 1) += 1;
        for (const std::size_t part : {std::size_t{0}, std::size_t{1}}) {
            const std::size_t place = 2 * mode + part, lane = place % block, first = place - lane;
            double* at = stage_.data() + first * stages_ * (stages_ + 2) + lane;
            for (Eigen::Index i = 0; i < s; ++i)
                for (Eigen::Index j = 0; j < s + 2; ++j, at += block) *at = all(i, j);
            at = end_.data() + first * 2 * (stages_ + 2) + lane;
            for (Eigen::Index j = 0; j < s + 2; ++j)
                for (Eigen::Index i = 0; i < 2; ++i, at += block) *at = ends(i, j);
        }
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
