// SPDX-License-Identifier: GPL-3.0-or-later
/// Implicit midpoint rule on Hamilton's equations, z_1 = z_0 + h X_H((z_0 + z_1)/2), solved for the midpoint
/// by Newton.
///
/// Written on the Hamiltonian side, independently of the Galerkin step, whose discretization (degree 1,
/// midpoint) it must equal to round-off.

#include <limits>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/gauss_tableau.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/phase/flow_jacobian.hpp"
#include "engine/step/coordinate_watch.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal::baselines {
namespace {

template <int D>
class ImplicitMidpoint final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;
    using Square = Eigen::MatrixXd;
    using BigVector = Eigen::VectorXd;

public:
    ImplicitMidpoint(const Mechanics<double>& mechanics, double step)
        : Base(mechanics, step), jacobian_(mechanics) {
        const int d = this->d();
        for (Vector* v : {&q_, &p_, &dq_, &dp_}) *v = Vector::Zero(d);
        r_ = change_ = BigVector::Zero(2 * d);
        system_ = Square::Zero(2 * d, 2 * d);
        lu_ = Eigen::PartialPivLU<Square>(2 * d);
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ImplicitMidpoint>(*this); }

private:
    void step(double t) override {
        const double half = this->h() / 2;
        const int d = this->d();
        q_ = this->q0_;
        p_ = this->p0_;
        CoordinateWatch watch;
        this->report_.outcome = solveByCorrections(
            CorrectionLimits{}, this->stop(), this->report_, [&](int iteration, double ratio) {
                this->flow(t + half, q_, p_, dq_, dp_);
                if (this->report_.outcome != Outcome::converged)
                    return Correction{.outcome = this->report_.outcome};
                if (iteration == 0 || ratio > 0.25) assemble(t + half, half);
                r_.head(d) = this->q0_ + half * dq_ - q_;
                r_.tail(d) = this->p0_ + half * dp_ - p_;
                change_ = lu_.solve(r_);
                ++this->report_.cost.linearSolves;
                q_ += change_.head(d);
                p_ += change_.tail(d);
                for (int k = 0; k < d; ++k) {
                    watch.add(change_(k), q_(k) - this->q0_(k), this->q0_(k));
                    watch.add(change_(d + k), p_(k) - this->p0_(k), this->p0_(k));
                }
                return Correction{change_.cwiseAbs().maxCoeff(),
                                  std::max(q_.cwiseAbs().maxCoeff(), p_.cwiseAbs().maxCoeff()),
                                  watch.isSettled()};
            });
        if (this->report_.outcome != Outcome::converged) return;
        this->flow(t + half, q_, p_, dq_, dp_);
        this->q1_ = this->q0_ + 2 * half * dq_;
        this->p1_ = this->p0_ + 2 * half * dp_;
    }
    /// M = (1 - h/2 f')^-1 (1 + h/2 f'), f' at the midpoint.
    bool tangent(double t, typename Base::Columns W) override {
        const double half = this->h() / 2;
        q_ = (this->q0_ + this->q1_) / 2;
        p_ = (this->p0_ + this->p1_) / 2;
        const Square* const jacobian = this->flowJacobian(t + half, q_, p_);
        if (!jacobian) return false;
        slope_.noalias() = half * jacobian->lazyProduct(W);
        system_.setIdentity();
        system_ -= half * *jacobian;
        lu_.compute(system_);
        slope_ += W;
        W = lu_.solve(slope_);
        return true;
    }
    /// I - h/2 DX_H at (q_, p_), factored; dq_ holds v(q_, p_).
    void assemble(double t, double half) {
        ++this->report_.cost.evaluations;
        system_.setIdentity();
        system_ -= half * jacobian_.evaluate(t, q_.data(), p_.data(), dq_.data());
        lu_.compute(system_);
    }

    Vector q_, p_, dq_, dp_;
    BigVector r_, change_;
    Square system_, slope_;
    FlowJacobian jacobian_;
    Eigen::PartialPivLU<Square> lu_;
};

}  // namespace

BaselineEntry implicit_midpoint() {
    BaselineEntry e;
    e.item = {"implicit-midpoint",
              "implicit midpoint",
              "The midpoint rule on Hamilton's equations by Newton: order 2, stable for every step.",
              {},
              Claims{2, true, true, {"momentum", "quadratic invariants"}},
              ""};
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.parts.set(BaselineTableau{[](const Settings&) { return gaussTableau(1); }});
    e.takes = flowProblems().with<Spins>();
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeFlowMethod<ImplicitMidpoint>(flowOf(system), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
