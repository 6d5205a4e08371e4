// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of GalerkinStep for any scalar and dimension. Included where it is instantiated:
/// galerkin.cpp for double, the tests for quadruple precision.
#pragma once

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/exact_sum.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/integrator/galerkin_step_solve.hpp"
#include "engine/integrator/galerkin_step_sums.hpp"
#include "engine/integrator/galerkin_step_tangent.hpp"
#include "engine/integrator/sweep/node_iteration_build.hpp"
#include "engine/integrator/sweep/velocity_iteration_build.hpp"

namespace extremal {
template <class T, int D>
GalerkinStep<T, D>::GalerkinStep(Mechanics<T> mechanics, std::vector<Table<T>> tables, T step,
                                 SolverPolicy policy, std::vector<LagrangianTerm<T>> parts,
                                 const LagrangianEntries* entries)
    : mechanics_(std::move(mechanics)),
      parts_(std::move(parts)),
      tables_(std::move(tables)),
      h_(step),
      policy_(policy) {
    tolerance_ = toleranceOf<T>(policy);
    int size = 0, widest = 0;
    for (int k = 0; k < d(); ++k) {
        offset_.push_back(size);
        size += m(k);
        widest = std::max(widest, m(k));
    }
    isVectorised_ = std::is_same_v<T, double> && n() >= 16 && tables_.front().frequency != T(0);
    rows_ = isVectorised_ ? inWholeLanes(n()) : n();
    if (isVectorised_) sums_ = nodeSums();
    const auto padded = [&](const auto& column) {
        Flat all = Flat::Constant(rows(), column(n() - 1));
        all.head(n()) = column;
        return all;
    };
    for (const Table<T>& t : tables_) {
        const int own = t.unknowns(), height = isVectorised_ ? inWholeLanes(own) : own;
        Functions f;
        f.value = f.slope = Square::Zero(rows(), own);
        for (int a = 0; a < own; ++a) f.value.col(a) = padded(t.value.col(a));
        f.valueAt = f.slopeAt = Square::Zero(height, rows());
        f.valueAt.topRows(own) = f.value.transpose();
        f.kineticInverse = dense::inverse<T>(t.testDerivative.transpose() *
                                             detail::ofKineticEnergy(t).asDiagonal() * t.derivative / h_);
        functions_.push_back(std::move(f));
        continues_ = continues_ && t.extrapolation.size() > 0;
    }
    node_ = times_ = padded(tables_.front().node);
    weight_ = Flat::Zero(rows());
    scaleToStep();
    weightedLq_ = weightedLv_ = Flat::Zero(rows());
    tested_ = pulled_ = Square::Zero(d(), rows());
    right_ = next_ = dual_ = Square::Zero(d(), m(0));
    for (Flat* f : {&Y_, &previousY_, &R_, &delta_}) *f = Flat::Zero(size);
    for (Columns* c : {&nodeQ_, &nodeV_}) *c = Columns::Zero(rows(), d());
    gradient_ = Square::Zero(rows(), 2 * d());
    ownCoefficients_ = Square::Zero(m(0), d());
    ownForces_ = Square::Zero(n(), d());
    for (Vector* v : {&q0_, &p0_, &v0_, &a0_, &dq_, &dp_, &carryQ_, &carryP_, &lastQ_, &lastP_, &placeQ_,
                      &placeV_, &eta_, &rate_, &byQ_, &byV_})
        *v = Vector::Zero(d());
    jetGradient_ = Flat::Zero(2 * d());
    applied_ = Square::Zero(rows(), widest);
    if (parts_.empty() && tables_.size() == 1 && tables_.front().frequency == T(0)) {
        const Table<T>& own = tables_.front();
        const bool isAsked = policy_.method == SolverMethod::fixedPoint;
        if (mechanics_.isSeparable && (isAsked || areFewNodes(own.nodes(), own.unknowns())))
            fixedPointSolver_.template emplace<NodeIteration<T>>(mechanics_, own, h_, tolerance_);
        else if (VelocityIteration<T>::applies(mechanics_, own))
            fixedPointSolver_.template emplace<VelocityIteration<T>>(mechanics_, own, h_, tolerance_);
    }
    if (tables_.front().frequency == T(0)) defect_.emplace(mechanics_, tables_, parts_);
    motion_ = Flat::Zero(8 * d());
    impulse_.assign(static_cast<std::size_t>(d()), Accumulator(0));
    if (std::is_same_v<T, double> && D == Eigen::Dynamic && entries && parts_.empty() && !isVectorised_) {
        std::vector<int> unknowns;
        for (int k = 0; k < d(); ++k) unknowns.push_back(m(k));
        if (SparseJacobian sparse(*entries, n(), unknowns); sparse.isWorthwhile())
            sparse_ = std::move(sparse);
    }
    constexpr int few = 64;
    if (!sparse_ && (d() <= few || !hasFixedPoint())) roomForNewton();
}

/// Of many coordinates these matrices are made where they are first needed: a fixed point may do without.
template <class T, int D>
void GalerkinStep<T, D>::roomForNewton() {
    if (jacobian_.size() > 0) return;
    const Eigen::Index size = Y_.size();
    mass_ = Square::Zero(d(), d());
    jetHessian_ = Flat::Zero(4 * d() * d());
    hessians_ = Square::Zero(rows(), 4 * d() * d());
    isPresent_.assign(static_cast<std::size_t>(4 * d() * d()), false);
    jacobian_ = Square::Zero(size, size);
    lu_ = Eigen::PartialPivLU<Square>(size);
}

/// Slopes by time and weights by h.
template <class T, int D>
void GalerkinStep<T, D>::scaleToStep() {
    for (int i = 0; i < n(); ++i) weight_(i) = tables_.front().weight(i) * h_;
    for (std::size_t j = 0; j < functions_.size(); ++j) {
        const auto& derivative = tables_[j].derivative;
        Functions& f = functions_[j];
        for (int a = 0; a < derivative.cols(); ++a)
            for (int i = 0; i < rows(); ++i)
                f.slope(i, a) = f.slopeAt(a, i) = derivative(std::min(i, n() - 1), a) / h_;
    }
}

template <class T, int D>
void GalerkinStep<T, D>::setStep(const T& step) {
    assert(tables_.front().frequency == T(0));
    if (step == h_) return;
    kineticScale_ *= step / h_;
    h_ = step;
    scaleToStep();
    withFixedPoint([&](auto& solver) { solver.setStep(step); });
    restart();
}

template <class T, int D>
void GalerkinStep<T, D>::coefficients(T* Y) const {
    if (!isSolvedByFixedPoint_) {
        std::copy_n(Y_.data(), Y_.size(), Y);
        return;
    }
    withFixedPoint([&](const auto& solver) { solver.coefficients(ownCoefficients_, ownForces_); });
    std::copy_n(ownCoefficients_.data(), ownCoefficients_.size(), Y);
}

/// Starts from (q, p), and from what the last step could not add if this is where it ended.
template <class T, int D>
void GalerkinStep<T, D>::resume(const T* q, const T* p) {
    bool isNext = true;
    for (int k = 0; k < d(); ++k) {
        isNext = isNext && q[k] == lastQ_(k) && p[k] == lastP_(k);
        q0_(k) = q[k];
        p0_(k) = p[k];
    }
    if (isNext) return;
    carryQ_.setZero();
    carryP_.setZero();
}

/// Adds the increments to (q, p); the carries keep what is lost (core/algebra/exact_sum.hpp).
template <class T, int D>
void GalerkinStep<T, D>::add(T* q, T* p) {
    if (!isSolvedByFixedPoint_) {
        for (int k = 0; k < d(); ++k) {
            // Stiff forces nearly cancel in this sum.
            Accumulator impulse(0);
            for (int i = 0; i < n(); ++i) impulse += Accumulator(weight_(i)) * Accumulator(gradient_(i, k));
            dp_(k) = static_cast<T>(impulse);
            dq_(k) = Y_(offset(k) + m(k) - 1);
        }
        previousY_ = Y_;
    }
    for (int k = 0; k < d(); ++k) {
        q[k] = lastQ_(k) = addExactly(T(q0_(k)), T(dq_(k) + carryQ_(k)), carryQ_(k));
        p[k] = lastP_(k) = addExactly(T(p0_(k)), T(dp_(k) + carryP_(k)), carryP_(k));
    }
}

template <class T, int D>
StepReport GalerkinStep<T, D>::advance(const T& t, T* q, T* p, const std::stop_token& stop) {
    report_ = StepReport{};
    report_.step = static_cast<double>(h_);
    resume(q, p);
    report_.outcome = solve(t, stop);
    const bool isSolved = report_.outcome == Outcome::converged;
    hasPrevious_ = continues_ && isSolved && !isSolvedByFixedPoint_;
    if (isSolved) add(q, p);
    return report_;
}

template <class T, int D>
void GalerkinStep<T, D>::denseOutput(const T& tau, T* q, T* p) const {
    Square Y, forces = gradient_.leftCols(d());
    if (isSolvedByFixedPoint_) {
        Y.resize(m(0), d());
        withFixedPoint([&](const auto& solver) { solver.coefficients(Y, forces); });
    }
    std::vector<T> value, slope;
    for (int k = 0; k < d(); ++k) {
        const Table<T>& own = table(k);
        value.resize(static_cast<std::size_t>(own.space.size));
        slope.resize(value.size());
        own.space.evaluate(tau, value, slope);
        const Eigen::Map<const Flat> phi(value.data(), own.space.size);
        const Flat y = own.change.transpose() * phi;
        q[k] = q0_(k) + (isSolvedByFixedPoint_ ? Flat(Y.col(k)) : Flat(Y_.segment(offset(k), m(k)))).dot(y);
        p[k] = p0_(k);
    }
    // p(tau) = p_0 + h int_0^tau of what the rule takes L_q for, from its values at the nodes: at tau = 1 the
    // rule itself.
    const std::vector<T> share = weightsUpTo(tables_.front(), tau);
    for (int k = 0; k < d(); ++k)
        for (int i = 0; i < n(); ++i) p[k] += h_ * share[static_cast<std::size_t>(i)] * forces(i, k);
}

}  // namespace extremal
