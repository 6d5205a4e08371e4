/// What the baselines of rigid bodies share: the step, the state, and dense output.
///
/// They see a body through its inertia and the force of its potential (model/body.hpp). A step moves the
/// attitude q, the momentum in the body and, on SE(3), position and linear momentum; what follows from them
/// is filled in afterwards. Dense output is the cubic Hermite interpolant of the state, its attitude brought
/// back to length 1.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <utility>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/group/so3.hpp"

namespace extremal {

/// The key of baselines on quaternions.
inline FieldInfo projectionField() {
    return flagField("projection", true, "Bring the quaternion back to length 1 after each step.");
}

class BodyMethod : public Integrator {
public:
    using Vector = so3::Vector<double>;
    using Quaternion = so3::Quaternion<double>;

    /// Linear momentum and position stay zero on SO(3).
    struct Motion {
        Quaternion q{1, 0, 0, 0};
        Vector momentum = Vector::Zero();  ///< in the body
        Vector position = Vector::Zero(), linear = Vector::Zero();
    };

    BodyMethod(const System& system, double step)
        : body_(system.body()),
          h_(step),
          rate_(system.rate),
          size_(static_cast<std::size_t>(body_.stateSize())) {
        for (auto* v : {&before_, &after_, &slopeBefore_, &slopeAfter_}) v->assign(size_, 0);
    }

    double stepSize() const final { return h_; }
    void setStep(double h) final { h_ = h; }

    StepReport advance(State& state, double until) final {
        report_ = StepReport{};
        report_.step = h_;
        std::copy(state.x.begin(), state.x.end(), before_.begin());
        std::copy(state.x.begin(), state.x.end(), after_.begin());
        Motion m = read(before_.data());
        step(m, h_);
        write(m, after_.data());
        if (turnsMomentum()) keepSpaceMomentum(m);
        if (report_.outcome == Outcome::converged &&
            !std::all_of(after_.begin(), after_.end(), [](double v) { return std::isfinite(v); }))
            report_.outcome = Outcome::notFinite;
        if (report_.outcome != Outcome::converged) return report_;
        std::copy(after_.begin(), after_.end(), state.x.begin());
        startTime_ = state.t;
        state.t = until;
        ++state.node;
        return report_;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        rate_(startTime_, before_.data(), slopeBefore_.data());
        rate_(startTime_ + h_, after_.data(), slopeAfter_.data());
        const double h = h_;
        const double a = (1 + 2 * tau) * (1 - tau) * (1 - tau), b = tau * (1 - tau) * (1 - tau) * h;
        const double c = tau * tau * (3 - 2 * tau), e = tau * tau * (tau - 1) * h;
        for (std::size_t i = 0; i < size_; ++i)
            x[i] = a * before_[i] + b * slopeBefore_[i] + c * after_[i] + e * slopeAfter_[i];
        const double length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]);
        for (std::size_t i = 0; i < 4; ++i) x[i] /= length;
    }

protected:
    /// Moves m by h and adds to report_.
    virtual void step(Motion& m, double h) = 0;
    /// True if a step only rotates the momentum with the body: the momentum in space is then left unchanged,
    /// and that in body axes is computed from it.
    virtual bool turnsMomentum() const { return false; }

    Motion read(const double* x) const {
        Motion m;
        m.q << x[0], x[1], x[2], x[3];
        m.momentum << x[4], x[5], x[6];
        if (size_ > 10) {
            m.position << x[10], x[11], x[12];
            m.linear << x[13], x[14], x[15];
        }
        return m;
    }
    void write(const Motion& m, double* x) const {
        const Vector pi = so3::matrix(so3::normalised(m.q)) * m.momentum;
        for (int i = 0; i < 4; ++i) x[i] = m.q(i);
        for (int i = 0; i < 3; ++i) x[4 + i] = m.momentum(i);
        for (int i = 0; i < 3; ++i) x[7 + i] = pi(i);
        if (size_ <= 10) return;
        for (int i = 0; i < 3; ++i) x[10 + i] = m.position(i);
        for (int i = 0; i < 3; ++i) x[13 + i] = m.linear(i);
    }
    /// Torque and force of the potential, in body axes.
    void forces(const Motion& m, Vector& torque, Vector& force) {
        torque.setZero();
        force.setZero();
        if (body_.isFree()) return;
        ++report_.cost.evaluations;
        const so3::Matrix<double> R = so3::matrix(so3::normalised(m.q));
        std::array<double, 6> f{};
        body_.potential(body_.model.get(), R.data(), size_ > 10 ? m.position.data() : nullptr, nullptr,
                        f.data(), nullptr);
        torque << f[0], f[1], f[2];
        force << f[3], f[4], f[5];
    }
    Vector omega(const Vector& momentum) const {
        return {momentum(0) / body_.inertia[0], momentum(1) / body_.inertia[1],
                momentum(2) / body_.inertia[2]};
    }

    BodyMechanics<double> body_;
    double h_;
    StepReport report_;

private:
    void keepSpaceMomentum(const Motion& m) {
        const Vector pi(before_[7], before_[8], before_[9]), body = so3::matrix(m.q).transpose() * pi;
        for (std::size_t i = 0; i < 3; ++i) {
            after_[4 + i] = body(static_cast<int>(i));
            after_[7 + i] = before_[7 + i];
        }
    }

    std::function<bool(double, const double*, double*)> rate_;
    std::size_t size_;
    std::vector<double> before_, after_;
    mutable std::vector<double> slopeBefore_, slopeAfter_;
    double startTime_ = 0;
};

}  // namespace extremal
