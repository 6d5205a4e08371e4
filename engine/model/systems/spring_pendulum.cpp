// SPDX-License-Identifier: GPL-3.0-or-later
/// Planar pendulum on a stiff spring (Leok 2004, sec. 7.2), in polar coordinates: extension a, angle theta
/// from the downward vertical,
///     L = m/2 (a_t^2 + (l + a)^2 theta_t^2) + m g (l + a) cos theta - k/2 a^2.
/// Not separable. The spring is fast: a oscillates with about sqrt(k/m) around the mean
/// (m g cos theta + m l theta_t^2) / k, which the printed fast equation leaves out. No exact solution.
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "engine/model/bind.hpp"
#include "engine/model/lagrangian_terms.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/slow/spring_models.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::systems {
namespace {

struct SpringPendulum {
    static constexpr int dimension = 2;
    static constexpr bool isNodeParallel = true;
    double m = 1, g = 9.81, l = 1, k = 1e4;

    template <class T, class S>
    S lagrangian(const T&, const std::array<S, 2>& q, const std::array<S, 2>& v) const {
        using std::cos;
        const S r = q[0] + l;
        return (square(v[0]) + square(r * v[1])) * (m / 2) + r * cos(q[1]) * (m * g) - square(q[0]) * (k / 2);
    }
    template <class T>
    void velocity(const T&, const T* q, const T* p, T* v) const {
        const T r = q[0] + l;
        v[0] = p[0] / m;
        v[1] = p[1] / (m * r * r);
    }
    /// Energy of the spring's oscillation around the mean it has at this angle and angular momentum.
    double oscillation(const double* x) const {
        const double r = x[0] + l, rate = x[3] / (m * r * r),
                     mean = m * (g * std::cos(x[1]) + r * rate * rate) / k;
        return x[2] * x[2] / (2 * m) + k / 2 * square(x[0] - mean);
    }
    /// At fixed angular momentum: w^2 = k/m + 3 p_theta^2 / (m^2 r^4), where sqrt(k/m) is printed.
    double frequency(const double* x) const {
        const double r = x[0] + l, rate = x[3] / (m * r * r);
        return std::sqrt(k / m + 3 * rate * rate);
    }
};

/// H = p_a^2/(2m) + k a^2/2 alone: the angle stands still.
FastMotion::Flow oscillate(const SpringPendulum& s, double time) {
    const double w = std::sqrt(s.k / s.m), c = std::cos(w * time), z = std::sin(w * time), mass = s.m * w;
    return [c, z, mass](auto* x) {
        const auto a = x[0];
        x[0] = c * a + z / mass * x[2];
        x[2] = c * x[2] - z * mass * a;
    };
}

/// H = -m g r cos theta alone.
FastMotion::Flow fall(const SpringPendulum& s, double time) {
    return [impulse = time * s.m * s.g, l = s.l](auto* x) {
        using std::cos;
        using std::sin;
        x[2] += impulse * cos(x[1]);
        x[3] -= impulse * (l + x[0]) * sin(x[1]);
    };
}
/// H = p_theta^2/(2 m r^2) alone.
FastMotion::Flow turn(const SpringPendulum& s, double time) {
    return [m = s.m, l = s.l, time](auto* x) {
        const auto r = l + x[0], rate = x[3] / (m * r * r);
        x[1] += time * rate;
        x[2] += time * m * r * rate * rate;
    };
}

const std::vector<Field<SpringPendulum>>& springPendulumFields() {
    static const std::vector<Field<SpringPendulum>> all = {
        {&SpringPendulum::m, positive("m", "mass", "kg", 1, "Mass of the bob.")},
        {&SpringPendulum::g, notNegative("g", "gravity", "m/s²", 9.81, "Acceleration of gravity.")},
        {&SpringPendulum::l, positive("l", "length", "m", 1, "Length of the unloaded spring.")},
        {&SpringPendulum::k, positive("k", "stiffness", "N/m", 1e4, "Stiffness of the spring.")},
    };
    return all;
}

System makeSpringPendulum(const Settings& settings) {
    const auto model = withParameters(settings, springPendulumFields());
    System s;
    s.id = "spring-pendulum";
    s.coordinates = {{"a", "extension", "a", "m", "kg m/s"}, {"theta", "angle", "θ", "rad", "kg m²/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    Mechanics<double> mechanics = bindMechanics<double>(model);
    mechanics.terms = madeOnce([model] {
        typed::Formula f{
            {"a", "theta"}, {{"m", model.m}, {"g", model.g}, {"l", model.l}, {"k", model.k}}, ""};
        f.terms = {{"kinetic", "m/2*(a_t^2 + (l+a)^2*theta_t^2)"},
                   {"fast", "-k/2*a^2"},
                   {"slow", "m*g*(l+a)*cos(theta)"}};
        return typed::makeTerms(f);
    });
    s.parts.set(std::move(mechanics));
    s.fast = {std::sqrt(model.k / model.m),
              {0},
              [model](double, const double* x) { return model.oscillation(x); },
              [model](double, const double* x) { return model.oscillation(x) / model.frequency(x); },
              [model](double time) { return oscillate(model, time); },
              {[model](double time) { return fall(model, time); },
               [model](double time) { return turn(model, time); }}};
    SlowModels slow{slow::springModels({model.m, model.g, model.l, model.k})};
    s.reduced = {reducedModel("rigid-pendulum", slow.all[0]), reducedModel("averaged", slow.all[1])};
    s.parts.set(std::move(slow));
    s.draw = [l = model.l](const double* x, Drawing& drawing) {
        const double r = l + x[0];
        const Point bob{r * std::sin(x[1]), -r * std::cos(x[1]), 0};
        drawing.shapes.push_back(Support{{0, 0, 0}, 0.5 * l});
        drawing.shapes.push_back(Spring{{0, 0, 0}, bob, 14});
        drawing.shapes.push_back(Disc{bob, 9});
        drawing.tracer = bob;
    };
    s.phaseX = "q.a";
    s.phaseY = "p.a";
    s.trajectoryX = "t";
    s.trajectoryY = "q.theta";
    return s;
}

}  // namespace

ModelEntry spring_pendulum() {
    ModelEntry e;
    e.item = {"spring-pendulum",
              "spring pendulum",
              "A pendulum whose rod is a stiff spring: a slow swing and a fast oscillation.",
              infos(springPendulumFields()),
              {},
              ""};
    e.exampleQ = {0.05, 1};
    e.exampleP = {0, 0};
    e.exampleEnd = 10;
    e.exampleStep = 0.01;
    e.lagrangian = [](const Settings&) -> std::string {
        return "m/2*(a_t^2 + (l+a)^2*theta_t^2) + m*g*(l+a)*cos(theta) - k/2*a^2";
    };
    e.make = makeSpringPendulum;
    return e;
}

}  // namespace extremal::systems
