// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields with typed densities for their tests.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/baseline/implicit_cells.hpp"
#include "engine/model/density/places.hpp"
#include "engine/model/density/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal::densities {

inline constexpr double pi = std::numbers::pi;

struct DensityCase {
    Value lagrangian;
    std::vector<std::string> names = {"u"};
    Value::Object parameters = {};
    double left = 0, length = 2 * pi;
    int cells = 16;
    std::string boundary = "periodic";
    /// Of the plane; cells 0: an interval.
    double below = 0, height = 2 * pi;
    int cellsY = 0;
    Value places = {};  ///< of the components by name
};

/// The settings of the model with every key.
inline Settings settingsOf(const DensityCase& c) {
    Value::Array names;
    for (const std::string& name : c.names) names.emplace_back(name);
    Settings model{c.cellsY > 0 ? "field-2d" : "field",
                   {{"wave_speed", 1.0},
                    {"components", std::move(names)},
                    {"potential", "none"},
                    {"mass", 1.0},
                    {"lagrangian", c.lagrangian},
                    {"parameters", Value(c.parameters)},
                    {"places", c.places},
                    {"domain", Value::Array{c.left, c.left + c.length}},
                    {"cells", static_cast<double>(c.cells)}},
                   {}};
    if (c.cellsY > 0) {
        model.keys.emplace_back("domain_y", Value::Array{c.below, c.below + c.height});
        model.keys.emplace_back("cells_y", static_cast<double>(c.cellsY));
    } else {
        model.keys.emplace_back("boundary", c.boundary);
        model.keys.emplace_back("a", "1");
        model.keys.emplace_back("epsilon", 0.05);
    }
    return model;
}

inline System systemOf(const DensityCase& c) {
    const Settings model = settingsOf(c);
    return findModel(model.type)->make(model);
}

/// The field with this density, of the usual kind or not.
inline std::shared_ptr<const DensityProblem> problemOf(const DensityCase& c) {
    DensityProblem p{c.names, FieldDensity(settingsOf(c), c.names, c.cellsY > 0 ? 2 : 1)};
    p.along = {c.left, c.length};
    p.cellsX = c.cells;
    if (c.cellsY > 0) {
        p.across = {c.below, c.height};
        p.cellsY = c.cellsY;
    }
    p.boundary = boundaryNamed(c.boundary);
    readPlaces(settingsOf(c), p);
    return std::make_shared<const DensityProblem>(std::move(p));
}

/// Gauss 2 in space, midpoint in time: what implicit-cells is by itself.
inline std::unique_ptr<Integrator> cellsOf(const std::shared_ptr<const DensityProblem>& problem,
                                           double step) {
    return makeImplicitCells(problem, gauss<double>(2), gauss<double>(1), step);
}

inline State stateOf(const System& system, const Value::Object& initial, double t = 0) {
    State s;
    s.t = t;
    s.x = system.start({"", initial, {}}, t);
    return s;
}

/// False where a step fails.
inline bool go(Integrator& integrator, State& state, int steps) {
    for (int i = 0; i < steps; ++i)
        if (advance(integrator, state).outcome != Outcome::converged) return false;
    return true;
}

/// The largest distance of the halves of two states: of u, of u_t.
struct Distance {
    double u = 0, v = 0;
};
inline Distance distance(const std::vector<double>& x, const std::vector<double>& y) {
    Distance d;
    const std::size_t n = x.size() / 2;
    for (std::size_t i = 0; i < n; ++i) {
        d.u = std::max(d.u, std::abs(x[i] - y[i]));
        d.v = std::max(d.v, std::abs(x[n + i] - y[n + i]));
    }
    return d;
}

}  // namespace extremal::densities
