// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/phase_newton.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/solve/correction_size.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

PhaseNewton::PhaseNewton(const PhaseMechanics& mechanics, const SharedCell& cell)
    : H_(mechanics), cell_(cell), lu_(size() <= small ? size() : 0) {
    const int n = cell_->nodes();
    x_ = r_ = rhs_ = Vector::Zero(size());
    Q_ = P_ = Matrix::Zero(d(), n);
    second_.assign(static_cast<std::size_t>(n), Matrix::Zero(2 * d(), 2 * d()));
    gradient_ = Vector::Zero(2 * d());
    moved_ = Matrix::Zero(2 * d(), n);
    matrix_ = Matrix::Zero(size(), size());
}

void PhaseNewton::startFrom(double h, const Eigen::Ref<const Matrix>& K, const Eigen::Ref<const Matrix>& F) {
    const int m = cell_->unknowns(), half = m * d();
    for (int a = 0; a < m; ++a)
        for (int k = 0; k < d(); ++k) {
            double alpha = 0, beta = 0;
            for (int i = 0; i < cell_->nodes(); ++i) {
                alpha += cell_->ofRates(a, i) * K(i, k);
                beta += cell_->ofForces(a, i) * F(i, k);
            }
            x_(a * d() + k) = h * alpha;
            x_(half + a * d() + k) = h * beta;
        }
}

void PhaseNewton::place(const Eigen::Ref<const Vector>& q0, const Eigen::Ref<const Vector>& p0,
                        Eigen::Ref<Matrix> Q, Eigen::Ref<Matrix> P) const {
    const int m = cell_->unknowns(), half = m * d();
    for (int i = 0; i < cell_->nodes(); ++i)
        for (int k = 0; k < d(); ++k) {
            double q = 0, p = 0;
            for (int a = 0; a < m; ++a) {
                q += cell_->value(i, a) * x_(a * d() + k);
                p += cell_->slope(i, a) * x_(half + a * d() + k);
            }
            Q(i, k) = q0(k) + q;
            P(i, k) = cell_->fromStart(i) * p0(k) + p;
        }
}

/// At the nodes in Q_ and P_.
void PhaseNewton::residual(double t, double h) {
    const int m = cell_->unknowns(), half = m * d();
    r_ = x_;
    for (int i = 0; i < cell_->nodes(); ++i) {
        H_.gradient(H_.model.get(), t + cell_->place(i) * h, Q_.col(i).data(), P_.col(i).data(),
                    gradient_.data());
        for (int a = 0; a < m; ++a)
            for (int k = 0; k < d(); ++k) {
                r_(a * d() + k) -= h * cell_->ofRates(a, i) * gradient_(d() + k);
                r_(half + a * d() + k) += h * cell_->ofForces(a, i) * gradient_(k);
            }
    }
}

void PhaseNewton::assemble(double t, double h) {
    const int m = cell_->unknowns(), n = d(), half = m * n;
    matrix_.setIdentity();
    for (int i = 0; i < cell_->nodes(); ++i) {
        Matrix& H = second_[static_cast<std::size_t>(i)];
        H_.hessian(H_.model.get(), t + cell_->place(i) * h, Q_.col(i).data(), P_.col(i).data(), H.data());
        for (int c = 0; c < m; ++c)
            for (int a = 0; a < m; ++a) {
                const double rate = h * cell_->ofRates(a, i), force = h * cell_->ofForces(a, i),
                             value = cell_->value(i, c), slope = cell_->slope(i, c);
                for (int l = 0; l < n; ++l)
                    for (int k = 0; k < n; ++k) {
                        matrix_(a * n + k, c * n + l) -= rate * value * H(n + k, l);
                        matrix_(a * n + k, half + c * n + l) -= rate * slope * H(n + k, n + l);
                        matrix_(half + a * n + k, c * n + l) += force * value * H(k, l);
                        matrix_(half + a * n + k, half + c * n + l) += force * slope * H(k, n + l);
                    }
            }
    }
}

Outcome PhaseNewton::factorise() {
    if (!matrix_.allFinite()) return Outcome::notFinite;
    if (size() > small) {
        large_.compute(matrix_);
        const auto pivots = large_.matrixLU().diagonal().cwiseAbs();
        return isRegular(pivots.minCoeff(), pivots.maxCoeff()) ? Outcome::converged : Outcome::singular;
    }
    for (int j = 0; j < size(); ++j) std::copy_n(matrix_.col(j).data(), size(), lu_.column(j));
    return lu_.factorise();
}

void PhaseNewton::solveFor(double* x) {
    if (size() <= small) return lu_.solve(x);
    Eigen::Map<Vector> b(x, size());
    b = large_.solve(b).eval();
}

/// The correction in r_ against the increments in x_, and what rounding leaves of it: that of q and p at the
/// nodes moves H_q and H_p by H'' times as much.
void PhaseNewton::measure(double h, const Eigen::Ref<const Vector>& q0, const Eigen::Ref<const Vector>& p0,
                          double& size, double& floor) const {
    constexpr double roundOff = 16 * std::numeric_limits<double>::epsilon();
    const int m = cell_->unknowns(), n = d();
    for (int k = 0; k < 2 * n; ++k) {
        const bool isPlace = k < n;
        double change = 0, increments = 0, moved = 0;
        for (int a = 0; a < m; ++a) {
            const int at = (isPlace ? a : m + a - 1) * n + k;
            change = std::max(change, std::abs(r_(at)));
            increments = std::max(increments, std::abs(x_(at)));
        }
        for (std::size_t i = 0; i < second_.size(); ++i) {
            const auto row = second_[i].row(isPlace ? n + k : k - n);
            double sum = 0;
            for (int l = 0; l < n; ++l)
                sum += std::abs(row(l) * Q_(l, static_cast<Eigen::Index>(i))) +
                       std::abs(row(n + l) * P_(l, static_cast<Eigen::Index>(i)));
            moved = std::max(moved, sum);
        }
        size = std::max(size, relativeCorrection(change, increments, isPlace ? q0(k) : p0(k - n)));
        if (increments > 0) floor = std::max(floor, roundOff * std::abs(h) * moved / increments);
    }
}

Outcome PhaseNewton::solve(double t, double h, const Eigen::Ref<const Vector>& q0,
                           const Eigen::Ref<const Vector>& p0, double tolerance, int maxIterations,
                           const std::stop_token& stop, StepReport& report) {
    const int m = cell_->unknowns(), n = d(), half = m * n;
    NewtonPolicy<double> policy(NewtonLimits<double>::elementStep(tolerance));
    for (int iteration = 0; iteration < maxIterations; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        for (int i = 0; i < cell_->nodes(); ++i) {
            Q_.col(i) = q0;
            P_.col(i) = cell_->fromStart(i) * p0;
            for (int a = 0; a < m; ++a) {
                Q_.col(i) += cell_->value(i, a) * x_.segment(a * n, n);
                P_.col(i) += cell_->slope(i, a) * x_.segment(half + a * n, n);
            }
        }
        residual(t, h);
        if (!r_.allFinite()) return Outcome::notFinite;
        assemble(t, h);
        report.cost.evaluations += 2 * cell_->nodes();
        if (const Outcome result = factorise(); result != Outcome::converged) return result;
        solveFor(r_.data());
        ++report.cost.linearSolves;
        ++report.cost.iterations;
        double size = 0, floor = 0;
        measure(h, q0, p0, size, floor);
        report.residual = size;
        x_ -= r_;
        policy.jacobianIsNew();
        if (const auto end = endOf(policy.judge(size, floor))) return *end;
    }
    return Outcome::diverged;
}

bool PhaseNewton::applyTangent(double t, double h, const Eigen::Ref<const Matrix>& Q,
                               const Eigen::Ref<const Matrix>& P, std::span<double> W) {
    const int m = cell_->unknowns(), n = d(), half = m * n;
    Q_ = Q.transpose();
    P_ = P.transpose();
    assemble(t, h);
    if (factorise() != Outcome::converged) return false;
    const auto columns = static_cast<Eigen::Index>(W.size()) / (2 * n);
    for (Eigen::Index j = 0; j < columns; ++j) {
        Eigen::Map<Vector> w(W.data() + j * 2 * n, 2 * n);
        for (int a = 0; a < m; ++a) {
            rhs_.segment(a * n, n).setZero();
            rhs_.segment(half + a * n, n) = cell_->ofMomentum(a) * w.tail(n);
            for (int i = 0; i < cell_->nodes(); ++i) {
                const Matrix& H = second_[static_cast<std::size_t>(i)];
                for (int k = 0; k < n; ++k)
                    for (int l = 0; l < n; ++l) {
                        rhs_(a * n + k) += h * cell_->ofRates(a, i) * H(n + k, l) * w(l);
                        rhs_(half + a * n + k) -= h * cell_->ofForces(a, i) * H(k, l) * w(l);
                    }
            }
        }
        solveFor(rhs_.data());
        moved_.topRows(n).colwise() = w.head(n);
        moved_.bottomRows(n).setZero();
        for (int i = 0; i < cell_->nodes(); ++i)
            for (int a = 0; a < m; ++a) {
                moved_.col(i).head(n) += cell_->value(i, a) * rhs_.segment(a * n, n);
                moved_.col(i).tail(n) += cell_->slope(i, a) * rhs_.segment(half + a * n, n);
            }
        w.head(n) += rhs_.segment((m - 1) * n, n);
        for (int i = 0; i < cell_->nodes(); ++i) {
            const Matrix& H = second_[static_cast<std::size_t>(i)];
            w.tail(n) -= h * cell_->weight(i) * H.topRows(n).lazyProduct(moved_.col(i));
        }
    }
    return true;
}

}  // namespace extremal
