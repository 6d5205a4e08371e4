// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/orbits/orbit_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;

constexpr int mostIterations = 40, mostHalvings = 12;
/// A gap that is the error of the scheme rather than a bad guess.
constexpr double nearlyClosed = 1e-3;
/// Corrections of this size change nothing but round-off.
constexpr double smallest = 1e-13;

/// Whether an iterate may be tried: periods that shrink or grow out of all proportion lead to equilibria, or
/// to homoclinic orbits.
bool isSensible(const OrbitGuess& next, const OrbitGuess& first) {
    const double part = next.period / first.period;
    return next.x.allFinite() && part > 0.2 && part < 5;
}

/// Whether the orbit found is one point, as an equilibrium is.
bool isAtRest(OrbitEquations& equations, const OrbitGuess& orbit) {
    std::vector<State> nodes;
    if (equations.follow(orbit, nodes) != Outcome::converged) return false;
    double farthest = 0;
    for (const State& node : nodes) {
        OrbitGuess there = orbit;
        there.x = Eigen::Map<const Vector>(node.x.data(), orbit.x.size());
        farthest = std::max(farthest, equations.between(orbit, there).cwiseAbs().maxCoeff());
    }
    return farthest < 1e-6;
}

OrbitSearch failed(OrbitSearch search, std::string problem, std::string remedy) {
    search.problem = std::move(problem);
    search.remedy = std::move(remedy);
    return search;
}

std::string gapText(const std::vector<double>& closes) {
    return formatNumber(*std::min_element(closes.begin(), closes.end()), 3);
}

/// The first of the places where distances from the start are least, with a fraction, among those that are
/// nearly the nearest; 0: there is none.
double firstReturn(const Vector& far) {
    const double farthest = far.maxCoeff();
    const Eigen::Index last = far.size() - 1;
    std::vector<Eigen::Index> minima;
    double least = farthest;
    bool hasLeft = false;
    for (Eigen::Index k = 1; k <= last; ++k) {
        hasLeft = hasLeft || far(k) > 0.3 * farthest;
        // The last one is where a scene of one period ends.
        const bool isLeast =
            far(k) <= far(k - 1) && (k < last ? far(k) < far(k + 1) : far(k) < 0.05 * farthest);
        if (!hasLeft || !isLeast) continue;
        minima.push_back(k);
        least = std::min(least, far(k));
    }
    const double enough = std::max(3 * least, 0.05 * farthest);
    const auto found =
        std::find_if(minima.begin(), minima.end(), [&](Eigen::Index k) { return far(k) <= enough; });
    if (found == minima.end()) return 0;
    const Eigen::Index k = *found;
    if (k == last) return static_cast<double>(k);
    // The least of the parabola through the squares of three distances.
    const double a = far(k - 1) * far(k - 1), b = far(k) * far(k), c = far(k + 1) * far(k + 1);
    const double bend = a - 2 * b + c;
    return static_cast<double>(k) + (bend > 0 ? std::clamp(0.5 * (a - c) / bend, -1.0, 1.0) : 0);
}

OrbitSearch notClosed(OrbitSearch search, const OrbitEquations& equations) {
    const std::string gap = gapText(search.closes);
    if (*std::min_element(search.closes.begin(), search.closes.end()) < nearlyClosed)
        return failed(
            std::move(search),
            "the motion closes to " + gap +
                " of its size and no nearer: an orbit of the equations need not be one of the scheme",
            "a smaller step or a higher degree for a smaller gap; or another start");
    if (equations.held() == OrbitHold::energy)
        return failed(std::move(search),
                      "no orbit of this energy was found: the motion closes to " + gap + " of its size",
                      "a start nearer to the orbit, another --energy, or the period held: --hold period");
    if (equations.held() == OrbitHold::period && equations.kind() == OrbitKind::conservative)
        return failed(std::move(search),
                      "no orbit of this period was found: the motion closes to " + gap + " of its size",
                      "another --period, or the energy held: --hold energy");
    return failed(std::move(search), "the motion closes to " + gap + " of its size only",
                  "a start nearer to the orbit, or a better --period");
}

}  // namespace

OrbitSearch findOrbit(OrbitEquations& equations, const OrbitGuess& guess, const std::stop_token& stop) {
    OrbitSearch search;
    equations.setStop(stop);
    OrbitEquations::Residual here, there;
    OrbitGuess at = guess;
    const auto fail = [&](Outcome outcome) {
        search.outcome = outcome;
        if (outcome == Outcome::refused)
            return failed(search,
                          "a step at t = " + formatNumber(equations.failedAt(), 4) + " has no tangent map",
                          "a start whose motion has no such step");
        return failed(search,
                      "a step at t = " + formatNumber(equations.failedAt(), 4) +
                          " fails: " + std::string(name(outcome)),
                      "a smaller step");
    };
    for (int iteration = 0; iteration < mostIterations; ++iteration) {
        if (const Outcome o = equations.evaluate(at, here, true); o != Outcome::converged) return fail(o);
        search.closes.push_back(here.gap);
        const Vector correction = leastCorrection(here.derivative, here.value);
        const double norm = here.value.norm();
        bool isBetter = false;
        OrbitGuess next;
        double part = 1;
        for (int k = 0; k < mostHalvings && !isBetter; ++k, part /= 2) {
            next = equations.moved(at, part * correction);
            if (!isSensible(next, guess)) continue;
            const Outcome o = equations.evaluate(next, there, false);
            if (o == Outcome::stopped) return fail(o);
            isBetter = o == Outcome::converged && there.value.norm() < norm;
        }
        const bool isDone = !isBetter || correction.cwiseAbs().maxCoeff() < smallest;
        if (isBetter) at = std::move(next);
        if (!isDone) continue;
        if (isBetter) {
            if (const Outcome o = equations.evaluate(at, here, true); o != Outcome::converged) return fail(o);
            search.closes.push_back(here.gap);
        }
        if (!(here.value.cwiseAbs().maxCoeff() < closedGap)) return notClosed(std::move(search), equations);
        if (isAtRest(equations, at))
            return failed(std::move(search), "the iteration ended at an equilibrium",
                          "a start farther from it, or another --energy or --period");
        search.orbit = equations.orbitAt(at, here, search.closes);
        return search;
    }
    return notClosed(std::move(search), equations);
}

OrbitGuess nearestReturn(const ResolvedScene& scene, std::size_t place, OrbitKind kind) {
    const ResolvedScheme& scheme = scene.schemes[place];
    const System& system = *systemOf(scene, scheme);
    const double h = signedStep(scene.scene, scheme.spec.step.value), start = scene.scene.start.value;
    constexpr long long mostSteps = 200'000;
    const long long steps = std::min(stepCount(start, scene.scene.end.value, std::abs(h)), mostSteps);
    State state = initialOf(scene, scheme);
    const auto integrator = scheme.make(system, h, state);
    integrator->begin(state);
    const Clock clock{start, h};
    const auto n = static_cast<Eigen::Index>(stateColumns(system).size());
    Eigen::MatrixXd all(n, steps + 1);
    Eigen::Index known = 0;
    for (long long k = 0; k <= steps; ++k) {
        if (k > 0 && integrator->advance(state, clock.at(k)).outcome != Outcome::converged) break;
        all.col(known++) = Eigen::Map<const Vector>(state.x.data(), n);
    }
    const Eigen::Index first = kind == OrbitKind::dissipative ? known / 2 : 0;
    const Eigen::MatrixXd nodes = all.middleCols(first, known - first);
    const Vector sizes = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).cwiseMax(1e-300);
    Vector far(nodes.cols());
    for (Eigen::Index k = 0; k < far.size(); ++k)
        far(k) = (nodes.col(k) - nodes.col(0)).cwiseQuotient(sizes).norm();
    const double found = firstReturn(far);
    if (found == 0)
        throw InvalidScene("--period",
                           "the motion of the scene does not come back towards its start until t = " +
                               formatNumber(clock.at(known - 1), 4),
                           "a longer /time/end, or a period to begin with: --period T");
    return {nodes.col(0), found * std::abs(h)};
}

}  // namespace extremal
