// SPDX-License-Identifier: GPL-3.0-or-later
/// Dormand-Prince 5(4) of Boost.odeint under error control, on attitude quaternion and momentum in the body,
/// with or without bringing the quaternion back to length 1 after each step.
#include "engine/baseline/adaptive.hpp"
#include "engine/baseline/body_method.hpp"

namespace extremal::baselines {
namespace {

using so3::Quaternion;
using Vector = so3::Vector<double>;

/// The differential equation in y = (q, Pi) on SO(3), (q, Pi, x, p) on SE(3), p in space.
struct QuaternionEquation {
    BodyMechanics<double> body;

    std::size_t size() const { return body.dimension == 3 ? 7 : 13; }
    bool operator()(double, const double* y, double* dy) const {
        const Quaternion<double> q(y[0], y[1], y[2], y[3]);
        const Vector Pi(y[4], y[5], y[6]);
        const Vector w(Pi(0) / body.inertia[0], Pi(1) / body.inertia[1], Pi(2) / body.inertia[2]);
        const Quaternion<double> dq = so3::product(q, Quaternion<double>(0, w(0) / 2, w(1) / 2, w(2) / 2));
        Vector dPi = so3::cross(Pi, w);
        if (!body.isFree()) {
            const so3::Matrix<double> R = so3::matrix(so3::normalised(q));
            std::array<double, 6> f{};
            body.potential(body.model.get(), R.data(), body.dimension == 6 ? y + 7 : nullptr, nullptr,
                           f.data(), nullptr);
            dPi += Vector(f[0], f[1], f[2]);
            if (body.dimension == 6) Eigen::Map<Vector>(dy + 10) = R * Vector(f[3], f[4], f[5]);
        } else if (body.dimension == 6) {
            Eigen::Map<Vector>(dy + 10).setZero();
        }
        for (int i = 0; i < 4; ++i) dy[i] = dq(i);
        for (int i = 0; i < 3; ++i) dy[4 + i] = dPi(i);
        if (body.dimension == 6)
            for (int i = 0; i < 3; ++i) dy[7 + i] = y[10 + i] / body.inertia[3];
        return true;
    }
};

class Dopri5Quaternion final : public Integrator {
    using Stepper = boost::numeric::odeint::runge_kutta_dopri5<std::vector<double>>;

public:
    Dopri5Quaternion(const System& system, const BaselineOptions& options)
        : body_(system.body()),
          isProjected_(options.settings.flag("projection")),
          y_{0, 0, std::vector<double>(QuaternionEquation{body_}.size()), {}},
          inner_(QuaternionEquation{body_}, y_.x.size(), options) {}

    TimeGrid grid() const override { return TimeGrid::landing; }
    std::vector<MemoryPart> memoryParts() const override { return inner_.memoryParts(); }
    void begin(State& state) override { inner_.begin(state); }

    StepReport advance(State& state, double until) override {
        inner_.setStop(stop());
        y_.t = state.t;
        std::copy_n(state.x.begin(), 7, y_.x.begin());
        if (body_.dimension == 6) std::copy_n(state.x.begin() + 10, 6, y_.x.begin() + 7);
        y_.memory = state.memory;
        const StepReport report = inner_.advance(y_, until);
        if (report.outcome != Outcome::converged) return report;
        if (isProjected_) normalise(y_.x.data());
        write(y_.x.data(), state.x.data());
        state.memory = y_.memory;
        state.t = y_.t;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        std::vector<double> y(y_.x.size());
        inner_.denseOutput(tau, y);
        normalise(y.data());
        write(y.data(), x.data());
    }

    std::string tangentProblem() const override {
        return "its steps under error control are varied for systems with coordinates alone";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Dopri5Quaternion>(*this); }
    bool checkpoint(Archive& archive) override { return inner_.checkpoint(archive); }

private:
    static void normalise(double* y) {
        const double length = std::sqrt(y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]);
        for (int i = 0; i < 4; ++i) y[i] /= length;
    }
    void write(const double* y, double* x) const {
        const Vector pi = so3::matrixAt(y) * Vector(y[4], y[5], y[6]);
        std::copy_n(y, 7, x);
        for (int i = 0; i < 3; ++i) x[7 + i] = pi(i);
        if (body_.dimension == 6) std::copy_n(y + 7, 6, x + 10);
    }

    BodyMechanics<double> body_;
    bool isProjected_;
    State y_;
    Adaptive<Stepper> inner_;
};

}  // namespace

BaselineEntry dopri5_quaternion() {
    BaselineEntry e;
    e.item = {"dopri5-quaternion",
              "Dormand-Prince 5(4) on quaternions",
              "Boost.odeint's pair of order 5 under error control, for rigid bodies.",
              {projectionField()},
              Claims{5, false, false, {}},
              "a rigid body"};
    e.grid = TimeGrid::landing;
    e.takes = Takes::only<Body>();
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Dopri5Quaternion>(system, options);
    };
    return e;
}

}  // namespace extremal::baselines
