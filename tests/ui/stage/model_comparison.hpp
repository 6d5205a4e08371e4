// SPDX-License-Identifier: GPL-3.0-or-later
/// Comparisons of the program's own models, made from formulas instead of runs, so that pictures of them
/// depend on nothing but the drawing.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/group/so3.hpp"
#include "engine/model/system.hpp"
#include "engine/run/comparison.hpp"

namespace extremal::fake {

/// The state of scheme number k at time t.
using Motion = std::function<std::vector<double>(int k, double t)>;

struct Film {
    std::string title;
    Settings model;
    double end = 10, spacing = 0.01;
    std::vector<std::string> labels;
    double failsAt = 1e300;  ///< the last scheme fails here
    Motion motion;
};

inline std::shared_ptr<Comparison> comparison(const Film& film) {
    auto result = std::make_shared<Comparison>();
    result->scene.title = film.title;
    result->scene.model = film.model;
    result->scene.end = {film.end, ""};
    result->scene.observe = {"energy"};
    result->isFinished = true;
    const System system = findModel(film.model.type)->make(film.model);
    const std::vector<Quantity> state = stateColumns(system);
    const int rows = static_cast<int>(std::lround(film.end / film.spacing));
    for (int k = 0; k < static_cast<int>(film.labels.size()); ++k) {
        auto scheme = std::make_shared<SchemeResult>();
        scheme->style = k;
        scheme->fraction = 1;
        scheme->spec.label = scheme->summary.label = film.labels[static_cast<std::size_t>(k)];
        scheme->summary.status = RunStatus::done;
        auto& columns = scheme->trajectory.columns;
        columns.push_back({"t", "t", system.timeUnit, {}});
        for (const Quantity& q : state) columns.push_back({q.name, q.symbol, q.unit, {}});
        columns.push_back({"energy", "H", system.energyUnit, {}});
        columns.push_back({"energy_error", "H − H(0)", system.energyUnit, {}});
        for (int row = 0; row <= rows; ++row) {
            const double t = row * film.spacing;
            if (k + 1 == static_cast<int>(film.labels.size()) && t > film.failsAt) {
                scheme->summary.status = RunStatus::failed;
                scheme->summary.cause = Outcome::diverged;
                scheme->summary.failedAt = film.failsAt;
                break;
            }
            const std::vector<double> x = film.motion(k, t);
            columns[0].values.push_back(t);
            for (std::size_t c = 0; c < x.size(); ++c) columns[c + 1].values.push_back(x[c]);
            const std::size_t energy = 1 + state.size();
            columns[energy].values.push_back(1);
            columns[energy + 1].values.push_back(1e-4 * std::pow(0.1, k) * std::sin(3 * t + k));
        }
        scheme->summary.tEnd = columns[0].values.back();
        result->schemes.push_back(std::move(scheme));
    }
    return result;
}

inline Settings settings(const std::string& type, Value::Object keys) { return {type, std::move(keys), {}}; }

inline Film springPendulum() {
    Film film;
    film.title = "Planar pendulum with a stiff spring";
    film.model = settings("spring-pendulum", {{"m", 1.0}, {"g", 9.81}, {"l", 1.0}, {"k", 1000.0}});
    film.labels = {"Galerkin 4", "midpoint", "RK4", "Störmer–Verlet"};
    film.failsAt = 4;
    film.spacing = 0.01;
    film.motion = [](int k, double t) {
        const double fast = 31.6 * t + 0.9 * k, slow = 3.0 * t + 0.05 * k;
        return std::vector<double>{0.02 * std::cos(fast), std::cos(slow), -0.02 * 31.6 * std::sin(fast),
                                   -3 * std::sin(slow)};
    };
    return film;
}

inline Film pendulum() {
    Film film;
    film.title = "Pendulum";
    film.model = settings("pendulum", {{"m", 1.0}, {"l", 1.0}, {"g", 9.81}});
    film.labels = {"midpoint", "RK4"};
    film.motion = [](int k, double t) {
        return std::vector<double>{1.2 * std::cos(3 * t + 0.2 * k), -3.6 * std::sin(3 * t + 0.2 * k)};
    };
    return film;
}

/// Circles and ellipses that are not solutions, but look like them.
inline Film kepler() {
    Film film;
    film.title = "Kepler problem";
    film.model = settings("kepler", {{"mu", 1.0}});
    film.labels = {"Gauss 2", "Störmer–Verlet", "RK4"};
    film.end = 20;
    film.spacing = 0.02;
    film.motion = [](int k, double t) {
        const double turn = 0.35 * k, a = std::cos(t - 0.1 * k) - 0.6, b = 0.8 * std::sin(t - 0.1 * k);
        const double u = -std::sin(t - 0.1 * k), v = 0.8 * std::cos(t - 0.1 * k);
        const double c = std::cos(turn), s = std::sin(turn);
        return std::vector<double>{c * a - s * b, s * a + c * b, c * u - s * v, s * u + c * v};
    };
    return film;
}

inline Film oscillator() {
    Film film;
    film.title = "Harmonic oscillator";
    film.model = settings("harmonic-oscillator", {{"m", 1.0}, {"k", 1.0}});
    film.labels = {"midpoint", "symplectic Euler"};
    film.motion = [](int k, double t) {
        return std::vector<double>{std::cos(t - 0.3 * k), -std::sin(t - 0.3 * k)};
    };
    return film;
}

/// A body that tumbles about an axis which itself turns; the second scheme lags behind.
inline Film freeBody() {
    Film film;
    film.title = "Free rigid body";
    film.model = settings("rigid-body", {{"inertia", Value::Array{1.0, 2.0, 3.0}}});
    film.labels = {"Lie Gauss 4", "Moser-Veselov"};
    film.motion = [](int k, double t) {
        using Vector = so3::Vector<double>;
        const double s = t - 0.25 * k;
        const auto q = so3::product(so3::quaternionExp(Vector(0, 0.3, 0.5 * s)),
                                    so3::quaternionExp(Vector(0.4 * std::cos(s), 0.4 * std::sin(s), 0.2)));
        const Vector pi(0.3, 0.2, 1), Pi = so3::matrix(q).transpose() * pi;
        return std::vector<double>{q(0), q(1), q(2), q(3), Pi(0), Pi(1), Pi(2), pi(0), pi(1), pi(2)};
    };
    return film;
}
/// A top that precesses, and nods as it does.
inline Film heavyTop() {
    Film film = freeBody();
    film.title = "Heavy top";
    film.model = settings(
        "heavy-top",
        {{"inertia", Value::Array{1.0, 1.0, 0.5}}, {"weight", 1.0}, {"centre", Value::Array{0.0, 0.0, 1.0}}});
    film.labels = {"Lie Gauss 4"};
    film.motion = [](int, double t) {
        using Vector = so3::Vector<double>;
        const auto q =
            so3::product(so3::quaternionExp(Vector(0, 0, 0.6 * t)),
                         so3::product(so3::quaternionExp(Vector(0.7 + 0.1 * std::cos(4 * t), 0, 0)),
                                      so3::quaternionExp(Vector(0, 0, 5 * t))));
        const Vector pi(0.2, 0.1, 2), Pi = so3::matrix(q).transpose() * pi;
        return std::vector<double>{q(0), q(1), q(2), q(3), Pi(0), Pi(1), Pi(2), pi(0), pi(1), pi(2)};
    };
    return film;
}

}  // namespace extremal::fake
