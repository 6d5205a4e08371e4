// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/orbits/arrivals.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/integrator/variation/motion_map.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// The product of the eigenvalues.
double determinantOf(const Matrix& A) { return dense::eigenvalues(A).prod().real(); }

Arrival arrivalOf(const ResolvedScene& scene, const ResolvedScheme& scheme, Vector x, const Vector& goal,
                  const std::stop_token& stop) {
    const Scene& given = scene.scene;
    const double step = std::abs(scheme.spec.step.value), length = given.initial.at->value;
    Arrival arrival{scheme.spec.label, std::llround(length / step), {}, {}, 0, Outcome::converged};
    if (arrival.steps < 1 ||
        std::abs(length / step - static_cast<double>(arrival.steps)) > 1e-9 * length / step)
        throw InvalidScene("/initial/at",
                           formatNumber(length) + " is not a whole number of the steps of \"" +
                               scheme.spec.label + "\", " + formatNumber(step),
                           "a multiple, or another --scheme");
    MotionMap map(scheme.make(*systemOf(scene, scheme), step, scene.initial), given.start.value,
                  arrival.steps);
    map.setStop(stop);
    arrival.outcome = arrive(map, x, length, goal, &arrival.misses);
    arrival.start.assign(x.data(), x.data() + x.size());
    if (arrival.outcome != Outcome::converged) return arrival;
    Vector image;
    Matrix M;
    arrival.outcome = map.apply(x, length, image, &M);
    if (arrival.outcome != Outcome::converged) return arrival;
    arrival.misses.push_back((image.head(goal.size()) - goal).norm());
    arrival.determinant = determinantOf(M.topRightCorner(goal.size(), goal.size()));
    return arrival;
}

}  // namespace

std::vector<Arrival> seekArrivals(const ResolvedScene& scene, const std::string& only,
                                  const std::vector<double>& momentum, const std::stop_token& stop) {
    if (scene.scene.initial.second != Initial::Second::position)
        throw InvalidScene("/initial", "has no second position",
                           "--set '/initial={\"q\": [..], \"q1\": [..], \"at\": T}'");
    const auto d = static_cast<Eigen::Index>(scene.system->coordinates.size());
    Vector x = Eigen::Map<const Vector>(scene.initial.x.data(), 2 * d), goal(d);
    if (!momentum.empty() && static_cast<Eigen::Index>(momentum.size()) != d)
        throw InvalidScene(
            "--guess", "must have " + std::to_string(d) + " momenta, got " + std::to_string(momentum.size()));
    for (Eigen::Index i = 0; i < d; ++i) {
        const auto place = static_cast<std::size_t>(i);
        goal(i) = scene.scene.initial.pOrV[place].value;
        if (!momentum.empty()) x(d + i) = momentum[place];
    }
    const std::size_t named = schemeNamed(scene, only);
    std::vector<Arrival> arrivals;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        const ResolvedScheme& scheme = scene.schemes[i];
        if (only.empty() ? !scheme.spec.isEnabled || !scheme.isFixed() : i != named) continue;
        if (!scheme.isFixed())
            throw InvalidScene("--scheme", "\"" + only + "\" has no given step", "a scheme with one");
        arrivals.push_back(arrivalOf(scene, scheme, x, goal, stop));
    }
    if (arrivals.empty())
        throw InvalidScene("--scheme", "no scheme of the scene has a given step", "a scheme with one");
    return arrivals;
}

StudyTable arrivalsTable(const ResolvedScene& scene, const std::vector<Arrival>& arrivals) {
    StudyTable table{
        "arrivals", {"label", "steps", "status", "cause", "miss", "newton_steps", "determinant"}, {}};
    for (const Quantity& entry : stateColumns(*scene.system)) table.columns.push_back(entry.name);
    for (const Arrival& each : arrivals) {
        const bool isDone = each.outcome == Outcome::converged;
        Value::Array row{each.scheme,
                         static_cast<double>(each.steps),
                         isDone ? "done" : "failed",
                         std::string(name(each.outcome)),
                         each.misses.empty() ? Value() : Value(each.misses.back()),
                         static_cast<double>(each.misses.size()) - 1,
                         isDone ? Value(each.determinant) : Value()};
        for (const double number : each.start) row.push_back(isDone ? Value(number) : Value());
        table.rows.push_back(std::move(row));
    }
    return table;
}

Value arrivalScene(const ResolvedScene& scene, const Arrival& arrival) {
    Value document = toValue(scene.scene);
    const auto numbers = [&](std::size_t from, std::size_t to) {
        Value::Array all;
        for (std::size_t i = from; i < to; ++i) all.emplace_back(arrival.start[i]);
        return all;
    };
    const std::size_t n = arrival.start.size();
    Value initial{Value::Object{}};
    initial.set("q", numbers(0, n / 2));
    initial.set("p", numbers(n / 2, n));
    document.set("initial", std::move(initial));
    return document;
}

}  // namespace extremal
