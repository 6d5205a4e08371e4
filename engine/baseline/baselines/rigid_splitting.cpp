// SPDX-License-Identifier: GPL-3.0-or-later
/// Splitting of a rigid body into rotations about its axes: exp of H_i = Pi_i^2 / (2 I_i) turns it about axis
/// i by t Pi_i / I_i. The Strang composition 1(h/2) 2(h/2) 3(h) 2(h/2) 1(h/2), between half kicks of a
/// potential, is of order 2; Suzuki's five of them are of order 4, Kahan and Li's nine of order 6 (Hairer,
/// Lubich and Wanner 2006, V.3.2 and VII.5.3).
#include <cmath>
#include <vector>

#include <limits>

#include "engine/baseline/parts.hpp"
#include "engine/baseline/body_method.hpp"

namespace extremal::baselines {
namespace {

std::vector<double> substeps(int order) {
    if (order == 2) return {1};
    if (order == 4) {
        const double g = 1 / (4 - std::cbrt(4.0));
        return {g, g, 1 - 4 * g, g, g};
    }
    constexpr double g1 = 0.39216144400731413928, g2 = 0.33259913678935943860, g3 = -0.70624617255763935981,
                     g4 = 0.08221359629355080023;
    return {g1, g2, g3, g4, 1 - 2 * (g1 + g2 + g3 + g4), g4, g3, g2, g1};
}

class RigidSplitting final : public BodyMethodOf<RigidSplitting> {
    friend BodyMethodOf;

public:
    RigidSplitting(const System& system, const BaselineOptions& options)
        : BodyMethodOf(system, options.step), substeps_(substeps(options.settings.integer("order"))) {}

private:
    bool turnsMomentum() const override { return body_.isFree(); }
    template <class T>
    void turn(BodyMotion<T>& m, int i, double t) const {
        using std::cos;
        using std::sin;
        const T half = m.momentum(i) * (0.5 * t) / body_.inertia[static_cast<std::size_t>(i)];
        const T c = cos(half), s = sin(half), cc = c * c - s * s, ss = s * c * 2.0;
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        // q (c, s e_i), and the momentum turned back in the body.
        const so3::Quaternion<T> q = m.q;
        m.q(0) = c * q(0) - s * q(1 + i);
        m.q(1 + i) = c * q(1 + i) + s * q(0);
        m.q(1 + j) = c * q(1 + j) + s * q(1 + k);
        m.q(1 + k) = c * q(1 + k) - s * q(1 + j);
        const T a = m.momentum(j), b = m.momentum(k);
        m.momentum(j) = cc * a + ss * b;
        m.momentum(k) = cc * b - ss * a;
    }
    template <class T>
    void kick(BodyMotion<T>& m, double t) {
        so3::Vector<T> torque, force;
        forces(m, torque, force);
        m.momentum += torque * T(t);
        if (body_.dimension == 6) m.linear += so3::matrix(m.q) * force * T(t);
    }
    template <class T>
    void move(BodyMotion<T>& m, double h) {
        report_.cost.evaluations += 5 * static_cast<int>(substeps_.size());
        for (const double fraction : substeps_) {
            const double s = fraction * h;
            if (!body_.isFree()) kick(m, s / 2);
            turn(m, 0, s / 2);
            turn(m, 1, s / 2);
            turn(m, 2, s);
            turn(m, 1, s / 2);
            turn(m, 0, s / 2);
            if (body_.dimension == 6) m.position += m.linear * T(s / body_.inertia[3]);
            if (!body_.isFree()) kick(m, s / 2);
        }
        m.q = so3::normalised(m.q);
    }

    std::vector<double> substeps_;
};

}  // namespace

BaselineEntry rigid_splitting() {
    FieldInfo order = integerField("order", "", 2, 6, 2,
                                   "Strang (2), Suzuki's composition of it (4), or Kahan and Li's (6).");
    order.choices = {"2", "4", "6"};
    BaselineEntry e;
    e.item = {"rigid-splitting",
              "rigid splitting",
              "Explicit splitting of a rigid body into rotations about its axes; kicks for a potential.",
              {order},
              Claims{2, true, true, {"momentum"}},
              "a rigid body"};
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) {
        return Claims{settings.integer("order"), true, true, {"momentum"}};
    }});
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.takes = Takes::only<Body>();
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<RigidSplitting>(system, options);
    };
    return e;
}

}  // namespace extremal::baselines
