// SPDX-License-Identifier: GPL-3.0-or-later
/// What the baselines of mechanical systems share: Hamilton's vector field, counted, the state, and dense
/// output.
///
/// Baselines see a system through (qdot, pdot) = (dH/dp, -dH/dq) at (t, q, p), or, where it is separable,
/// through its force and masses. D: dimension at compile time or Eigen::Dynamic. Dense output is
/// the cubic Hermite interpolant of x and xdot at both ends: order 4 at best, as usual for these methods.
#pragma once

#include <Eigen/Core>

#include <bit>
#include <cstdint>
#include <optional>
#include <utility>

#include "engine/core/dimension.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/mechanism/driven_flow.hpp"
#include "engine/model/group/group_flow.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/phase/flow_jacobian.hpp"

namespace extremal {

template <int D>
class FlowMethod : public Integrator {
public:
    using Vector = Eigen::Matrix<double, D, 1>;
    using View = Eigen::Map<Vector>;

    FlowMethod(Mechanics<double> mechanics, double step) : mechanics_(std::move(mechanics)), h_(step) {
        for (Vector* v : {&q0_, &p0_, &q1_, &p1_}) *v = Vector::Zero(d());
    }

    void denseOutput(double tau, std::span<double> x) const override {
        const double h = endTime_ - startTime_;
        Vector dq0 = q0_, dp0 = p0_, dq1 = q1_, dp1 = p1_;
        call(startTime_, q0_, p0_, dq0, dp0);
        call(endTime_, q1_, p1_, dq1, dp1);
        const double a = (1 + 2 * tau) * (1 - tau) * (1 - tau), b = tau * (1 - tau) * (1 - tau) * h;
        const double c = tau * tau * (3 - 2 * tau), e = tau * tau * (tau - 1) * h;
        double *const q = x.data(), *const p = q + d();
        for (int k = 0; k < d(); ++k) {
            q[k] = a * q0_(k) + b * dq0(k) + c * q1_(k) + e * dq1(k);
            p[k] = a * p0_(k) + b * dp0(k) + c * p1_(k) + e * dp1(k);
        }
    }

    double stepSize() const final { return h_; }
    void setStep(double h) final { h_ = h; }

    std::size_t tangentSize() const override {
        const bool isVaried = !isDriven(mechanics_) && !isGroupFlow(mechanics_);
        return isVaried ? static_cast<std::size_t>(2 * d()) : 0;
    }
    std::string tangentProblem() const override {
        return isDriven(mechanics_) ? "forces and constraints are not varied in its flow"
                                    : "it leaves the group";
    }
    bool applyTangent(std::span<double> W) final {
        return tangentSize() > 0 &&
               tangent(startTime_,
                       Columns(W.data(), 2 * d(), static_cast<Eigen::Index>(W.size()) / (2 * d())));
    }

    StepReport advance(State& state, double until) final {
        startTime_ = state.t;
        recall(state);
        View q(state.x.data(), d()), p(state.x.data() + d(), d());
        q0_ = q;
        p0_ = p;
        report_ = StepReport{};
        report_.step = h_;
        endTime_ = until;
        const bool isMoved = stepInPlace(state.t, q.data(), p.data());
        if (isMoved) {
            q1_ = q;
            p1_ = p;
        } else {
            q1_ = q0_;
            p1_ = p0_;
            step(state.t);
        }
        if (report_.outcome == Outcome::converged && !(isFinite(q1_) && isFinite(p1_)))
            report_.outcome = Outcome::notFinite;
        const bool isWell = report_.outcome == Outcome::converged;
        if (isMoved != isWell) {
            q = isWell ? q1_ : q0_;
            p = isWell ? p1_ : p0_;
        }
        if (!isWell) return report_;
        ++state.node;
        state.t = endTime_;
        return report_;
    }

protected:
    int d() const { return mechanics_.dimension; }
    double h() const { return h_; }

    /// Takes what the scheme remembers from the state, before a step; most remember nothing.
    virtual void recall(State&) {}

    /// Moves q and p of the state by one step, where a method can without room of its own, and fills report_:
    /// the next step then waits for fewer copies. False: step() is to be called.
    virtual bool stepInPlace(double /*t*/, double* /*q*/, double* /*p*/) { return false; }

    /// Moves q1_, p1_ (which start at the present state) by one step, and fills report_.
    virtual void step(double t) = 0;

    /// W <- M W, columns (dq, dp), of the step that went from q0_, p0_ at time t to q1_, p1_.
    using Columns = Eigen::Map<Eigen::MatrixXd>;
    virtual bool tangent(double t, Columns W) = 0;

    /// The Jacobian of Hamilton's vector field; null where the Legendre transform fails.
    const Eigen::MatrixXd* flowJacobian(double t, const Vector& q, const Vector& p) {
        if (!jacobian_) {
            jacobian_.emplace(mechanics_);
            velocity_ = Vector::Zero(d());
        }
        if (mechanics_.velocity &&
            !mechanics_.velocity(mechanics_.model.get(), t, q.data(), p.data(), velocity_.data()))
            return nullptr;
        return &jacobian_->evaluate(t, q.data(), p.data(), velocity_.data());
    }

    /// Hamilton's vector field; sets the outcome where the Legendre transform fails.
    void flow(double t, const Vector& q, const Vector& p, Vector& dq, Vector& dp) {
        ++report_.cost.evaluations;
        if (!call(t, q, p, dq, dp)) report_.outcome = Outcome::singular;
    }

    /// By the exponents alone, which a compiler can look at side by side.
    static bool isFinite(const Vector& x) {
        constexpr std::uint64_t exponent = 0x7ff0000000000000, carry = 0x0010000000000000;
        std::uint64_t any = 0;
        for (const double each : x) any |= (std::bit_cast<std::uint64_t>(each) & exponent) + carry;
        return any >> 63 == 0;
    }

    Mechanics<double> mechanics_;
    double h_;
    Vector q0_, p0_, q1_, p1_;
    double startTime_ = 0, endTime_ = 0;
    StepReport report_;

private:
    std::optional<FlowJacobian> jacobian_;  ///< made where a tangent map is asked for
    Vector velocity_;

    bool call(double t, const Vector& q, const Vector& p, Vector& dq, Vector& dp) const {
        return mechanics_.flow(mechanics_.model.get(), t, q.data(), p.data(), dq.data(), dp.data());
    }
};

/// Makes Method<D> for the system's dimension.
template <template <int> class Method, class... Arguments>
std::unique_ptr<Integrator> makeFlowMethod(const Mechanics<double>& mechanics,
                                           const Arguments&... arguments) {
    return withDimension(mechanics.dimension, [&](auto d) -> std::unique_ptr<Integrator> {
        return std::make_unique<Method<decltype(d)::value>>(mechanics, arguments...);
    });
}

}  // namespace extremal
