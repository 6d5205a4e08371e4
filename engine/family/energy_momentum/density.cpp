// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/energy_momentum/density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stop_token>

#include "engine/family/energy_momentum/element_step.hpp"
#include "engine/core/clock.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal {
namespace {

std::optional<DensitySample> sampleDensity(const Mechanics<double>& mechanics, ElementStep& element,
                                           int order, const State& at, double h) {
    StepReport report;
    const double *const q = at.x.data(), *const p = q + mechanics.dimension;
    double energies = 0, scale = 0;
    for (const double step : {h, -h}) {
        element.startAt(q, p);
        if (element.solve(at.t, step, {}, report) != Outcome::converged) return {};
        energies += element.discreteEnergy() / 2;
        scale = std::max(scale, element.energyScale());
    }
    constexpr double roundOff = 16 * std::numeric_limits<double>::epsilon();
    const double H = mechanics.energy(mechanics.model.get(), at.t, q, p);
    return DensitySample{at.t, actionErrorDensity(H, energies, h, order),
                         std::abs(actionErrorDensity(roundOff * scale, 0, h, order))};
}

}  // namespace

std::optional<SolvabilityForecast> forecastSolvability(const Mechanics<double>& mechanics,
                                                       const Table<double>& table, int order,
                                                       const State& start, double h, double end,
                                                       FollowUntil until) {
    constexpr double mostSteps = 2000, fewestSteps = 20, work = 4e7;  // unknowns cubed
    constexpr int finer = 2;
    const int degree = table.space.degree + finer, d = mechanics.dimension;
    const double steps = std::clamp(work / std::pow(degree * d, 3), fewestSteps, mostSteps);
    const SolverPolicy policy;
    ElementStep probe(mechanics, table, policy);
    ElementStep motion(
        mechanics,
        makeTable(polynomialSpace<double>(degree, PolynomialBasis::lobatto), gauss<double>(degree)), policy);
    SolvabilityForecast forecast;
    forecast.vanishes = true;
    State at = start;
    std::optional<DensitySample> before;
    const Clock clock{start.t, h};
    int samples = 0, insignificant = 0;
    for (long long k = 0; static_cast<double>(k) <= steps && at.t <= end; ++k) {
        const std::optional<DensitySample> now = sampleDensity(mechanics, probe, order, at, h);
        if (!now) break;
        forecast.until = at.t;
        ++samples;
        insignificant += !now->isSignificant();
        if (const double size = std::abs(now->density); size > forecast.largest) {
            forecast.largest = size;
            forecast.timeOfLargest = at.t;
        }
        if (k == 0) forecast.first = std::abs(now->density);
        if (now->isSignificant()) {
            forecast.vanishes = false;
            if (before && before->density * now->density < 0)
                forecast.signChanges.push_back(before->t + (now->t - before->t) * before->density /
                                                               (before->density - now->density));
            before = now;
        }
        if (until == FollowUntil::doubt && (insignificant > 0 || !forecast.signChanges.empty())) break;
        StepReport report;
        motion.startAt(at.x.data(), at.x.data() + d);
        if (motion.solve(at.t, h, {}, report) != Outcome::converged) break;
        for (int i = 0; i < d; ++i) {
            at.x[static_cast<std::size_t>(i)] += motion.positionChange(i);
            at.x[static_cast<std::size_t>(d + i)] += motion.momentumChange(i);
        }
        at.t = clock.at(k + 1);
    }
    if (samples == 0) return {};
    forecast.unresolved = static_cast<double>(insignificant) / samples;
    return forecast;
}

}  // namespace extremal
