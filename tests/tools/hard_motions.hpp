// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes that are hard for a reference, with the truth of their motion: a closed form, or an
/// error-controlled code in quadruple precision on right-hand sides by hand.
#pragma once

#include <boost/multiprecision/float128.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <QtGlobal>

#include "engine/scene/write/codec.hpp"

namespace extremal::hard_motions {

using Quad = boost::multiprecision::float128;
using QuadState = std::array<Quad, 4>;
/// q at t.
using Truth = std::function<std::vector<double>(double t)>;

inline ResolvedScene resolved(const std::string& scene) {
    const ReadScene read = readScene(scene);
    if (!read.errors.empty())
        qFatal("%s: %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return *read.resolved;
}

inline std::string sceneOf(const std::string& coordinates, const std::string& lagrangian,
                           const std::string& initial, double end, const std::string& scheme) {
    const std::string quote = "\"";
    return R"({"extremal":1,"model":{"type":"lagrangian","coordinates":[)" + coordinates + "]," + quote +
           "lagrangian" + quote + ":" + quote + lagrangian + quote + R"(},"observe":["error"],"initial":)" +
           initial + R"(,"time":{"end":)" + std::to_string(end) + R"(},"schemes":[)" + scheme + "]}";
}

/// Steps of order 8 under an error control, in quadruple precision; times ascend.
template <class Rate>
Truth inQuadruple(const QuadState& start, const Rate& rate) {
    using Stepper = boost::numeric::odeint::runge_kutta_fehlberg78<QuadState, Quad, QuadState, Quad>;
    struct Motion {
        QuadState x;
        Quad t = 0, step = Quad(1) / 1000;
        Stepper stepper = {};
    };
    return [motion = std::make_shared<Motion>(Motion{start}), rate](double until) {
        constexpr double tolerance = 1e-19;
        Motion& m = *motion;
        while (m.t < until) {
            const Quad left = Quad(until) - m.t;
            const bool isCut = m.step > left;
            const Quad h = isCut ? left : m.step;
            QuadState next, error;
            m.stepper.do_step(rate, m.x, m.t, next, h, error);
            double worst = 0;
            for (std::size_t i = 0; i < 4; ++i)
                worst = std::max(worst, static_cast<double>(abs(error[i]) / (1 + abs(next[i]))));
            if (worst <= tolerance) {
                m.x = next;
                m.t += h;
            }
            const double factor = 0.9 * std::pow(tolerance / std::max(worst, 1e-40), 0.125);
            if (!isCut || worst > tolerance) m.step = h * std::clamp(factor, 0.2, 4.0);
        }
        return std::vector<double>{static_cast<double>(m.x[0]), static_cast<double>(m.x[1])};
    };
}

struct Case {
    std::string scene;
    Truth truth;
};

inline const std::string rk4 = R"({"label":"RK4","baseline":"rk4","step":0.01})";

/// An eccentric orbit from its aphelion, with a second, fixed attraction.
inline Case grazing() {
    const auto rate = [](const QuadState& x, QuadState& dx, const Quad&) {
        const Quad r2 = x[0] * x[0] + x[1] * x[1], r3 = r2 * sqrt(r2);
        const Quad a = x[0] + 3, s2 = a * a + x[1] * x[1] + 1, s3 = s2 * sqrt(s2), m = Quad(1) / 1000;
        dx = {x[2], x[3], -x[0] / r3 - m * a / s3, -x[1] / r3 - m * x[1] / s3};
    };
    return {
        sceneOf(R"("x","y")", "(x_t^2 + y_t^2)/2 + 1/sqrt(x^2 + y^2) + 1/(1000*sqrt((x + 3)^2 + y^2 + 1))",
                R"({"q":[1.998,0],"p":[0,0.0316]})", 100,
                R"({"label":"rk8pd","baseline":"rk8pd","tolerance":1e-11})"),
        inQuadruple(QuadState{Quad(1.998), 0, 0, Quad(0.0316)}, rate)};
}

/// x'' = -sign x from rest at 1: parabolas of a quarter period of sqrt 2.
inline Case wells() {
    return {sceneOf(R"("x")", "x_t^2/2 - abs(x)", R"({"q":[1],"p":[0]})", 20, rk4), [](double t) {
                const double quarter = std::numbers::sqrt2, turn = std::fmod(t, 4 * quarter);
                const double s = turn < quarter       ? turn
                                 : turn < 3 * quarter ? turn - 2 * quarter
                                                      : turn - 4 * quarter;
                const double x = 1 - s * s / 2;
                return std::vector<double>{turn < quarter || turn >= 3 * quarter ? x : -x};
            }};
}

/// A kick of sqrt(2 pi) at 3.37, `width` wide.
inline Case pulse(double width, double at = 3.37) {
    const std::string s = std::to_string(width * 1e9) + "e-9", when = std::to_string(at);
    return {sceneOf(R"("x")", "x_t^2/2 - x^2/2 + x*exp(-(t - " + when + ")^2/(2*" + s + "^2))/" + s,
                    R"({"q":[1],"p":[0]})", 10, rk4),
            [width, at](double t) {
                // Outside the pulse; within, its own integral is the error function.
                const double kick = std::sqrt(2 * std::numbers::pi) * std::exp(-width * width / 2),
                             part = std::abs(t - at) > 9 * width ? (t > at ? 1.0 : 0.0) : std::nan("");
                return std::vector<double>{std::cos(t) + part * kick * std::sin(t - at)};
            }};
}

/// The double pendulum with unit masses and lengths, from rest at (2, 2.5).
inline Case chaotic() {
    const auto rate = [](const QuadState& x, QuadState& dx, const Quad&) {
        // p = (2 u + w c, w + u c) with c = cos(x0 - x1).
        const Quad c = cos(x[0] - x[1]), s = sin(x[0] - x[1]), g = Quad(981) / 100, d = 2 - c * c;
        const Quad u = (x[2] - c * x[3]) / d, w = (2 * x[3] - c * x[2]) / d;
        dx = {u, w, -u * w * s - 2 * g * sin(x[0]), u * w * s - g * sin(x[1])};
    };
    return {R"({"extremal":1,"model":{"type":"double-pendulum","m1":1,"m2":1,"l1":1,"l2":1,"g":9.81},
        "initial":{"q":[2,2.5],"p":[0,0]},"time":{"end":20},"observe":["error"],"schemes":[)" +
                rk4 + "]}",
            inQuadruple(QuadState{2, Quad(5) / 2, 0, 0}, rate)};
}

/// A ball that falls by 1 on a spring of 1000, which pushes only.
inline Case contact() {
    return {sceneOf(R"("z")", "z_t^2/2 - z - 500*((abs(z) - z)/2)^2", R"({"q":[1],"p":[0]})", 20, rk4),
            [](double t) {
                const double w = std::sqrt(1000.0), v = std::numbers::sqrt2, c = 1 / (w * w),
                             touch = (2 * std::numbers::pi - 2 * std::atan(v * w)) / w,
                             turn = std::fmod(t, 2 * v + touch);
                double z = 0;
                if (turn < v)
                    z = 1 - turn * turn / 2;
                else if (turn < v + touch)
                    z = c * (std::cos(w * (turn - v)) - 1) - v / w * std::sin(w * (turn - v));
                else
                    z = 1 - (turn - 2 * v - touch) * (turn - 2 * v - touch) / 2;
                return std::vector<double>{z};
            }};
}

}  // namespace extremal::hard_motions
