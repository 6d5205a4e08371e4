// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of tensor elements over rectangles, for tests.
#pragma once

#include <QTest>

#include <random>
#include <vector>

#include "engine/family/scheme.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/reader.hpp"
#include "tests/engine/family/field/fields.hpp"
#include "tests/engine/family/spectral_field/component_fields.hpp"

namespace extremal::plane_tents {
using namespace fields;
using component_fields::plane;
using component_fields::problemOf;
using component_fields::Side;

using Row = std::vector<double>;

inline Settings gaussOf(int nodes) { return rule("gauss", nodes); }
inline Settings lobattoOf(int nodes) { return rule("lobatto", nodes); }

/// Another rule along y.
inline Discretization withAcross(Discretization d, const Settings& rule) {
    d.quadrature.keys.emplace_back(acrossPart, settingsValue(rule));
    return d;
}

inline State run(const System& system, const Discretization& d, State state, double step, int steps) {
    const auto integrator = makeIntegrator(system, d, {state.t, step});
    for (int k = 0; k < steps; ++k)
        if (advance(*integrator, state).outcome != Outcome::converged) qFatal("a step failed");
    return state;
}

inline State random(const System& system, double size, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    State start;
    for (std::size_t i = 0; i < 2 * problemOf(system).size(); ++i) start.x.push_back(uniform(generator));
    return start;
}

}  // namespace extremal::plane_tents
