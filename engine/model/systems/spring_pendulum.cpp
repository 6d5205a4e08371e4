/// Planar pendulum on a stiff spring (Leok 2004, sec. 6.2), in polar coordinates: extension a, angle theta from the
/// downward vertical,
///     L = m/2 (a_t^2 + (l + a)^2 theta_t^2) + m g (l + a) cos theta - k/2 a^2.
/// Not separable. The spring is fast: a oscillates with about sqrt(k/m) around the mean
/// (m g cos theta + m l theta_t^2) / k, which the printed fast equation leaves out. No exact solution.
#include <array>
#include <cmath>

#include "engine/model/bind.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

struct SpringPendulum {
    static constexpr int dimension = 2;
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
};

const std::vector<Field<SpringPendulum>>& fields() {
    static const std::vector<Field<SpringPendulum>> all = {
        {&SpringPendulum::m, positive("m", "mass", "kg", 1, "Mass of the bob.")},
        {&SpringPendulum::g, notNegative("g", "gravity", "m/s²", 9.81, "Acceleration of gravity.")},
        {&SpringPendulum::l, positive("l", "length", "m", 1, "Length of the unloaded spring.")},
        {&SpringPendulum::k, positive("k", "stiffness", "N/m", 1e4, "Stiffness of the spring.")},
    };
    return all;
}

System make(const Settings& settings) {
    const auto model = withParameters(settings, fields());
    System s;
    s.id = "spring-pendulum";
    s.coordinates = {{"a", "extension", "a", "m", "kg m/s"}, {"theta", "angle", "θ", "rad", "kg m²/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.mechanics = bindMechanics<double>(model);
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
    e.item = {"spring-pendulum", "spring pendulum",
              "A pendulum whose rod is a stiff spring: a slow swing and a fast oscillation.", infos(fields()), {}, ""};
    e.exampleQ = {0.05, 1};
    e.exampleP = {0, 0};
    e.exampleEnd = 10;
    e.exampleStep = 0.01;
    e.make = make;
    return e;
}

}  // namespace extremal::systems
