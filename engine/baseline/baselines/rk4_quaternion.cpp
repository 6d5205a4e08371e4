// SPDX-License-Identifier: GPL-3.0-or-later
/// The classical Runge-Kutta method of order 4 on attitude quaternion and momentum in the body, with or
/// without bringing the quaternion back to length 1 after each step.
#include <limits>

#include "engine/baseline/parts.hpp"
#include "engine/baseline/body_method.hpp"

namespace extremal::baselines {
namespace {

class Rk4Quaternion final : public BodyMethodOf<Rk4Quaternion> {
    friend BodyMethodOf;

public:
    Rk4Quaternion(const System& system, const BaselineOptions& options)
        : BodyMethodOf(system, options.step), isProjected_(options.settings.flag("projection")) {}

private:
    template <class T>
    static BodyMotion<T> sum(const BodyMotion<T>& m, double s, const BodyMotion<T>& d) {
        return {m.q + d.q * T(s), m.momentum + d.momentum * T(s), m.position + d.position * T(s),
                m.linear + d.linear * T(s)};
    }
    /// q' = q (0, omega) / 2, Pi' = Pi x omega + torque, x' = p / m, p' = R force.
    template <class T>
    BodyMotion<T> rate(const BodyMotion<T>& m) {
        so3::Vector<T> torque, force;
        if (body_.isFree()) ++report_.cost.evaluations;
        forces(m, torque, force);
        const so3::Vector<T> w = omega(m.momentum);
        BodyMotion<T> d;
        d.q = so3::product(m.q, so3::Quaternion<T>(T(0), w(0) / 2.0, w(1) / 2.0, w(2) / 2.0));
        d.momentum = so3::cross(m.momentum, w) + torque;
        if (body_.dimension == 6) {
            d.position = m.linear / T(body_.inertia[3]);
            d.linear = so3::matrix(so3::normalised(m.q)) * force;
        }
        return d;
    }
    template <class T>
    void move(BodyMotion<T>& m, double h) {
        const BodyMotion<T> k1 = rate(m), k2 = rate(sum(m, h / 2, k1)), k3 = rate(sum(m, h / 2, k2)),
                            k4 = rate(sum(m, h, k3));
        m = sum(sum(sum(sum(m, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
        if (isProjected_) m.q = so3::normalised(m.q);
    }

    bool isProjected_;
};

}  // namespace

BaselineEntry rk4_quaternion() {
    BaselineEntry e;
    e.item = {"rk4-quaternion",
              "RK4 on quaternions",
              "Classical Runge-Kutta of order 4 for rigid bodies: energy and momentum drift.",
              {projectionField()},
              Claims{4, false, false, {}},
              "a rigid body"};
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.takes = Takes::only<Body>();
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Rk4Quaternion>(system, options);
    };
    return e;
}

}  // namespace extremal::baselines
