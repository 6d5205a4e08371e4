// SPDX-License-Identifier: GPL-3.0-or-later
/// RK4 projected onto the energy of the start: after each step z goes along grad H to H(z) = H(z_0).
///
///     z_1 = z~_1 + lambda grad H(z~_1),   H(z_1) = H(z_0),   z~_1 = RK4(z_0),
/// lambda by Newton's method. The energy is kept to round-off, and nothing else: neither symplectic nor
/// symmetric, and the angular momentum drifts. Source: Hairer, Lubich, Wanner 2006, IV.4.
#include <cmath>
#include <limits>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/classical_tangent.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal::baselines {
namespace {

template <int D>
class Projected final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;

public:
    Projected(const Mechanics<double>& mechanics, double step) : Base(mechanics, step) {
        for (Vector* v : {&q_, &p_, &dq_, &dp_, &sumQ_, &sumP_, &gradQ_, &gradP_})
            *v = Vector::Zero(this->d());
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Projected>(*this); }

    std::vector<MemoryPart> memoryParts() const override { return {{"energy", 1}}; }
    void begin(State& state) override {
        const auto& m = this->mechanics_;
        state.memory = {m.energy(m.model.get(), state.t, state.x.data(), state.x.data() + this->d())};
    }

private:
    void recall(State& state) override {
        if (state.memory.empty()) begin(state);
        energy_ = state.memory[0];
    }
    void step(double t) override {
        const double h = this->h();
        sumQ_.setZero();
        sumP_.setZero();
        double at = 0;
        for (const auto& [next, weight] : {std::pair{0.5, 1.0}, {0.5, 2.0}, {1.0, 2.0}, {0.0, 1.0}}) {
            q_ = this->q0_ + (at * h) * dq_;
            p_ = this->p0_ + (at * h) * dp_;
            this->flow(t + at * h, q_, p_, dq_, dp_);
            if (this->report_.outcome != Outcome::converged) return;
            sumQ_ += weight * dq_;
            sumP_ += weight * dp_;
            at = next;
        }
        q_ = this->q0_ + h / 6 * sumQ_;
        p_ = this->p0_ + h / 6 * sumP_;
        project(t + h);
    }
    /// From (q_, p_) to q1_, p1_.
    void project(double t) {
        constexpr int most = 20;
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        const auto& m = this->mechanics_;
        lambda_ = 0;
        this->flow(t, q_, p_, gradP_, gradQ_);
        if (this->report_.outcome != Outcome::converged) return;
        gradQ_ *= -1;
        const double square = gradQ_.squaredNorm() + gradP_.squaredNorm();
        double last = std::numeric_limits<double>::infinity();
        this->q1_ = q_;
        this->p1_ = p_;
        for (int i = 0; i < most && square > 0; ++i) {
            const double off = m.energy(m.model.get(), t, this->q1_.data(), this->p1_.data()) - energy_;
            ++this->report_.cost.evaluations;
            if (!std::isfinite(off)) {
                this->report_.outcome = Outcome::notFinite;
                return;
            }
            if (std::abs(off) <= epsilon * std::abs(energy_) || !(std::abs(off) < last)) return;
            last = std::abs(off);
            lambda_ -= off / square;
            this->q1_ = q_ + lambda_ * gradQ_;
            this->p1_ = p_ + lambda_ * gradP_;
        }
    }

    /// The tangent map of the step that keeps the energy of its start: with g = grad H at z~_1,
    ///     dz_1 = (1 + lambda H'') dz~_1 + g dlambda,   grad H(z_1) . dz_1 = grad H(z_0) . dz_0.
    bool tangent(double t, typename Base::Columns W) override {
        const double h = this->h();
        placeQ_ = q_;
        placeP_ = p_;
        gradient(t, this->q0_, this->p0_, atEnd_);
        kept_.noalias() = atEnd_.transpose().lazyProduct(W);
        const bool isKnown = tangent_.apply(h, W, [&](double ahead) {
            q_ = this->q0_ + ahead * dq_;
            p_ = this->p0_ + ahead * dp_;
            this->flow(t + ahead, q_, p_, dq_, dp_);
            return this->flowJacobian(t + ahead, q_, p_);
        });
        q_ = placeQ_;
        p_ = placeP_;
        const Eigen::MatrixXd* const jacobian = this->flowJacobian(t + h, q_, p_);
        if (!isKnown || !jacobian) return false;
        gradient(t + h, q_, p_, atPlace_);
        gradient(t + h, this->q1_, this->p1_, atEnd_);
        const int d = this->d();
        change_ = W;
        W.topRows(d).noalias() -= lambda_ * jacobian->bottomRows(d).lazyProduct(change_);
        W.bottomRows(d).noalias() += lambda_ * jacobian->topRows(d).lazyProduct(change_);
        kept_.noalias() -= atEnd_.transpose().lazyProduct(W);
        kept_ /= atEnd_.dot(atPlace_);
        W.noalias() += atPlace_.lazyProduct(kept_);
        return true;
    }
    /// grad H = (-pdot, qdot).
    void gradient(double t, const Vector& q, const Vector& p, Eigen::VectorXd& g) {
        this->flow(t, q, p, dq_, dp_);
        g.resize(2 * this->d());
        g << -dp_, dq_;
    }

    double energy_ = 0, lambda_ = 0;
    Vector q_, p_, dq_, dp_, sumQ_, sumP_, gradQ_, gradP_;  ///< after a step (q, p) is z~_1
    ClassicalTangent tangent_;
    Vector placeQ_, placeP_;
    Eigen::VectorXd atPlace_, atEnd_;  ///< gradients of H
    Eigen::RowVectorXd kept_;
    Eigen::MatrixXd change_;
};

}  // namespace

BaselineEntry projected() {
    BaselineEntry e;
    e.item = {"projected",
              "projected RK4",
              "RK4 followed by a projection onto the energy of the start: keeps the energy, and no other "
              "structure.",
              {},
              Claims{4, false, false, {"energy"}, false},
              "a Lagrangian without explicit time"};
    e.parts.set(SystemCondition{[](const System& system) { return !system.mechanics().isTimeDependent; }});
    e.parts.set(OscillatorLimit(2.8284271247461903));
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeFlowMethod<Projected>(system.mechanics(), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
