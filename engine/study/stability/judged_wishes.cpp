// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/judged_wishes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

/// Below it errors say nothing: what the reference claims of itself, and, where a method of another kind
/// parts from it by more than a thousandth of the motion, the bound that the two give.
double floorBy(const SearchReference& reference, const Metric& metric) {
    constexpr double part = 1e-3;
    if (!metric.needsReference()) return 0;
    const double own = reference.info().estimatedError;
    double floor = 0;
    if (std::isfinite(own)) floor = metric.combined(std::vector<double>(metric.terms.size(), own));
    if (const Confirmation confirmed = reference.confirmed(metric);
        confirmed && confirmed.bound() > part * metric.size())
        floor = std::max(floor, confirmed.bound());
    return floor;
}

}  // namespace

std::vector<Metric> metricsOf(const std::vector<Wish>& wishes, const std::string& metric, bool isAtEnd,
                              const ResolvedScene& scene) {
    std::vector<Metric> all;
    for (const Wish& wish : wishes) {
        if (!(std::isfinite(wish.value) && wish.value >= 0))
            throw InvalidScene("--wish", "must be positive and finite, got " + formatNumber(wish.value));
        all.push_back(metricOf(wish.metric, isAtEnd, *scene.system, scene.initial));
    }
    if (all.empty()) all.push_back(metricOf(metric, isAtEnd, *scene.system, scene.initial));
    for (const Metric& each : all)
        if (each.needsReference() && scene.scene.reference.kind == ReferenceSpec::Kind::none)
            throw InvalidScene("/reference", "errors need a reference, and the scene has none",
                               "\"auto\", or --metric energy");
    return all;
}

JudgedWishes::JudgedWishes(const ResolvedScene& scene, std::vector<Metric> given,
                           const std::vector<Wish>& wishes, const std::stop_token& stop)
    : metrics(std::move(given)) {
    constexpr double usualPart = 1e-3;
    if (std::any_of(metrics.begin(), metrics.end(), [](const Metric& m) { return m.needsReference(); }))
        reference = SearchReference(scene, metrics, stop);
    if (stop.stop_requested()) return;
    for (std::size_t i = 0; i < metrics.size(); ++i) {
        metrics[i] = reference.sized(metrics[i], scene);
        JudgedValue value;
        value.size = metrics[i].size();
        value.wish = i < wishes.size() ? wishes[i].value : 0;
        if (value.wish == 0) value.wish = std::isfinite(value.size) ? usualPart * value.size : usualPart;
        value.floor = floorBy(reference, metrics[i]);
        values.push_back(value);
    }
}

Judgement JudgedWishes::of(RunStatus status, Outcome cause, const std::vector<double>& measured) const {
    std::vector<JudgedValue> all = values;
    for (std::size_t i = 0; i < all.size(); ++i) all[i].value = measured[i];
    return judge(status, cause, all);
}

}  // namespace extremal
