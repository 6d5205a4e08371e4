// SPDX-License-Identifier: GPL-3.0-or-later
/// Hénon-Heiles system: a star in the plane of a galaxy (Hénon and Heiles 1964),
///     L = (x_t^2 + y_t^2) / 2 - (x^2 + y^2) / 2 - lambda (x^2 y - y^3 / 3).
/// Dimensionless. Bounded below the escape energy 1/(6 lambda^2), where the potential has three saddles at
/// the corners of a triangle; regular at low energy, mostly chaotic close to escape. No exact solution.
#include <array>
#include <cmath>
#include <string>

#include "engine/model/bind.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

struct HenonHeiles {
    static constexpr int dimension = 2;
    static constexpr bool isNodeParallel = true;
    double lambda = 1;

    template <class T>
    std::array<T, 2> masses() const {
        return {T(1), T(1)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 2>& q) const {
        const S x2 = square(q[0]), y2 = square(q[1]);
        return (x2 + y2) * T(0.5) + (x2 - y2 * (T(1) / T(3))) * q[1] * T(lambda);
    }
    template <class T>
    void force(const T&, const T* q, T* f) const {
        const T x = q[0], y = q[1], l = T(lambda);
        f[0] = -x - l * x * (y + y);
        f[1] = l * (y * y - x * x) - y;
    }
};

const std::vector<Field<HenonHeiles>>& henonHeilesFields() {
    static const std::vector<Field<HenonHeiles>> all = {
        {&HenonHeiles::lambda, notNegative("lambda", "cubic coupling", "", 1,
                                           "Strength of the cubic term; 0 is the isotropic oscillator.")},
    };
    return all;
}

System makeHenonHeiles(const Settings& settings) {
    const auto model = withParameters(settings, henonHeilesFields());
    System s;
    s.id = "henon-heiles";
    s.coordinates = {{"x", "position x", "x", "", ""}, {"y", "position y", "y", "", ""}};
    s.parts.set(bindMechanics<double>(model));
    if (model.lambda == 0)
        s.momenta = {
            {"z", "L", "", [](const double* q, const double* p) { return q[0] * p[1] - q[1] * p[0]; }}};
    s.draw = [lambda = model.lambda](const double* x, Drawing& drawing) {
        if (lambda > 0) {  // the lines V = escape energy: a triangle through the saddles
            const double r = 1 / lambda, c = r * std::sqrt(0.75);
            const Point top{0, r, 0}, left{-c, -r / 2, 0}, right{c, -r / 2, 0};
            for (const auto& [a, b] : {std::pair{top, left}, {left, right}, {right, top}})
                drawing.shapes.push_back(Segment{a, b, 1, ShapeRole::scenery});
        }
        drawing.shapes.push_back(Disc{{x[0], x[1], 0}, 7});
        drawing.tracer = {x[0], x[1], 0};
    };
    s.phaseX = "q.y";
    s.phaseY = "p.y";
    s.trajectoryX = "q.x";
    s.trajectoryY = "q.y";
    s.hasPlanarTrajectory = true;
    return s;
}

}  // namespace

ModelEntry henon_heiles() {
    ModelEntry e;
    e.item = {"henon-heiles",
              "Hénon-Heiles system",
              "A star in a galaxy: between order and chaos in a potential with three exits.",
              infos(henonHeilesFields()),
              {},
              ""};
    e.exampleQ = {0, 0.1};
    e.exampleP = {0.5, 0};
    e.exampleEnd = 200;
    e.exampleStep = 0.1;
    e.lagrangian = [](const Settings&) -> std::string {
        return "(x_t^2+y_t^2)/2 - (x^2+y^2)/2 - lambda*(x^2*y - y^3/3)";
    };
    e.make = makeHenonHeiles;
    return e;
}

}  // namespace extremal::systems
