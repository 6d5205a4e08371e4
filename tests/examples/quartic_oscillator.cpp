// SPDX-License-Identifier: GPL-3.0-or-later
/// A mass in a quartic well: L = m x_t^2 / 2 - c x^4 / 4.
/// The harder it is pushed, the faster it swings.
#include <array>

#include "engine/model/bind.hpp"
#include "engine/model/parameters.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

/// The physics: parameters, masses and a potential, written once and generic in the number S,
/// so that forces and Hessians follow by automatic differentiation. A Lagrangian that is not
/// separable defines `S lagrangian(t, q, v)` in place of masses and potential.
struct QuarticOscillator {
    static constexpr int dimension = 1;
    double m = 1, c = 1;

    template <class T>
    std::array<T, 1> masses() const {
        return {T(m)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 1>& q) const {
        return square(square(q[0])) * (c / 4);
    }
};

/// The keys of "model", with units, defaults and ranges: forms, checks and lists use them.
const std::vector<Field<QuarticOscillator>>& fields() {
    static const std::vector<Field<QuarticOscillator>> all = {
        {&QuarticOscillator::m, positive("m", "mass", "kg", 1, "Mass in the well.")},
        {&QuarticOscillator::c, positive("c", "stiffness", "N/m³", 1, "The force is -c x^3.")},
    };
    return all;
}

System make(const Settings& settings) {
    System s;
    s.id = "quartic-oscillator";
    s.coordinates = {{"x", "position", "x", "m", "kg m/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.parts.set(bindMechanics<double>(withParameters(settings, fields())));
    s.draw = [](const double* x, Drawing& drawing) {
        drawing.tracer = {x[0], 0, 0};
        drawing.shapes.push_back(Disc{drawing.tracer, 10});
    };
    s.phaseX = "q.x";
    s.phaseY = "p.x";
    s.trajectoryX = "t";
    s.trajectoryY = "q.x";
    return s;  // no exact solution and no symmetry: s.exact and s.momenta stay empty
}

}  // namespace

ModelEntry quartic_oscillator() {
    ModelEntry e;
    e.item = {
        "quartic-oscillator", "quartic oscillator", "A mass in a quartic well.", infos(fields()), {}, ""};
    e.exampleQ = {1};
    e.exampleP = {0};
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = make;
    return e;
}

}  // namespace extremal::systems
