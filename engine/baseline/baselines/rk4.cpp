// SPDX-License-Identifier: GPL-3.0-or-later
/// The classical Runge-Kutta method of order 4 on (q, p): accurate over short times, not symplectic.
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/classical_table.hpp"
#include "engine/baseline/classical_tangent.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/mechanism/driven_flow.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/step/flow_method.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal::baselines {
namespace {

using classical::node, classical::weight;

template <int D>
class Rk4 final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;

public:
    Rk4(const Mechanics<double>& mechanics, double step) : Base(mechanics, step) {
        for (Vector* v : {&q_, &p_, &dq_, &dp_, &sumQ_, &sumP_}) *v = Vector::Zero(this->d());
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Rk4>(*this); }

    /// h sum b (p.q' - H) over the stages: the method has no generating function, this is the nearest to one.
    std::span<const Quantity> quantities() const override {
        static const Quantity action{"action", "", "S", ""};
        return {&action, 1};
    }
    void measure(const State&, double* values) const override {
        const auto& m = this->mechanics_;
        Vector q = this->q0_, p = this->p0_, dq = q, dp = p;
        values[0] = 0;
        for (std::size_t stage = 0; stage < classical::stages; ++stage) {
            if (stage > 0) {
                q = this->q0_ + node[stage] * this->h() * dq;
                p = this->p0_ + node[stage] * this->h() * dp;
            }
            const double t = this->startTime_ + node[stage] * this->h();
            m.flow(m.model.get(), t, q.data(), p.data(), dq.data(), dp.data());
            values[0] +=
                this->h() * weight[stage] * (p.dot(dq) - m.energy(m.model.get(), t, q.data(), p.data()));
        }
    }

private:
    void step(double t) override {
        const double h = this->h();
        q_ = this->q0_;
        p_ = this->p0_;
        sumQ_.setZero();
        sumP_.setZero();
        for (std::size_t stage = 0; stage < classical::stages; ++stage) {
            if (stage > 0) {
                q_ = this->q0_ + node[stage] * h * dq_;
                p_ = this->p0_ + node[stage] * h * dp_;
            }
            this->flow(t + node[stage] * h, q_, p_, dq_, dp_);
            sumQ_ += weight[stage] * dq_;
            sumP_ += weight[stage] * dp_;
        }
        this->q1_ = this->q0_ + h * sumQ_;
        this->p1_ = this->p0_ + h * sumP_;
    }
    bool tangent(double t, typename Base::Columns W) override {
        return tangent_.apply(this->h(), W, [&](double ahead) {
            q_ = this->q0_ + ahead * dq_;
            p_ = this->p0_ + ahead * dp_;
            this->flow(t + ahead, q_, p_, dq_, dp_);
            return this->flowJacobian(t + ahead, q_, p_);
        });
    }
    Vector q_, p_, dq_, dp_, sumQ_, sumP_;
    ClassicalTangent tangent_;
};

std::shared_ptr<const Tableau> rk4Tableau(const Settings&) {
    Tableau::Matrix A = Tableau::Matrix::Zero(classical::stages, classical::stages);
    Tableau::Vector b(classical::stages);
    for (std::size_t i = 0; i < classical::stages; ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        b(row) = Quad(classical::weightSixths[i]) / 6;
        if (i > 0) A(row, row - 1) = Quad(classical::nodeHalves[i]) / 2;
    }
    return std::make_shared<const Tableau>(plainTableau(A, b));
}

}  // namespace

BaselineEntry rk4() {
    BaselineEntry e;
    e.item = {"rk4",
              "RK4",
              "Classical Runge-Kutta of order 4: explicit, not symplectic, energy drifts.",
              {},
              Claims{4, false, false, {}},
              ""};
    e.parts.set(OscillatorLimit(2.8284271247461903));  // |R(iz)| <= 1 up to 2 sqrt 2
    e.parts.set(BaselineTableau{rk4Tableau});
    e.takes = drivenProblems().with<Spins, LieGroup, Spheres>();
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeFlowMethod<Rk4>(drivenMechanics(system), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
