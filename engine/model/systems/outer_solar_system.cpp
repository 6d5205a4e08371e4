// SPDX-License-Identifier: GPL-3.0-or-later
/// The Sun and the five outer planets, Pluto among them, attracting each other (Hairer, Lubich and Wanner,
/// Geometric Numerical Integration, sec. I.2.4), 18 coordinates in astronomical units, days and solar masses:
///     L = 1/2 sum_i m_i |q_i_t|^2 + G sum_{i<j} m_i m_j / |q_i - q_j|.
/// The masses of the inner planets are added to the Sun's. Initial data: 5 September 1994. No exact solution.
#include <array>
#include <cmath>
#include <string>

#include "engine/model/bind.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/parts/held_bodies.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

constexpr std::size_t bodies = 6;

struct Planet {
    const char* name;
    const char* title;
    double mass;
    std::array<double, 3> position, velocity;
    double radius;  ///< on the stage, pixels
};
constexpr std::array<Planet, bodies> table = {{
    {"sun", "Sun", 1.00000597682, {0, 0, 0}, {0, 0, 0}, 10},
    {"jupiter",
     "Jupiter",
     0.000954786104043,
     {-3.5023653, -3.8169847, -1.5507963},
     {0.00565429, -0.00412490, -0.00190589},
     7},
    {"saturn",
     "Saturn",
     0.000285583733151,
     {9.0755314, -3.0458353, -1.6483708},
     {0.00168318, 0.00483525, 0.00192462},
     6},
    {"uranus",
     "Uranus",
     0.0000437273164546,
     {8.3101420, -16.2901086, -7.2521278},
     {0.00354178, 0.00137102, 0.00055029},
     5},
    {"neptune",
     "Neptune",
     0.0000517759138449,
     {11.4707666, -25.7294829, -10.8169456},
     {0.00288930, 0.00114527, 0.00039677},
     5},
    {"pluto",
     "Pluto",
     1 / 1.3e8,
     {-15.5387357, -25.2225594, -3.1902382},
     {0.00276725, -0.00170702, -0.00136504},
     3},
}};

struct OuterSolarSystem {
    static constexpr int dimension = 3 * bodies;
    static constexpr bool isNodeParallel = true;
    double G = 2.95912208286e-4;

    template <class T>
    std::array<T, dimension> masses() const {
        std::array<T, dimension> m;
        for (std::size_t i = 0; i < bodies; ++i)
            for (std::size_t k = 0; k < 3; ++k) m[3 * i + k] = T(table[i].mass);
        return m;
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, dimension>& q) const {
        using std::sqrt;
        S sum(T(0));
        for (std::size_t i = 0; i < bodies; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const S r2 = square(q[3 * i] - q[3 * j]) + square(q[3 * i + 1] - q[3 * j + 1]) +
                             square(q[3 * i + 2] - q[3 * j + 2]);
                sum += T(-G * table[i].mass * table[j].mass) / sqrt(r2);
            }
        return sum;
    }
    template <class T>
    void force(const T&, const T* q, T* f) const {
        using std::sqrt;
        for (std::size_t k = 0; k < 3 * bodies; ++k) f[k] = T(0);
        for (std::size_t i = 0; i < bodies; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const T x = q[3 * i] - q[3 * j], y = q[3 * i + 1] - q[3 * j + 1],
                        z = q[3 * i + 2] - q[3 * j + 2];
                const T r2 = x * x + y * y + z * z;
                const T w = T(-G * table[i].mass * table[j].mass) / (r2 * sqrt(r2));
                const std::array<T, 3> pull{w * x, w * y, w * z};
                for (std::size_t k = 0; k < 3; ++k) {
                    f[3 * i + k] += pull[k];
                    f[3 * j + k] -= pull[k];
                }
            }
    }
};

const std::vector<Field<OuterSolarSystem>>& outerSolarSystemFields() {
    static const std::vector<Field<OuterSolarSystem>> all = {
        {&OuterSolarSystem::G,
         positive("G", "gravitational constant", "au³/(M☉ d²)", 2.95912208286e-4,
                  "Gravitational constant in astronomical units, days and solar masses.")},
    };
    return all;
}

constexpr std::array<const char*, 3> axisNames = {"x", "y", "z"};

std::vector<MomentumMap> momenta() {
    std::vector<MomentumMap> all;
    for (std::size_t k = 0; k < 3; ++k)
        all.push_back({std::string("linear.") + axisNames[k], std::string("P_") + axisNames[k], "M☉ au/d",
                       [k](const double*, const double* p) {
                           double sum = 0;
                           for (std::size_t i = 0; i < bodies; ++i) sum += p[3 * i + k];
                           return sum;
                       }});
    for (std::size_t k = 0; k < 3; ++k)
        all.push_back({std::string("angular.") + axisNames[k], std::string("L_") + axisNames[k], "M☉ au²/d",
                       [a = (k + 1) % 3, b = (k + 2) % 3](const double* q, const double* p) {
                           double sum = 0;
                           for (std::size_t i = 0; i < bodies; ++i)
                               sum += q[3 * i + a] * p[3 * i + b] - q[3 * i + b] * p[3 * i + a];
                           return sum;
                       }});
    return all;
}

HeldBodies planets(double G) {
    HeldBodies all;
    for (int i = 0; const Planet& body : table) {
        all.bodies.push_back({body.mass, {i, i + 1, i + 2}, i == 0 ? 0 : G * table[0].mass * body.mass});
        i += 3;
    }
    return all;
}

System makeOuterSolarSystem(const Settings& settings) {
    System s;
    s.id = "outer-solar-system";
    for (const Planet& body : table)
        for (const char* axis : axisNames)
            s.coordinates.push_back({std::string(body.name) + "." + axis,
                                     std::string(body.title) + " " + axis,
                                     std::string(axis) + "_" + body.title, "au", "M☉ au/d"});
    s.timeUnit = "d";
    s.energyUnit = "M☉ au²/d²";
    const auto model = withParameters(settings, outerSolarSystemFields());
    s.parts.set(bindMechanics<double>(model));
    s.parts.set(planets(model.G));
    s.momenta = momenta();
    s.draw = [](const double* x, Drawing& drawing) {
        for (std::size_t i = 0; i < bodies; ++i)
            drawing.shapes.push_back(Disc{{x[3 * i], x[3 * i + 1], 0}, table[i].radius});
        drawing.tracer = {x[3], x[4], 0};
    };
    s.phaseX = "q.jupiter.x";
    s.phaseY = "p.jupiter.x";
    s.trajectoryX = "q.jupiter.x";
    s.trajectoryY = "q.jupiter.y";
    s.hasPlanarTrajectory = true;
    return s;
}

}  // namespace

ModelEntry outer_solar_system() {
    ModelEntry e;
    e.item = {"outer-solar-system",
              "outer solar system",
              "The Sun, Jupiter, Saturn, Uranus, Neptune and Pluto, from 5 September 1994.",
              infos(outerSolarSystemFields()),
              {},
              ""};
    for (const Planet& body : table)
        for (std::size_t k = 0; k < 3; ++k) {
            e.exampleQ.push_back(body.position[k]);
            e.exampleP.push_back(body.mass * body.velocity[k]);
        }
    e.exampleEnd = 200000;
    e.exampleStep = 200;
    e.make = makeOuterSolarSystem;
    return e;
}

}  // namespace extremal::systems
