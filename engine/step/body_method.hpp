// SPDX-License-Identifier: GPL-3.0-or-later
/// What methods of rigid bodies share that move attitude and momentum by themselves: the step, the state, and
/// dense output.
///
/// They see a body through its inertia and the force of its potential (model/body/body.hpp). A step moves the
/// attitude q, the momentum in the body and, on SE(3), position and linear momentum; what follows from them
/// is filled in afterwards. Dense output is the cubic Hermite interpolant of the state, its attitude brought
/// back to length 1. Steps are written once, generic in the number: over dual numbers a step is its own
/// tangent map.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "engine/group/dual_scalar.hpp"
#include "engine/group/so3.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// What a step moves. Linear momentum and position stay zero on SO(3).
template <class T>
struct BodyMotion {
    so3::Quaternion<T> q{T(1), T(0), T(0), T(0)};
    so3::Vector<T> momentum = so3::Vector<T>::Zero();  ///< in the body
    so3::Vector<T> position = so3::Vector<T>::Zero(), linear = so3::Vector<T>::Zero();
};

/// Use BodyMethodOf.
class BodyMethod : public Integrator {
public:
    /// A number, and its derivative along a variation.
    using Varied = Dual<double, 1>;

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
        BodyMotion<double> m = read(before_.data());
        step(m, h_);
        if (turnsMomentum()) m.momentum = turnedBack(m.q, Vector(before_[7], before_[8], before_[9]));
        write(m, after_.data());
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

    /// Left trivialised: (zeta, dPi) on SO(3), (zeta, v, dPi, dp) with v and dp in body axes on SE(3). The
    /// length of a quaternion that is not brought back to 1 has no part in the motion, and is not varied.
    std::size_t tangentSize() const final { return 2 * static_cast<std::size_t>(body_.dimension); }
    bool applyTangent(std::span<double> W) final {
        const StepReport kept = report_;
        bool isKnown = true;
        for (std::size_t at = 0; at < W.size(); at += tangentSize()) isKnown = vary(W.data() + at) && isKnown;
        report_ = kept;
        return isKnown;
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
    using Vector = so3::Vector<double>;
    using VariedVector = so3::Vector<Varied>;

    /// Moves m by h and adds to report_.
    virtual void step(BodyMotion<double>& m, double h) = 0;
    virtual void step(BodyMotion<Varied>& m, double h) = 0;
    /// True if a step only rotates the momentum with the body: the momentum in space is then left unchanged,
    /// and that in body axes is computed from it.
    virtual bool turnsMomentum() const { return false; }

    /// Torque and force of the potential, in body axes. `isUnit`: q has length 1 but for round-off.
    void forces(const BodyMotion<double>& m, Vector& torque, Vector& force, bool isUnit = false) {
        torque.setZero();
        force.setZero();
        if (body_.isFree()) return;
        ++report_.cost.evaluations;
        std::array<double, 6> f{};
        callPotential(isUnit ? m.q : so3::normalised(m.q), m.position, f.data(), nullptr);
        torque << f[0], f[1], f[2];
        force << f[3], f[4], f[5];
    }
    void forces(const BodyMotion<Varied>& m, VariedVector& torque, VariedVector& force) {
        torque.setZero();
        force.setZero();
        if (body_.isFree()) return;
        const auto n = static_cast<std::size_t>(body_.dimension);
        const so3::Quaternion<double> q = m.q.unaryExpr([](const Varied& a) { return a.value; });
        std::array<double, 6> f{}, zeta{};
        std::array<double, 36> slope{};
        callPotential(so3::normalised(q), values(m.position), f.data(), slope.data());
        const Vector turn = twist(m.q),
                     way = so3::matrix(so3::normalised(q)).transpose() * slopes(m.position);
        for (int i = 0; i < 3; ++i) {
            zeta[static_cast<std::size_t>(i)] = turn(i);
            zeta[static_cast<std::size_t>(3 + i)] = way(i);
        }
        for (std::size_t i = 0; i < n; ++i) {
            Varied each(f[i]);
            for (std::size_t j = 0; j < n; ++j) each.g[0] += slope[j * n + i] * zeta[j];
            (i < 3 ? torque : force)(static_cast<int>(i % 3)) = each;
        }
    }
    template <class T>
    so3::Vector<T> omega(const so3::Vector<T>& momentum) const {
        return {momentum(0) / body_.inertia[0], momentum(1) / body_.inertia[1],
                momentum(2) / body_.inertia[2]};
    }

    static Vector values(const VariedVector& v) { return {v(0).value, v(1).value, v(2).value}; }
    static Vector slopes(const VariedVector& v) { return {v(0).g[0], v(1).g[0], v(2).g[0]}; }

    BodyMechanics<double> body_;
    double h_;
    StepReport report_;

private:
    BodyMotion<double> read(const double* x) const {
        BodyMotion<double> m;
        m.q << x[0], x[1], x[2], x[3];
        m.momentum << x[4], x[5], x[6];
        if (size_ > 10) {
            m.position << x[10], x[11], x[12];
            m.linear << x[13], x[14], x[15];
        }
        return m;
    }
    void write(const BodyMotion<double>& m, double* x) const {
        const Vector pi = turnsMomentum() ? Vector(before_[7], before_[8], before_[9])
                                          : so3::matrix(so3::normalised(m.q)) * m.momentum;
        for (int i = 0; i < 4; ++i) x[i] = m.q(i);
        for (int i = 0; i < 3; ++i) x[4 + i] = m.momentum(i);
        for (int i = 0; i < 3; ++i) x[7 + i] = pi(i);
        if (size_ <= 10) return;
        for (int i = 0; i < 3; ++i) x[10 + i] = m.position(i);
        for (int i = 0; i < 3; ++i) x[13 + i] = m.linear(i);
    }
    void callPotential(const so3::Quaternion<double>& q, const Vector& position, double* f,
                       double* slope) const {
        const so3::Matrix<double> R = so3::matrix(q);
        body_.potential(body_.model.get(), R.data(), size_ > 10 ? position.data() : nullptr, nullptr, f,
                        slope);
    }
    template <class T>
    static so3::Vector<T> turnedBack(const so3::Quaternion<T>& q, const so3::Vector<T>& pi) {
        return so3::matrix(q).transpose() * pi;
    }
    /// zeta of the direction of q: q^{-1} dq = (., zeta / 2).
    static Vector twist(const so3::Quaternion<Varied>& q) {
        so3::Quaternion<double> at, along;
        for (int i = 0; i < 4; ++i) {
            at(i) = q(i).value;
            along(i) = q(i).g[0];
        }
        const so3::Quaternion<double> turn = so3::product(so3::conjugate(at), along);
        return 2 / at.squaredNorm() * Vector(turn(1), turn(2), turn(3));
    }
    static VariedVector varied(const Vector& value, const Vector& slope) {
        VariedVector v;
        for (int i = 0; i < 3; ++i) {
            v(i) = Varied(value(i));
            v(i).g[0] = slope(i);
        }
        return v;
    }

    /// w <- M w, one column, by the step over dual numbers.
    bool vary(double* w) {
        const bool moves = size_ > 10;
        const BodyMotion<double> start = read(before_.data());
        const so3::Matrix<double> R0 = so3::matrix(so3::normalised(start.q));
        const auto part = [&](int i) { return Vector(w[3 * i], w[3 * i + 1], w[3 * i + 2]); };
        const Vector zeta = part(0), dPi = part(moves ? 2 : 1);
        BodyMotion<Varied> m;
        const so3::Quaternion<double> dq =
            so3::product(start.q, so3::Quaternion<double>(0, zeta(0) / 2, zeta(1) / 2, zeta(2) / 2));
        for (int i = 0; i < 4; ++i) {
            m.q(i) = Varied(start.q(i));
            m.q(i).g[0] = dq(i);
        }
        m.momentum = varied(start.momentum, dPi);
        if (moves) {
            const Vector p = R0.transpose() * start.linear;
            m.position = varied(start.position, R0 * part(1));
            m.linear = varied(start.linear, R0 * (so3::cross(zeta, p) + part(3)));
        }
        step(m, h_);
        if (turnsMomentum())
            m.momentum = turnedBack(m.q, varied(Vector(before_[7], before_[8], before_[9]),
                                                R0 * (so3::cross(zeta, start.momentum) + dPi)));
        const Vector turned = twist(m.q), change = slopes(m.momentum);
        std::copy_n(turned.data(), 3, w);
        std::copy_n(change.data(), 3, w + (moves ? 6 : 3));
        if (moves) {
            so3::Quaternion<double> q;
            for (int i = 0; i < 4; ++i) q(i) = m.q(i).value;
            const so3::Matrix<double> back = so3::matrix(so3::normalised(q)).transpose();
            const Vector way = back * slopes(m.position),
                         push = back * slopes(m.linear) - so3::cross(turned, Vector(back * values(m.linear)));
            std::copy_n(way.data(), 3, w + 3);
            std::copy_n(push.data(), 3, w + 9);
        }
        return std::all_of(w, w + tangentSize(), [](double v) { return std::isfinite(v); });
    }

    std::function<bool(double, const double*, double*)> rate_;
    std::size_t size_;
    std::vector<double> before_, after_;
    mutable std::vector<double> slopeBefore_, slopeAfter_;
    double startTime_ = 0;
};

/// A method whose step is `template <class T> void move(BodyMotion<T>& m, double h)`.
template <class Method>
class BodyMethodOf : public BodyMethod {
public:
    using BodyMethod::BodyMethod;
    std::unique_ptr<Integrator> clone() const final {
        return std::make_unique<Method>(static_cast<const Method&>(*this));
    }

private:
    void step(BodyMotion<double>& m, double h) final { static_cast<Method&>(*this).move(m, h); }
    void step(BodyMotion<Varied>& m, double h) final { static_cast<Method&>(*this).move(m, h); }
};

}  // namespace extremal
