// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/ladder.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/study/stability/values_between.hpp"

namespace extremal {
namespace {

constexpr double fewestSteps = 4, mostSteps = 2e5;

void requirePositive(double value, const char* option) {
    if (!(std::isfinite(value) && value > 0))
        throw InvalidScene(option, "must be positive and finite, got " + formatNumber(value));
}

std::vector<double> wanted(const LadderSpec& spec) {
    for (const double step : spec.steps) requirePositive(step, "--steps");
    if (!spec.steps.empty()) return spec.steps;
    requirePositive(spec.from, "--from");
    requirePositive(spec.to, "--to");
    if (spec.points < 1 || spec.points > 1000)
        throw InvalidScene("--points", "must be 1 to 1000, got " + std::to_string(spec.points));
    return valuesBetween(spec.from, spec.to, spec.points, true);
}

std::vector<double> tolerances() {
    std::vector<double> all;
    for (int digits = 3; digits <= 13; ++digits) all.push_back(std::pow(10.0, -digits));
    return all;
}

}  // namespace

bool hasStepOfItsSpace(const ResolvedScene& scene, const ResolvedScheme& scheme) {
    const auto* const own = scheme.family ? scheme.family->parts.find<StepOfSpace>() : nullptr;
    if (!own) return false;
    const auto anyValue = [](std::string_view) { return std::optional(1.0); };
    const auto implied = own->implied(scheme.discretization.space, scene.scene.model, anyValue);
    return implied && implied->isOfSpace;
}

std::vector<double> ladderOf(const LadderSpec& spec, const ResolvedScene& scene, const ResolvedScheme& scheme,
                             bool isMeshRefined) {
    const bool isGiven = !spec.steps.empty() || spec.points > 0 || spec.from != 0 || spec.to != 0;
    std::vector<double> all;
    if (hasStepOfItsSpace(scene, scheme)) {
        all = {scheme.spec.step.value};
    } else if (scheme.isAdaptive()) {
        all = tolerances();
    } else {
        const double length = scene.scene.end.value - scene.scene.start.value;
        const double own = scheme.spec.step.value;
        const std::vector<double> steps = isGiven         ? wanted(spec)
                                          : isMeshRefined ? valuesBetween(8 * own, own / 4, 6, true)
                                                          : valuesBetween(8 * own, own / 128, 11, true);
        for (const double step : steps) {
            const double n = std::max(1.0, std::round(length / step));
            const bool isInside = n >= fewestSteps && n <= std::max(mostSteps, length / own * (1 + 1e-9));
            if (isGiven || isInside) all.push_back(length / n);
        }
    }
    std::sort(all.begin(), all.end(), std::greater<>());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace extremal
