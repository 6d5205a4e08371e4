// SPDX-License-Identifier: GPL-3.0-or-later
/// Harmonic oscillator: L = m x_t^2 / 2 - k x^2 / 2. Exact solution: a rotation of (sqrt(m k) x, p) by w =
/// sqrt(k/m). Schemes super-converge on it: stability shows here, orders are measured on nonlinear systems.
#include <array>
#include <cmath>
#include <string>

#include "engine/model/bind.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

struct HarmonicOscillator {
    static constexpr int dimension = 1;
    double m = 1, k = 1;

    template <class T>
    std::array<T, 1> masses() const {
        return {T(m)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 1>& q) const {
        return square(q[0]) * (k / 2);
    }
    template <class T>
    void force(const T&, const T* q, T* f) const {
        f[0] = q[0] * -k;
    }
};

const std::vector<Field<HarmonicOscillator>>& harmonicOscillatorFields() {
    static const std::vector<Field<HarmonicOscillator>> all = {
        {&HarmonicOscillator::m, positive("m", "mass", "kg", 1, "Mass on the spring.")},
        {&HarmonicOscillator::k, positive("k", "stiffness", "N/m", 1, "Stiffness of the spring.")},
    };
    return all;
}

ExactSolution exactSolution(const HarmonicOscillator& o, const State& initial) {
    // Roots apart: the product of two small numbers may be 0.
    const double w = std::sqrt(o.k / o.m), impedance = std::sqrt(o.k) * std::sqrt(o.m);
    return [=](double t, std::span<double> x) {
        const double c = std::cos(w * (t - initial.t)), s = std::sin(w * (t - initial.t));
        x[0] = c * initial.x[0] + s / impedance * initial.x[1];
        x[1] = c * initial.x[1] - s * impedance * initial.x[0];
    };
}

void drawHarmonicOscillator(const double* x, Drawing& drawing) {
    const Point wall{-2, 0, 0}, mass{x[0], 0, 0};
    drawing.shapes.push_back(Segment{{-2, -0.35, 0}, {-2, 0.35, 0}, 3, ShapeRole::scenery});
    drawing.shapes.push_back(Spring{wall, mass, 10});
    drawing.shapes.push_back(Disc{mass, 10});
    drawing.tracer = mass;
}

System makeHarmonicOscillator(const Settings& settings) {
    const auto model = withParameters(settings, harmonicOscillatorFields());
    System s;
    s.id = "harmonic-oscillator";
    s.coordinates = {{"x", "position", "x", "m", "kg m/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.parts.set(bindMechanics<double>(model));
    s.fast = {std::sqrt(model.k / model.m), {0}};
    s.exact = [model](const State& initial) { return exactSolution(model, initial); };
    s.draw = drawHarmonicOscillator;
    s.phaseX = "q.x";
    s.phaseY = "p.x";
    s.trajectoryX = "t";
    s.trajectoryY = "q.x";
    return s;
}

}  // namespace

ModelEntry harmonic_oscillator() {
    ModelEntry e;
    e.item = {"harmonic-oscillator",
              "harmonic oscillator",
              "A mass on a linear spring; exactly solvable.",
              infos(harmonicOscillatorFields()),
              {},
              ""};
    e.exampleQ = {1};
    e.exampleP = {0};
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.lagrangian = [](const Settings&) -> std::string { return "m/2*x_t^2 - k/2*x^2"; };
    e.make = makeHarmonicOscillator;
    return e;
}

}  // namespace extremal::systems
