// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/mechanism_start.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/model/parts/wall.hpp"

namespace extremal {
namespace {

/// A change of a coordinate below this is what rounding a typed number makes.
constexpr double byRounding = 1e-6;
/// Constraints whose gradients are this close to dependent, in the metric of the mass.
constexpr double dependent = 1e-6;

std::string placesText(const System& system, const std::vector<double>& q) {
    std::string text;
    for (std::size_t i = 0; i < q.size() && i < 6; ++i)
        text += (i ? ", " : "") + system.coordinates[i].name + " = " + formatNumber(q[i], 9);
    return text + (q.size() > 6 ? ", ..." : "");
}

/// The constraint that is missed most, and by how much.
std::pair<std::string, double> worstMiss(const Constraint& g, double t, const double* q, std::size_t d) {
    const auto n = static_cast<std::size_t>(g.count());
    std::vector<double> value(n), byPlace(n * d), byTime(n);
    g.first(g.model.get(), t, q, value.data(), byPlace.data(), byTime.data());
    std::size_t worst = 0;
    for (std::size_t k = 1; k < n; ++k)
        if (std::abs(value[k]) > std::abs(value[worst])) worst = k;
    return {g.names[worst], value[worst]};
}

/// Whether a constraint, by its place among them, is missed where all others hold.
bool isMissedAlone(const Constraint& g, const State& state, std::size_t d, int which) {
    constexpr double holds = 1e-6;
    const auto n = static_cast<std::size_t>(g.count());
    std::vector<double> value(n), byPlace(n * d), byTime(n);
    g.first(g.model.get(), state.t, state.x.data(), value.data(), byPlace.data(), byTime.data());
    for (std::size_t k = 0; k < n; ++k)
        if ((std::abs(value[k]) > holds) != (static_cast<int>(k) == which)) return false;
    return true;
}

/// Constraints and rolling conditions that leave a motion, and do not repeat each other at the state.
void requireIndependent(Mechanism& mechanism, const State& state) {
    const int d = mechanism.dimension(), n = mechanism.constraints();
    const char* const what = mechanism.rolling() ? " conditions" : " constraints";
    const bool isDriven = mechanism.constraint() && mechanism.constraint()->isTimeDependent;
    if (n >= d && !isDriven)
        throw InvalidScene(mechanism.constraint() ? "/model/constraints" : "/model/rolling",
                           "has " + std::to_string(n) + what + " for " + std::to_string(d) +
                               (d == 1 ? " coordinate" : " coordinates") + ", so that nothing can move",
                           "fewer" + std::string(what) + ", or more coordinates");
    const Mechanism::Rank rank = mechanism.rank(state.t, state.x.data());
    if (rank.ratio > dependent || rank.dependent < 0) return;
    if (rank.dependent < mechanism.holonomic() &&
        isMissedAlone(*mechanism.constraint(), state, static_cast<std::size_t>(d), rank.dependent))
        throw InvalidScene(
            "/model/constraints/" + mechanism.nameOf(rank.dependent),
            "is not met at the initial data, where the others are, and forbids the same motions: "
            "it contradicts them",
            "leave it out, or one of the others");
    throw InvalidScene(
        (rank.dependent < mechanism.holonomic() ? "/model/constraints/" : "/model/rolling/") +
            mechanism.nameOf(rank.dependent),
        n == 1
            ? "has a gradient of 0 at the initial data"
            : "depends on the other" + std::string(what) + " at the initial data: it allows the same motions",
        n == 1 ? "a formula whose gradient is not 0 where it holds (no squares), or another start"
               : "leave it out, or start elsewhere");
}

void moveOntoConstraints(const System& system, Mechanism& mechanism, State& state, bool movesFar) {
    const auto d = static_cast<std::size_t>(system.dimension());
    std::vector<double> q(state.x.begin(), state.x.begin() + static_cast<std::ptrdiff_t>(d));
    const auto [name, miss] = worstMiss(*mechanism.constraint(), state.t, q.data(), d);
    if (!std::isfinite(miss))
        throw InvalidScene("/model/constraints/" + name, "is not finite at the initial data");
    const bool isFound = mechanism.projectPlace(state.t, q.data());
    double change = 0;
    for (std::size_t i = 0; i < d; ++i)
        change = std::max(change, std::abs(q[i] - state.x[i]) / std::max(1.0, std::abs(q[i])));
    if (!isFound)
        throw InvalidScene("/initial/q",
                           "misses the constraint " + name + " by " + formatNumber(miss, 3) +
                               ", and no places near it meet all constraints",
                           "places that do");
    if (change > byRounding && !movesFar)
        throw InvalidScene("/initial/q", "misses the constraint " + name + " by " + formatNumber(miss, 3),
                           "\"project\": true in initial moves it to " + placesText(system, q));
    std::copy(q.begin(), q.end(), state.x.begin());
}

}  // namespace

void putOnConstraints(const System& system, State& state, bool movesFar) {
    if (!system.parts.find<Constraint>() && !system.parts.find<Rolling>()) return;
    const auto d = static_cast<std::size_t>(system.dimension());
    Mechanism mechanism(system.parts);
    requireIndependent(mechanism, state);
    if (mechanism.constraint()) moveOntoConstraints(system, mechanism, state, movesFar);
    Eigen::VectorXd v, kappa;
    if (!mechanism.project(state.t, state.x.data(), state.x.data() + d, v, kappa))
        throw InvalidScene("/initial", "has momenta that no velocity on the constraints belongs to");
}

void requireOutsideWalls(const System& system, const State& state) {
    const Wall* const wall = system.parts.find<Wall>();
    if (!wall) return;
    const auto n = static_cast<std::size_t>(wall->count()), d = static_cast<std::size_t>(system.dimension());
    std::vector<double> gap(n), byPlace(n * d), byTime(n);
    wall->first(wall->model.get(), state.t, state.x.data(), gap.data(), byPlace.data(), byTime.data());
    for (std::size_t k = 0; k < n; ++k) {
        const double terms = Wall::terms(byPlace.data() + k * d, state.x.data(), system.dimension());
        if (!std::isfinite(gap[k]))
            throw InvalidScene("/model/walls/" + wall->names[k], "is not finite at the initial data");
        if (gap[k] < -Wall::rounding * terms)
            throw InvalidScene(
                "/initial/q",
                "is inside the wall " + wall->names[k] + ": its gap is " + formatNumber(gap[k], 3) + " there",
                "places where it is positive; with the other sign the wall has its other side");
    }
}

std::string projectionNote(const System& system, const State& given, const State& projected) {
    if (!system.parts.find<Constraint>() && !system.parts.find<Rolling>()) return {};
    const auto d = static_cast<std::size_t>(system.dimension());
    double size = 0, change = 0;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < d; ++i) {
        size = std::max(size, std::abs(given.x[d + i]));
        const double own = std::abs(projected.x[d + i] - given.x[d + i]);
        if (own > change) {
            change = own;
            worst = i;
        }
    }
    if (!(change > byRounding * std::max(1.0, size))) return {};
    return "has a velocity that the constraints do not allow: p." + system.coordinates[worst].name +
           " becomes " + formatNumber(projected.x[d + worst], 6) + " in place of " +
           formatNumber(given.x[d + worst], 6);
}

}  // namespace extremal
