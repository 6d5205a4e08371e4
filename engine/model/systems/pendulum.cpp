/// Planar pendulum: L = m l^2 theta_t^2 / 2 + m g l cos theta, theta from the downward vertical.
///
/// Exact solution by Jacobi elliptic functions (w = sqrt(g/l), y = theta_t at the start, modulus from the
/// energy):
///     kappa^2 = sin^2(theta_0/2) + (y/(2 w))^2
///     libration, kappa < 1:  sin(theta/2) = kappa sn(w t + u_0, kappa)
///     rotation,  kappa > 1:  theta/2 = am(kappa w t + u_0, 1/kappa), with the sign of the motion
/// At kappa = 1, the separatrix, theta/2 is the Gudermannian.
#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <string>
#include <numbers>

#include "engine/core/quiet.hpp"
#include "engine/model/bind.hpp"
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
};

const std::vector<Field<Pendulum>>& pendulumFields() {
    static const std::vector<Field<Pendulum>> all = {
        {&Pendulum::m, positive("m", "mass", "kg", 1, "Mass of the bob.")},
        {&Pendulum::l, positive("l", "length", "m", 1, "Length of the rod.")},
        {&Pendulum::g, positive("g", "gravity", "m/s²", 9.81, "Acceleration of gravity.")},
    };
    return all;
}

/// The incomplete integral F(phi, k) for any phi, through the quarter period.
double ellipticF(double k, double phi) { return boost::math::ellint_1(k, phi, quiet); }

struct PendulumFlow {
    double w, inertia, kappa, modulus, quarter, u0, sign, start, turns;
    bool isRotation, isSeparatrix;

    PendulumFlow(const Pendulum& p, const State& initial) : start(initial.t) {
        w = std::sqrt(p.g / p.l);
        inertia = p.m * p.l * p.l;
        const double pi = std::numbers::pi;
        const double theta = initial.x[0], y = initial.x[1] / inertia;
        turns = std::round(theta / (2 * pi));
        const double half = (theta - 2 * pi * turns) / 2;
        kappa = std::hypot(std::sin(half), y / (2 * w));
        isSeparatrix = std::abs(kappa - 1) < 1e-14;
        isRotation = !isSeparatrix && kappa > 1;
        sign = y < 0 ? -1 : 1;
        modulus = isRotation ? 1 / kappa : std::min(kappa, 1.0);
        quarter = isSeparatrix ? 0 : boost::math::ellint_1(modulus, quiet);
        if (isSeparatrix) {
            u0 = sign * std::atanh(std::sin(half));
        } else if (isRotation) {
            u0 = sign * ellipticF(modulus, half);
        } else if (kappa == 0) {
            u0 = 0;
        } else {
            // sin(half) = kappa sin(phi), cos(phi) has the sign of y.
            const double phi = std::atan2(std::sin(half), y / (2 * w));
            u0 = ellipticF(modulus, phi);
        }
    }
    void operator()(double t, std::span<double> x) const {
        const double pi = std::numbers::pi;
        double half = 0, rate = 0;
        if (isSeparatrix) {
            const double u = w * (t - start) + u0;
            half = sign * 2 * std::atan(std::tanh(u / 2));
            rate = sign * w / std::cosh(u);
        } else if (isRotation) {
            double dn = 0, cn = 0;
            const double u = kappa * w * (t - start) + u0;
            const double cycles = std::round(u / (2 * quarter));
            const double sn =
                boost::math::jacobi_elliptic(modulus, u - 2 * quarter * cycles, &cn, &dn, quiet);
            half = sign * (std::atan2(sn, cn) + cycles * pi);
            rate = sign * kappa * w * dn;
        } else if (kappa > 0) {
            double dn = 0, cn = 0;
            const double u = std::remainder(w * (t - start) + u0, 4 * quarter);
            const double sn = boost::math::jacobi_elliptic(modulus, u, &cn, &dn, quiet);
            half = std::asin(kappa * sn);
            rate = kappa * w * cn;
        }
        x[0] = 2 * half + 2 * pi * turns;
        x[1] = 2 * rate * inertia;
    }
};

System makePendulum(const Settings& settings) {
    const auto model = withParameters(settings, pendulumFields());
    System s;
    s.id = "pendulum";
    s.coordinates = {{"theta", "angle", "θ", "rad", "kg m²/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.kind = bindMechanics<double>(model);
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
