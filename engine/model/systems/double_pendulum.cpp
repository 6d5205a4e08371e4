// SPDX-License-Identifier: GPL-3.0-or-later
/// Double pendulum: two point masses on massless rods, angles theta1, theta2 both from the downward vertical,
///     L = (m1 + m2)/2 l1^2 theta1_t^2 + m2/2 l2^2 theta2_t^2 + m2 l1 l2 theta1_t theta2_t cos(theta1 -
///     theta2)
///         + (m1 + m2) g l1 cos theta1 + m2 g l2 cos theta2.
/// Not separable; chaotic at large energy, so that no two schemes agree for long there. No exact solution.
#include <array>
#include <cmath>
#include <string>

#include "engine/model/bind.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

struct DoublePendulum {
    static constexpr int dimension = 2;
    double m1 = 1, m2 = 1, l1 = 1, l2 = 1, g = 9.81;

    template <class T, class S>
    S lagrangian(const T&, const std::array<S, 2>& q, const std::array<S, 2>& v) const {
        using std::cos;
        return square(v[0]) * (0.5 * (m1 + m2) * l1 * l1) + square(v[1]) * (0.5 * m2 * l2 * l2) +
               v[0] * v[1] * cos(q[0] - q[1]) * (m2 * l1 * l2) + cos(q[0]) * ((m1 + m2) * g * l1) +
               cos(q[1]) * (m2 * g * l2);
    }
    /// M v = p with M = [[A, B], [B, C]]; det M >= m1 m2 l1^2 l2^2 > 0.
    template <class T>
    void velocity(const T&, const T* q, const T* p, T* v) const {
        using std::cos;
        const T A = (m1 + m2) * l1 * l1, C = m2 * l2 * l2, B = m2 * l1 * l2 * cos(q[0] - q[1]);
        const T det = A * C - B * B;
        v[0] = (C * p[0] - B * p[1]) / det;
        v[1] = (A * p[1] - B * p[0]) / det;
    }
};

const std::vector<Field<DoublePendulum>>& doublePendulumFields() {
    static const std::vector<Field<DoublePendulum>> all = {
        {&DoublePendulum::m1, positive("m1", "upper mass", "kg", 1, "Mass at the end of the upper rod.")},
        {&DoublePendulum::m2, positive("m2", "lower mass", "kg", 1, "Mass at the end of the lower rod.")},
        {&DoublePendulum::l1, positive("l1", "upper length", "m", 1, "Length of the upper rod.")},
        {&DoublePendulum::l2, positive("l2", "lower length", "m", 1, "Length of the lower rod.")},
        {&DoublePendulum::g, notNegative("g", "gravity", "m/s²", 9.81, "Acceleration of gravity.")},
    };
    return all;
}

System makeDoublePendulum(const Settings& settings) {
    const auto model = withParameters(settings, doublePendulumFields());
    System s;
    s.id = "double-pendulum";
    s.coordinates = {{"theta1", "upper angle", "θ₁", "rad", "kg m²/s"},
                     {"theta2", "lower angle", "θ₂", "rad", "kg m²/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.parts.set(bindMechanics<double>(model));
    if (model.g == 0)
        s.momenta = {
            {"total", "p_θ₁ + p_θ₂", "kg m²/s", [](const double*, const double* p) { return p[0] + p[1]; }}};
    s.draw = [l1 = model.l1, l2 = model.l2](const double* x, Drawing& drawing) {
        const Point elbow{l1 * std::sin(x[0]), -l1 * std::cos(x[0]), 0};
        const Point end{elbow[0] + l2 * std::sin(x[1]), elbow[1] - l2 * std::cos(x[1]), 0};
        drawing.shapes.push_back(Support{{0, 0, 0}, 0.5 * l1});
        drawing.shapes.push_back(Segment{{0, 0, 0}, elbow});
        drawing.shapes.push_back(Segment{elbow, end});
        drawing.shapes.push_back(Disc{elbow, 7});
        drawing.shapes.push_back(Disc{end, 8});
        drawing.tracer = end;
    };
    s.phaseX = "q.theta2";
    s.phaseY = "p.theta2";
    s.trajectoryX = "t";
    s.trajectoryY = "q.theta2";
    return s;
}

}  // namespace

ModelEntry double_pendulum() {
    ModelEntry e;
    e.item = {"double-pendulum",
              "double pendulum",
              "A pendulum attached to a pendulum: regular at low energies, chaotic at high ones.",
              infos(doublePendulumFields()),
              {},
              ""};
    e.exampleQ = {2, 2.5};
    e.exampleP = {0, 0};
    e.exampleEnd = 20;
    e.exampleStep = 0.01;
    e.lagrangian = [](const Settings&) -> std::string {
        return "(m1+m2)/2*l1^2*theta1_t^2 + m2/2*l2^2*theta2_t^2 + "
               "m2*l1*l2*theta1_t*theta2_t*cos(theta1-theta2) + (m1+m2)*g*l1*cos(theta1) + "
               "m2*g*l2*cos(theta2)";
    };
    e.make = makeDoublePendulum;
    return e;
}

}  // namespace extremal::systems
