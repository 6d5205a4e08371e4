// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/orbits/manifold.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/study/orbits/orbit_search.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Index = Eigen::Index;

constexpr double nearest = 1e-5;      // eps, over the size of the motion
constexpr double leastGrowth = 1.01;  // of a revolution: below it the manifold is not seen
constexpr double mostRevolutions = 200;

[[noreturn]] void refuseManifold(const std::string& message, const std::string& remedy) {
    throw InvalidScene("--manifold", message, remedy);
}

/// The columns of the section as places in the state.
struct Places {
    Index x, y, at;
};
Places placesOf(const ViewPlane& section, const System& system) {
    const std::vector<Quantity> columns = stateColumns(system);
    const auto place = [&](const std::string& name) {
        for (std::size_t i = 0; i < columns.size(); ++i)
            if (columns[i].name == name) return static_cast<Index>(i);
        refuseManifold("is drawn in a section of columns of the state, and \"" + name + "\" is not one",
                       "a section of " + columns.front().name + " = 0");
    };
    return {place(section.x), place(section.y), place(section.at)};
}

/// The state moved along the flow to where its entry `at` is zero, to first order.
Vector ontoSection(const Vector& x, const Vector& f, Index at) { return x - f * (x(at) / f(at)); }

Vector rateAt(const OrbitEquations& equations, const Vector& x) {
    Vector f = Vector::Zero(x.size());
    if (!rateOf(equations.system(), equations.start(), x.data(), f.data()))
        refuseManifold("needs the equations of motion at the orbit, which have no solution there",
                       "another orbit");
    return f;
}

/// The same orbit with its start in the section, where it passes upwards.
PeriodicOrbit startingIn(OrbitEquations& equations, const PeriodicOrbit& orbit, const ViewPlane& section,
                         Index at, const std::stop_token& stop) {
    std::vector<State> nodes;
    if (equations.follow(guessOf(orbit), nodes) != Outcome::converged)
        refuseManifold("needs a motion along the orbit, which fails", "a smaller step");
    double size = 0;
    for (const State& node : nodes) size = std::max(size, std::abs(node.x[static_cast<std::size_t>(at)]));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double here = nodes[k].x[static_cast<std::size_t>(at)];
        const double next = nodes[(k + 1) % nodes.size()].x[static_cast<std::size_t>(at)];
        const bool isOn = std::abs(here) < 1e-9 * size;
        if (!isOn && !(here < 0 && next >= 0)) continue;
        const Vector x = Eigen::Map<const Vector>(nodes[k].x.data(), static_cast<Index>(nodes[k].x.size()));
        const Vector f = rateAt(equations, x);
        if (!(f(at) > 0)) continue;
        const OrbitGuess guess{ontoSection(x, f, at), orbit.period};
        equations.measure(guess);
        const OrbitSearch search = findOrbit(equations, guess, stop);
        if (search.orbit) return *search.orbit;
    }
    refuseManifold("the orbit does not pass " + section.at + " = 0 upwards",
                   "a section that it passes: {\"view\": \"section\", \"at\": ...}");
}

struct Direction {
    double multiplier;
    Vector v;
};
Direction directionOf(const Eigen::MatrixXd& M, bool isUnstable) {
    const Eigen::VectorXcd all = dense::eigenvalues(M);
    std::complex<double> chosen = 1;
    for (const std::complex<double>& each : all) {
        const bool isFarther =
            isUnstable ? std::abs(each) > std::abs(chosen) : std::abs(each) < std::abs(chosen);
        if (isFarther) chosen = each;
    }
    const double growth = isUnstable ? std::abs(chosen) : 1 / std::abs(chosen);
    if (!(growth > leastGrowth))
        refuseManifold("the orbit has none: no multiplier is " +
                           std::string(isUnstable ? "larger than 1.01" : "smaller than 1/1.01"),
                       "an unstable orbit, say of another energy: --energy, or --follow to find one");
    if (std::abs(chosen.imag()) > 1e-6 * std::abs(chosen))
        refuseManifold("its multiplier is " + formatNumber(chosen.real(), 4) + " ± " +
                           formatNumber(std::abs(chosen.imag()), 4) +
                           "i: such a manifold is no curve in a section",
                       "an orbit with a real multiplier");
    const double lambda = chosen.real();
    const Eigen::MatrixXd shifted = M - lambda * Eigen::MatrixXd::Identity(M.rows(), M.cols());
    return {lambda, dense::rightSingular(shifted).V.col(M.cols() - 1)};
}

}  // namespace

Manifold manifoldOf(std::shared_ptr<const ResolvedScene> scene, std::size_t scheme, long long steps,
                    const PeriodicOrbit& orbit, const ViewPlane& section, const std::string& name, int count,
                    const std::stop_token& stop) {
    if (name != "unstable" && name != "stable")
        refuseManifold("must be unstable or stable, got \"" + name + "\"", "unstable");
    OrbitEquations equations(std::move(scene), scheme, steps);
    if (equations.kind() != OrbitKind::conservative)
        refuseManifold("is found where an energy is kept: a section needs it for the momentum",
                       "a conservative system");
    const Places at = placesOf(section, equations.system());
    equations.hold(OrbitHold::energy, orbit.energy);
    const PeriodicOrbit here = startingIn(equations, orbit, section, at.at, stop);
    const OrbitGuess start = guessOf(here);
    OrbitEquations::Residual residual;
    if (equations.evaluate(start, residual, true) != Outcome::converged ||
        residual.M.rows() != start.x.size())
        refuseManifold("is found for coordinates without constraints", "coordinates that are free");
    const auto [lambda, v] = directionOf(residual.M, name == "unstable");
    const Vector f = rateAt(equations, start.x), z = ontoSection(start.x, f, at.at),
                 along = ontoSection(v, f, at.at);
    const double length = std::hypot(along(at.x), along(at.y)), growth = std::abs(std::log(std::abs(lambda)));
    if (!(length > 1e-9 * v.norm()))
        refuseManifold("its direction is not seen in this section", "another section");
    const double size = std::max(z.cwiseAbs().maxCoeff(), 1e-300), first = nearest * size / length;
    Manifold made{lambda, {}, 0};
    const int half = std::max(1, count / 2);
    for (int k = 0; k < half; ++k)
        for (const double sign : {1.0, -1.0}) {
            const double s = sign * first * std::exp(growth * k / half);
            made.starts.emplace_back(z(at.x) + s * along(at.x), z(at.y) + s * along(at.y));
        }
    const double revolutions = std::ceil(-std::log(nearest) / growth) + 4;
    made.time = std::min(revolutions, mostRevolutions) * here.period;
    return made;
}

}  // namespace extremal
