// SPDX-License-Identifier: GPL-3.0-or-later
/// Planar pendulum: L = m l^2 theta_t^2 / 2 + m g l cos theta, theta from the downward vertical.
///
/// Exact solution by Jacobi elliptic functions (w = sqrt(g/l), y = theta_t at the start, modulus from the
/// energy):
///     kappa^2 = sin^2(theta_0/2) + (y/(2 w))^2
///     libration, kappa < 1:  sin(theta/2) = kappa sn(w t + u_0, kappa)
///     rotation,  kappa > 1:  theta/2 = am(kappa w t + u_0, 1/kappa), with the sign of the motion
/// At kappa = 1, the separatrix, theta/2 is the Gudermannian. The elliptic functions are taken from 1 -
/// kappa^2 or 1 - 1/kappa^2, which is formed as a product.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "engine/model/bind.hpp"
#include "engine/model/body/jacobi_elliptic.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

struct Pendulum {
    static constexpr int dimension = 1;
    double m = 1, l = 1, g = 9.81;

    template <class T>
    std::array<T, 1> masses() const {
        return {T(m) * T(l) * T(l)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 1>& q) const {
        using std::cos;
        return cos(q[0]) * (-m * g * l);
    }
    template <class T>
    void force(const T&, const T* q, T* f) const {
        using std::sin;
        f[0] = sin(q[0]) * (-m * g * l);
    }
};

const std::vector<Field<Pendulum>>& pendulumFields() {
    static const std::vector<Field<Pendulum>> all = {
        {&Pendulum::m, positive("m", "mass", "kg", 1, "Mass of the bob.")},
        {&Pendulum::l, positive("l", "length", "m", 1, "Length of the rod.")},
        {&Pendulum::g, positive("g", "gravity", "m/s²", 9.81, "Acceleration of gravity.")},
    };
    return all;
}

/// The motion from an initial state. With s, c the sine and cosine of theta_0/2 and Y = y/(2 w), all from the
/// full angle, so that nothing is lost where theta_0 is near the top,
///     kappa^2 = s^2 + Y^2,   1 - kappa^2 = (c - |Y|)(c + |Y|)
/// The difference is formed in extended precision where the machine has it: near the separatrix the time to
/// fall is the logarithm of it.
class PendulumFlow {
public:
    PendulumFlow(const Pendulum& p, const State& initial) : start_(initial.t) {
        using Wide = long double;
        const Wide pi = std::numbers::pi_v<Wide>, theta = initial.x[0];
        const Wide inertia = Wide(p.m) * p.l * p.l, w = std::sqrt(Wide(p.g) / p.l);
        const Wide y = Wide(initial.x[1]) / inertia;
        Wide s = std::sin(theta / 2), c = std::cos(theta / 2);
        if (c < 0) {
            s = -s;
            c = -c;
        }
        turns_ = static_cast<double>(std::round((theta / 2 - std::atan2(s, c)) / pi));
        const Wide Y = std::abs(y) / (2 * w), below = (c - Y) * (c + Y), kappa = std::hypot(s, Y);
        w_ = static_cast<double>(w);
        inertia_ = static_cast<double>(inertia);
        kappa_ = static_cast<double>(kappa);
        sign_ = y < 0 ? -1 : 1;
        kind_ = kappa == 0 ? Kind::rest : below > 0 ? Kind::libration : Kind::rotation;
        m1_ = static_cast<double>(kind_ == Kind::rotation ? -below / (kappa * kappa) : below);
        quarter_ = quarterPeriod(m1_);
        const auto square = [](Wide x) { return static_cast<double>(x * x); };
        if (kind_ == Kind::rotation) {
            u0_ = sign_ * integralOfFirstKind(static_cast<double>(s), square(c), square(c) + m1_ * square(s));
        } else if (kind_ == Kind::libration) {
            // s = kappa sin(phi), Y = kappa |cos(phi)|, and cos(phi) has the sign of y.
            u0_ = integralOfFirstKind(static_cast<double>(s / kappa), square(Y / kappa), square(c));
            if (y < 0) u0_ = std::copysign(2 * quarter_, u0_) - u0_;
        }
    }
    void operator()(double t, std::span<double> x) const {
        double half = 0, rate = 0;
        if (kind_ == Kind::rotation) {
            const double u = kappa_ * w_ * (t - start_) + u0_;
            const double cycles = std::isfinite(quarter_) ? std::round(u / (2 * quarter_)) : 0;
            const JacobiElliptic j(cycles == 0 ? u : u - 2 * quarter_ * cycles, m1_);
            half = sign_ * (std::atan2(j.sn, j.cn) + cycles * std::numbers::pi);
            rate = sign_ * kappa_ * w_ * j.dn;
        } else if (kind_ == Kind::libration) {
            const double u = w_ * (t - start_) + u0_;
            const JacobiElliptic j(std::remainder(u, 4 * quarter_), m1_);
            half = std::atan2(kappa_ * j.sn, j.dn);  // its cosine is dn
            rate = kappa_ * w_ * j.cn;
        }
        x[0] = 2 * half + 2 * std::numbers::pi * turns_;
        x[1] = 2 * rate * inertia_;
    }

private:
    /// On the separatrix itself, 1 - kappa^2 = 0, rotation takes forever for half a turn.
    enum class Kind { rest, libration, rotation };

    Kind kind_ = Kind::rest;
    double start_, w_ = 0, inertia_ = 0, kappa_ = 0, sign_ = 1, turns_ = 0;
    double m1_ = 1;  ///< the complementary parameter, 1 - kappa^2 or 1 - 1/kappa^2
    double quarter_ = 0, u0_ = 0;
};

System makePendulum(const Settings& settings) {
    const auto model = withParameters(settings, pendulumFields());
    System s;
    s.id = "pendulum";
    s.coordinates = {{"theta", "angle", "θ", "rad", "kg m²/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.parts.set(bindMechanics<double>(model));
    s.exact = [model](const State& initial) -> ExactSolution { return PendulumFlow(model, initial); };
    s.draw = [l = model.l](const double* x, Drawing& drawing) {
        const Point bob{l * std::sin(x[0]), -l * std::cos(x[0]), 0};
        drawing.shapes.push_back(Support{{0, 0, 0}, 0.5 * l});
        drawing.shapes.push_back(Segment{{0, 0, 0}, bob, 2.5});
        drawing.shapes.push_back(Disc{bob, 9});
        drawing.tracer = bob;
    };
    s.phaseX = "q.theta";
    s.phaseY = "p.theta";
    s.trajectoryX = "t";
    s.trajectoryY = "q.theta";
    return s;
}

}  // namespace

ModelEntry pendulum() {
    ModelEntry e;
    e.item = {"pendulum",
              "pendulum",
              "A mass on a rigid rod; exact solution by elliptic functions.",
              infos(pendulumFields()),
              {},
              ""};
    e.exampleQ = {1};
    e.exampleP = {0};
    e.exampleEnd = 20;
    e.exampleStep = 0.05;
    e.lagrangian = [](const Settings&) -> std::string { return "m/2*l^2*theta_t^2 + m*g*l*cos(theta)"; };
    e.make = makePendulum;
    return e;
}

}  // namespace extremal::systems
