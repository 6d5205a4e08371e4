// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparisons made by hand, without integrating anything: curves that are known, drawn as a pendulum on a
/// spring.
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"

namespace extremal::fake {

/// theta'' = -omega^2 theta with omega = 2, drawn as a spring pendulum of length 1; state (theta, p).
inline System swing() {
    System s;
    s.id = "swing";
    s.coordinates = {{"theta", "angle", "θ", "rad", ""}};
    s.timeUnit = "s";
    Mechanical mechanics;
    mechanics.dimension = 1;
    mechanics.flow = [](const void*, const double&, const double* q, const double* p, double* v, double* f) {
        v[0] = p[0];
        f[0] = -4 * q[0];
        return true;
    };
    s.parts.set(mechanics);
    s.draw = [](const double* x, Drawing& drawing) {
        const Point bob{std::sin(x[0]), -std::cos(x[0]), 0};
        drawing.shapes.push_back(Support{{0, 0, 0}, 0.5});
        drawing.shapes.push_back(Spring{{0, 0, 0}, bob, 14});
        drawing.shapes.push_back(Disc{bob, 9});
        drawing.tracer = bob;
    };
    return s;
}

/// Amplitude and phase of one scheme, and how densely it is sampled.
struct Curve {
    std::string label;
    double amplitude = 1, phase = 0, spacing = 0.02, end = 10;
    double failsAt = std::numeric_limits<double>::infinity();  ///< from here on theta grows without bound
};

inline std::shared_ptr<const SchemeResult> result(const Curve& curve, int style) {
    auto r = std::make_shared<SchemeResult>();
    r->style = style;
    r->spec.label = r->summary.label = curve.label;
    r->summary.status = RunStatus::done;
    r->fraction = 1;
    r->trajectory.columns = {{"t", "t", "s", {}}, {"q.theta", "θ", "rad", {}}, {"p.theta", "p", "", {}}};
    const int rows = static_cast<int>(std::lround(curve.end / curve.spacing));
    for (int k = 0; k <= rows; ++k) {
        const double t = k * curve.spacing, angle = 2 * t + curve.phase;
        if (t > curve.failsAt) {
            r->summary.status = RunStatus::failed;
            r->summary.cause = Outcome::diverged;
            r->summary.failedAt = curve.failsAt;
            break;
        }
        r->trajectory.columns[0].values.push_back(t);
        r->trajectory.columns[1].values.push_back(curve.amplitude * std::cos(angle));
        r->trajectory.columns[2].values.push_back(-2 * curve.amplitude * std::sin(angle));
    }
    return r;
}

inline std::shared_ptr<const Comparison> comparisonOf(const std::vector<Curve>& curves) {
    auto c = std::make_shared<Comparison>();
    c->scene.title = "Swing";
    c->isFinished = true;
    for (std::size_t i = 0; i < curves.size(); ++i)
        c->schemes.push_back(result(curves[i], static_cast<int>(i)));
    return c;
}

}  // namespace extremal::fake
