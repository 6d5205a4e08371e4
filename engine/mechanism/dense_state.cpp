// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "engine/core/algebra/dense.hpp"
#include "engine/mechanism/state_equations.hpp"
#include "engine/solve/small_lu.hpp"

namespace extremal {
namespace {

class DenseState final : public StateEquations {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

public:
    DenseState(const Mechanics<double>& mechanics, const Conditions& conditions,
               const std::optional<Force>& force)
        : mechanics_(mechanics),
          conditions_(conditions),
          force_(force),
          d_(mechanics.dimension),
          n_(conditions.count()),
          lu_(d_ + n_) {
        hessian_ = Rows::Zero(2 * d_, 2 * d_);
        byPlace_ = factorisedByPlace_ = Rows::Zero(n_, d_);
        factorisedMass_ = Rows::Zero(d_, d_);
        gradient_ = Vector::Zero(2 * d_);
        forces_ = Vector::Zero(d_);
        value_ = byTime_ = Vector::Zero(n_);
    }
    std::unique_ptr<StateEquations> clone() const override { return std::make_unique<DenseState>(*this); }

    void evaluate(double t, const double* q, const double* v) override {
        double value = 0;
        mechanics_.jet(mechanics_.model.get(), t, q, v, &value, gradient_.data(), hessian_.data());
        forces_.setZero();
        if (force_) force_->value(force_->model.get(), t, q, v, forces_.data());
        evaluateConstraint(t, q);
    }
    void evaluateConstraint(double t, const double* q) override {
        conditions_.evaluate(t, q, value_, byPlace_, byTime_);
    }
    void rates(double t, const double* q, const double* v, Vector& to) override {
        conditions_.rates(t, q, v, to);
    }
    void reaction(const Vector& lambda, Vector& to) const override {
        to.noalias() = byPlace_.transpose() * lambda;
    }
    void rate(const double* v, Vector& to) const override {
        to.noalias() = byPlace_ * Eigen::Map<const Vector>(v, d_);
    }
    void massRate(const double* v, Vector& to) const override {
        to.noalias() = hessian_.bottomLeftCorner(d_, d_) * Eigen::Map<const Vector>(v, d_);
    }
    double mass(int k) const override { return hessian_(d_ + k, d_ + k); }

    /// Corrections of a velocity at one place have one matrix, where L is quadratic in it.
    bool factorise() override {
        const auto mass = hessian_.bottomRightCorner(d_, d_);
        if (isFactorised_ && mass == factorisedMass_ && byPlace_ == factorisedByPlace_) return true;
        factorisedMass_ = mass;
        factorisedByPlace_ = byPlace_;
        for (int j = 0; j < d_ + n_; ++j) {
            double* const column = lu_.column(j);
            for (int i = 0; i < d_; ++i) column[i] = j < d_ ? hessian_(d_ + i, d_ + j) : -byPlace_(j - d_, i);
            for (int k = 0; k < n_; ++k) column[d_ + k] = j < d_ ? byPlace_(k, j) : 0;
        }
        return isFactorised_ = lu_.factorise() == Outcome::converged;
    }
    void solve(Vector& x) const override { lu_.solve(x.data()); }

    Vector ownParts() const override {
        const Eigen::MatrixXd mass = hessian_.bottomRightCorner(d_, d_);
        const Eigen::MatrixXd back = dense::solve<double>(mass, Eigen::MatrixXd(byPlace_.transpose()));
        Eigen::MatrixXd gram = byPlace_ * back;
        const Vector size = gram.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
        gram = Eigen::MatrixXd(size.asDiagonal() * gram * size.asDiagonal());
        Vector own(n_);
        for (int k = 0; k < n_; ++k) {
            // Cholesky without pivoting, so that it is the later constraint that is named.
            for (int j = 0; j < k; ++j)
                if (gram(j, j) > 0)
                    gram.row(k).tail(n_ - j) -= gram(k, j) / gram(j, j) * gram.row(j).tail(n_ - j);
            own(k) = std::sqrt(std::max(0.0, gram(k, k)));
        }
        return own;
    }

private:
    Mechanics<double> mechanics_;
    Conditions conditions_;
    std::optional<Force> force_;
    int d_, n_;
    SmallLu<double> lu_;
    Rows hessian_, byPlace_;
    Rows factorisedMass_, factorisedByPlace_;  ///< what lu_ has the factors of
    bool isFactorised_ = false;
};

}  // namespace

std::unique_ptr<StateEquations> denseState(const Mechanics<double>& mechanics, const Conditions& conditions,
                                           const std::optional<Force>& force) {
    return std::make_unique<DenseState>(mechanics, conditions, force);
}

}  // namespace extremal
