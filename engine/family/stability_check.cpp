// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/stability_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/tables.hpp"
#include "engine/family/table_of.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/integrator/oscillator_step.hpp"

namespace extremal {
namespace {

double stepsOf(const SchemeCase& scheme, double step) {
    return std::abs(scheme.end - scheme.initial.t) / step;
}

/// "pi", "2 pi": the multiple of pi that the interval lies at; else the value itself.
std::string resonanceName(double z, const UnstableInterval& interval) {
    const double multiple = std::round(z / std::numbers::pi), at = multiple * std::numbers::pi;
    const double distance = std::max({interval.low - at, at - interval.high, 0.0});
    if (multiple < 1 || distance > 0.01) return formatNumber(z, 4);
    return multiple == 1 ? "pi" : formatNumber(multiple) + " pi";
}

/// Largest growth x steps of all frequencies with a step.
double harmOf(const SchemeCase& scheme, const std::vector<double>& frequencies,
              const LinearStabilityFacts& stability, double step) {
    double worst = 0;
    for (const double w : frequencies) worst = std::max(worst, stability.growth(w * step));
    return worst * stepsOf(scheme, step);
}

/// A shorter step with which no frequency grows within the run: three digits, below `step`.
double harmlessStep(const SchemeCase& scheme, const std::vector<double>& frequencies,
                    const LinearStabilityFacts& stability, double step) {
    for (const double factor : {0.99, 0.97, 0.95, 0.9, 0.85, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3}) {
        const double unit = std::pow(10.0, std::floor(std::log10(factor * step)) - 2);
        const double shorter = std::floor(factor * step / unit) * unit;
        if (harmOf(scheme, frequencies, stability, shorter) <= 1) return shorter;
    }
    return 0;
}

std::string betweenText(const UnstableInterval& interval) {
    return formatNumber(interval.low, 8) + " to " + formatNumber(interval.high, 8);
}

/// Bounded intervals below the limit that would matter in the run as well.
std::string harmfulIntervals(const LinearStabilityFacts& stability, double steps, double limit) {
    std::string text;
    for (const UnstableInterval& i : stability.intervals)
        if (i.isBounded() && i.high <= limit && i.growth * steps > 1)
            text += ", and not from " + betweenText(i);
    return text;
}

void warnOfLimit(const SchemeCase& scheme, double frequency, const UnstableInterval& last,
                 const LinearStabilityFacts& stability, const std::vector<double>& frequencies,
                 Findings& findings) {
    const double shorter = harmlessStep(scheme, frequencies, stability, last.low / frequency);
    findings.warning("/step",
                     formatNumber(scheme.step) + " is beyond the linear stability limit " +
                         formatNumber(last.low / frequency, 3) + ": step times frequency may be at most " +
                         formatNumber(last.low, 3) +
                         harmfulIntervals(stability, stepsOf(scheme, scheme.step), last.low) +
                         ", and the highest frequency at the start is " + formatNumber(frequency, 3),
                     shorter > 0 ? "a step of " + formatNumber(shorter, 3) + ", or another scheme"
                                 : "a smaller step, or another scheme",
                     {}, "stability-limit");
}

/// Whether the space with its automatic rule is stable for every step.
bool isStableWithItsRule(Discretization discretization) {
    const Family* const family = familyOf(discretization.space);
    if (!family) return false;
    try {
        discretization.quadrature = family->completeRule(discretization.space, {});
        return hasTable(discretization) && tableStability(discretization)->intervals.empty();
    } catch (const InvalidScene&) {
        return false;
    }
}

void warnOfResonance(const SchemeCase& scheme, double frequency, const LinearStabilityFacts& stability,
                     const std::vector<double>& frequencies, Findings& findings) {
    const double z = frequency * scheme.step, growth = stability.growth(z);
    const UnstableInterval& interval = *stability.at(z);
    const double shorter = harmlessStep(scheme, frequencies, stability, scheme.step);
    const std::string size = std::isfinite(growth)
                                 ? "growth " + formatNumber(growth, 2) + " a step, e^" +
                                       formatNumber(growth * stepsOf(scheme, scheme.step), 2) + " in this run"
                                 : "the equations of a step are singular";
    findings.warning(
        "/step",
        "resonance at h omega = " + resonanceName(z, interval) + ": " + size +
            " (omega = " + formatNumber(frequency, 6) + "; the step is unstable for h omega from " +
            betweenText(interval) + ")",
        (shorter > 0 ? "a step of " + formatNumber(shorter, 3) : std::string("another step")) +
            (isStableWithItsRule(scheme.discretization)
                 ? ", or the rule that the space has where none is given, which has no such interval"
                 : ""),
        {}, "stability-limit");
}

}  // namespace

const UnstableInterval* LinearStabilityFacts::at(double z) const {
    for (const UnstableInterval& i : intervals)
        if (z > i.low && z < i.high) return &i;
    return nullptr;
}

double LinearStabilityFacts::growth(double z) const {
    const UnstableInterval* const interval = at(z);
    if (!interval) return 0;
    return interval->isBounded() && growthWithin ? growthWithin(z) : std::numeric_limits<double>::infinity();
}

LinearStabilityFacts factsOf(OscillatorStep step) {
    LinearStabilityFacts facts;
    facts.intervals = step.intervals();
    facts.growthWithin = [step = std::move(step)](double z) { return step.growth(z); };
    return facts;
}

OscillatorStep tableStep(const Discretization& discretization) {
    const auto& [space, quadrature, solver, impact] = discretization;
    if (const auto* const tables = familyPart<Tables>(space); tables && tables->oscillator) try {
            return tables->oscillator(space, quadrature);
        } catch (const InvalidScene&) {
            // A space of one's own, in double precision alone.
        }
    return OscillatorStep(oscillatorAction(tableOf(space, quadrature)));
}

std::shared_ptr<const LinearStabilityFacts> tableStability(const Discretization& discretization) {
    using Key = std::pair<Settings, Settings>;
    static MemoCache<Key, std::shared_ptr<const LinearStabilityFacts>> known(512);
    return known.get(Key{discretization.space, discretization.quadrature}, [&] {
        constexpr int mostForAll = 24;  // unknowns of a step whose edges are all computed
        const Table<double> table = tableOf(discretization.space, discretization.quadrature);
        if (table.unknowns() > mostForAll) {
            LinearStabilityFacts facts;
            constexpr double unbounded = std::numeric_limits<double>::infinity();
            const double limit = scannedStabilityLimit(table);
            if (std::isfinite(limit)) facts.intervals = {{limit, unbounded, unbounded}};
            return std::make_shared<const LinearStabilityFacts>(std::move(facts));
        }
        return std::make_shared<const LinearStabilityFacts>(factsOf(tableStep(discretization)));
    });
}

void checkLinearStability(const SchemeCase& scheme, const std::vector<double>& frequencies,
                          const LinearStabilityFacts& stability, Findings& findings) {
    double highest = 0, resonant = 0, harm = 1;
    for (const double w : frequencies) {
        const UnstableInterval* const interval = stability.at(w * scheme.step);
        if (!interval) continue;
        if (!interval->isBounded()) {
            highest = std::max(highest, w);
            continue;
        }
        const double own = stability.growth(w * scheme.step) * stepsOf(scheme, scheme.step);
        if (own > harm) {
            harm = own;
            resonant = w;
        }
    }
    if (highest > 0)
        warnOfLimit(scheme, highest, *stability.at(highest * scheme.step), stability, frequencies, findings);
    else if (resonant > 0)
        warnOfResonance(scheme, resonant, stability, frequencies, findings);
}

std::string intervalsText(const std::vector<UnstableInterval>& intervals) {
    std::string text;
    for (const UnstableInterval& i : intervals) {
        if (!text.empty()) text += ", ";
        if (!i.isBounded()) {
            text += "beyond " + formatNumber(i.low, 8);
            continue;
        }
        text += betweenText(i);
        text += std::isfinite(i.growth) ? " (growth at most " + formatNumber(i.growth, 2) + " per step)"
                                        : " (growth without bound)";
    }
    return text;
}

}  // namespace extremal
