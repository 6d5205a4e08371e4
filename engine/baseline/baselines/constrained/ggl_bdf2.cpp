// SPDX-License-Identifier: GPL-3.0-or-later
/// The stabilised equations of Gear, Gupta and Leimkuhler (index 2) by the BDF of two steps, as codes for
/// differential-algebraic equations solve them:
///     q' = v + g_q^T mu,   d/dt L_v = L_q + F + g_q^T lambda,   g = 0,   g_q v + g_t = 0,
///     x' at the end of a step: (3/2 x_1 - 2 x_0 + 1/2 x_-1) / h;   in the first step (x_1 - x_0) / h.
/// Places and velocities are on the constraint to round-off, and energy is lost: the formula damps. Newton's
/// method on (q, v, lambda, mu) together. Source: Gear, Gupta, Leimkuhler 1985.

#include <cmath>
#include <limits>
#include <optional>

#include "engine/baseline/constrained_method.hpp"
#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"

namespace extremal::baselines {
namespace {

class GglBdf2 final : public ConstrainedMethod {
    using Rows = Mechanism::Rows;
    using Matrix = Eigen::MatrixXd;

public:
    GglBdf2(const System& system, double step) : ConstrainedMethod(system, step) {
        const int size = 2 * (d() + n());
        before_ = Vector::Zero(2 * d());
        velocity_ = forces_ = Vector::Zero(d());
        gradient_ = Vector::Zero(2 * d());
        lambda_ = mu_ = value_ = byTime_ = Vector::Zero(n());
        hessian_ = Rows::Zero(2 * d(), 2 * d());
        byState_ = Rows::Zero(d(), 2 * d());
        byPlace_ = Rows::Zero(n(), d());
        curvature_ = Rows::Zero(d(), d());
        matrix_ = Matrix::Zero(size, size);
        residual_ = Vector::Zero(size);
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<GglBdf2>(*this); }
    std::vector<MemoryPart> memoryParts() const override {
        return {{"before", static_cast<std::size_t>(2 * d())}};
    }
    /// The state itself where there is none before.
    void begin(State& state) override {
        state.memory.assign(state.x.begin(), state.x.begin() + 2 * d());
        lambda_.setZero();
        mu_.setZero();
    }
    bool checkpoint(Archive& archive) override {
        archive(lambda_, mu_);
        return true;
    }

private:
    void recall(State& state) override {
        if (state.memory.empty()) begin(state);
        before_ = Eigen::Map<const Vector>(state.memory.data(), 2 * d());
        isFirst_ = before_ == Eigen::Map<const Vector>(state.x.data(), 2 * d());
    }
    void remember(State& state) override {
        Eigen::Map<Vector>(state.memory.data(), d()) = q0_;
        Eigen::Map<Vector>(state.memory.data() + d(), d()) = p0_;
    }

    Outcome step() override {
        const auto& L = mechanism_.mechanics();
        if (!L.velocity(L.model.get(), start(), q0_.data(), p0_.data(), velocity_.data()))
            return Outcome::singular;
        q1_ = q0_ + h() * velocity_;
        const CorrectionLimits limits{.last = 4 * CorrectionLimits::epsilon, .roundOff = 1e-11};
        const Outcome solved = solveByCorrections(limits, stop(), report_, [&](int, double) {
            assemble();
            residual_ = matrix_.partialPivLu().solve(residual_).eval();
            ++report_.cost.linearSolves;
            if (!residual_.allFinite()) return Correction{.outcome = Outcome::notFinite};
            q1_ -= residual_.head(d());
            velocity_ -= residual_.segment(d(), d());
            lambda_ -= residual_.segment(2 * d(), n());
            mu_ -= residual_.tail(n());
            return Correction{residual_.head(2 * d()).cwiseAbs().maxCoeff(),
                              std::max(q1_.cwiseAbs().maxCoeff(), velocity_.cwiseAbs().maxCoeff())};
        });
        if (solved != Outcome::converged) return solved;
        L.gradient(L.model.get(), end(), q1_.data(), velocity_.data(), gradient_.data());
        p1_ = gradient_.tail(d());
        return Outcome::converged;
    }

    /// The equations and their derivatives by (q, v, lambda, mu).
    void assemble() {
        const auto& L = mechanism_.mechanics();
        const int D = d(), N = n();
        double value = 0;
        L.jet(L.model.get(), end(), q1_.data(), velocity_.data(), &value, gradient_.data(), hessian_.data());
        ++report_.cost.evaluations;
        forces_.setZero();
        byState_.setZero();
        if (const auto& F = mechanism_.force())
            F->first(F->model.get(), end(), q1_.data(), velocity_.data(), forces_.data(), byState_.data());
        mechanism_.conditions(end(), q1_.data(), value_, byPlace_, byTime_);
        const double now = isFirst_ ? 1 : 1.5, then = isFirst_ ? -1 : -2, before = isFirst_ ? 0 : 0.5;
        residual_.head(D) = (now * q1_ + then * q0_ + before * before_.head(D)) / h() - velocity_ -
                            byPlace_.transpose() * mu_;
        residual_.segment(D, D) = (now * gradient_.tail(D) + then * p0_ + before * before_.tail(D)) / h() -
                                  gradient_.head(D) - forces_ - byPlace_.transpose() * lambda_;
        residual_.segment(2 * D, N) = value_;
        residual_.tail(N) = byPlace_ * velocity_ + byTime_;
        matrix_.setZero();
        matrix_.topLeftCorner(D, D) = now / h() * Matrix::Identity(D, D) - curvature(mu_);
        matrix_.block(0, D, D, D) = -Matrix::Identity(D, D);
        matrix_.topRightCorner(D, N) = -byPlace_.transpose();
        matrix_.block(D, 0, D, D) = now / h() * hessian_.bottomLeftCorner(D, D) -
                                    hessian_.topLeftCorner(D, D) - byState_.leftCols(D) - curvature(lambda_);
        matrix_.block(D, D, D, D) = now / h() * hessian_.bottomRightCorner(D, D) -
                                    hessian_.topRightCorner(D, D) - byState_.rightCols(D);
        matrix_.block(D, 2 * D, D, N) = -byPlace_.transpose();
        matrix_.block(2 * D, 0, N, D) = byPlace_;
        for (int k = 0; k < N; ++k)
            matrix_.block(2 * D + N + k, 0, 1, D) = (curvature(Vector::Unit(N, k)) * velocity_).transpose();
        matrix_.block(2 * D + N, D, N, D) = byPlace_;
    }
    const Rows& curvature(const Vector& weights) {
        curvature_.setZero();
        const Constraint& g = *mechanism_.constraint();
        g.addCurvature(g.model.get(), end(), q1_.data(), weights.data(), curvature_.data());
        return curvature_;
    }

    bool isFirst_ = true;
    Vector before_, velocity_, forces_, gradient_, lambda_, mu_, value_, byTime_, residual_;
    Rows hessian_, byState_, byPlace_, curvature_;
    Matrix matrix_;
};

}  // namespace

BaselineEntry ggl_bdf2() {
    BaselineEntry e;
    e.item = {"ggl-bdf2",
              "GGL by BDF2",
              "Stabilised equations of index 2 by the backward differentiation formula of two steps, as "
              "differential-algebraic codes do: on the constraint; energy is lost.",
              {},
              Claims{2, false, false, {}, false},
              "constraints"};
    e.takes = constrainedProblems();
    e.parts.set(needsConstraints());
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<GglBdf2>(system, options.step);
    };
    return e;
}

}  // namespace extremal::baselines
