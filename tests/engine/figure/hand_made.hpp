// SPDX-License-Identifier: GPL-3.0-or-later
/// A comparison written by hand, so that figures can be tested without an integrator: a pendulum of four
/// schemes, one that gains energy, one that fails.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"

namespace extremal::handmade {

inline System pendulum() {
    System s;
    s.id = "pendulum";
    s.coordinates = {{"theta", "angle", "θ", "rad", "kg m²/s"}};
    s.timeUnit = "s";
    s.energyUnit = "J";
    s.phaseX = "q.theta";
    s.phaseY = "p.theta";
    s.trajectoryX = "t";
    s.trajectoryY = "q.theta";
    return s;
}

inline System kepler() {
    System s;
    s.id = "kepler";
    s.coordinates = {{"x", "abscissa", "x", "", ""}, {"y", "ordinate", "y", "", ""}};
    s.momenta = {{"z", "L", "", {}}};
    s.phaseX = "q.x";
    s.phaseY = "p.x";
    s.trajectoryX = "q.x";
    s.trajectoryY = "q.y";
    s.hasPlanarTrajectory = true;
    return s;
}

/// Energy error `amplitude` * |sin|, growing by `growth` per unit time; it ends at `end`.
inline std::shared_ptr<const SchemeResult> scheme(std::string label, int style, double amplitude,
                                                  double growth, double end, int rows = 1001) {
    auto result = std::make_shared<SchemeResult>();
    result->spec.label = std::move(label);
    result->spec.step.value = 0.01 * (style + 1);
    result->style = style;
    result->fraction = 1;
    std::vector<Column> columns = {
        {"t", "t", "s", {}},      {"q.theta", "θ", "rad", {}},           {"p.theta", "p", "kg m²/s", {}},
        {"energy", "H", "J", {}}, {"energy_error", "H - H(0)", "J", {}}, {"error", "q - q ref", "rad", {}}};
    for (int i = 0; i < rows; ++i) {
        const double t = end * i / (rows - 1), phase = 2 * std::numbers::pi * t / 2.1;
        const double e = amplitude * (std::sin(3 * phase) + growth * t);
        columns[0].values.push_back(t);
        columns[1].values.push_back(std::cos(phase + 30 * amplitude * t));
        columns[2].values.push_back(-3 * std::sin(phase + 30 * amplitude * t));
        columns[3].values.push_back(-4 + e);
        columns[4].values.push_back(e);
        columns[5].values.push_back(amplitude * t * (1.1 + std::sin(phase)));
    }
    result->trajectory.columns = std::move(columns);
    result->summary.label = result->spec.label;
    result->summary.status = RunStatus::done;
    result->summary.tEnd = end;
    result->summary.cpuSeconds = 1e-3 * (style + 1);
    result->summary.maxError = amplitude * end;
    result->summary.maxEnergyError = amplitude;
    return result;
}

inline Comparison comparison() {
    Comparison c;
    c.scene.title = "Pendulum";
    c.scene.model.type = "pendulum";
    c.scene.end.value = 10;
    c.scene.observe = {"energy", "error"};
    c.schemes = {scheme("multiscale R2", 0, 2e-7, 0, 10), scheme("Gauss 4", 1, 1e-4, 0, 10),
                 scheme("midpoint", 2, 1e-3, 0, 10), scheme("RK4", 3, 1e-3, 9, 10)};
    auto failed = std::make_shared<SchemeResult>(*scheme("Störmer-Verlet", 4, 1e-2, 0, 0.31, 32));
    Trajectory& run = failed->trajectory;
    for (std::size_t i = 0; i < run.rows(); ++i)
        run.columns[4].values[i] *= std::pow(10.0, static_cast<double>(i));
    run.columns[4].values.back() = std::numeric_limits<double>::infinity();
    failed->summary.status = RunStatus::failed;
    failed->summary.cause = Outcome::notFinite;
    failed->summary.failedAt = 0.31;
    c.schemes.push_back(failed);
    c.reference = {"computed", 3e-12, "Gauss(12), h = 0.01"};
    c.isFinished = true;
    return c;
}

}  // namespace extremal::handmade
