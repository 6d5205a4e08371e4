// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/search_cases.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/stability/stability.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostCases = 64;

[[noreturn]] void refuseText(const std::string& text) {
    throw InvalidScene("--over",
                       "must be POINTER=VALUE,VALUE,.. or POINTER=FROM:TO:N[:log], got \"" + text + "\"",
                       "for example /initial/q/0=0.5,1,1.5");
}

std::vector<double> listOf(const std::string& text, std::size_t begin) {
    std::vector<double> values;
    for (std::size_t at = begin; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        const auto value = parseNumber(text.substr(at, comma - at));
        if (!value || !std::isfinite(*value)) refuseText(text);
        values.push_back(*value);
        at = comma + 1;
    }
    return values;
}

double excessFree(const PointResult& result, std::size_t metric) {
    const double value = result.errorIn(metric);
    return result.isDone() && std::isfinite(value) ? value : HUGE_VAL;
}

}  // namespace

OverCases parseCases(const std::string& over, const std::string& of) {
    if (!of.empty() && of != "worst" && of != "median")
        throw InvalidScene("--of", "must be worst or median, got \"" + of + "\"");
    if (!of.empty() && over.empty())
        throw InvalidScene("--of", "needs --over", "for example --over /initial/q/0=0.5,1,1.5");
    if (over.empty()) return {};
    const std::size_t equals = over.find('=');
    if (equals == std::string::npos || equals == 0) refuseText(over);
    OverCases cases;
    cases.pointer = over.substr(0, equals);
    cases.values = over.find(':', equals) != std::string::npos ? parseAxis(over, "--over").values()
                                                               : listOf(over, equals + 1);
    cases.isMedian = of == "median";
    if (cases.values.size() < 2 || cases.values.size() > mostCases)
        throw InvalidScene("--over", "takes 2 to " + std::to_string(mostCases) + " values, got " +
                                         std::to_string(cases.values.size()));
    return cases;
}

std::string textOf(const OverCases& cases) {
    std::string text;
    for (const double value : cases.values) text += (text.empty() ? "" : ",") + formatNumber(value);
    return cases.isGiven() ? cases.pointer + '=' + text : text;
}

std::vector<std::shared_ptr<const ResolvedScene>> scenesOf(const ResolvedScene& scene,
                                                           const OverCases& cases) {
    std::vector<std::shared_ptr<const ResolvedScene>> scenes;
    bool isChanged = false;
    const Value document = toValue(scene.scene);
    for (const double value : cases.values) {
        const ReadScene read = readScene(document, {{cases.pointer, value}});
        if (!read.errors.empty() || !read.resolved) {
            const auto own = std::find_if(read.errors.begin(), read.errors.end(),
                                          [](const Problem& p) { return !p.origin.empty(); });
            const Problem& p = own != read.errors.end() ? *own : read.errors.front();
            throw InvalidScene("--over", cases.pointer + "=" + formatNumber(value) + " " + p.message, p.hint);
        }
        auto made = std::make_shared<ResolvedScene>(*read.resolved);
        isChanged = isChanged || made->initial.x != scene.initial.x ||
                    made->scene.model != scene.scene.model || made->scene.end.value != scene.scene.end.value;
        for (std::size_t i = made->schemes.size(); i < scene.schemes.size(); ++i) {
            made->scene.schemes.push_back(scene.schemes[i].spec);
            made->schemes.push_back(resolve(scene.schemes[i].spec, made->system.get()));
            resolveSystem(made->schemes.back(), made->scene);
        }
        scenes.push_back(std::move(made));
    }
    if (!isChanged)
        throw InvalidScene("--over", cases.pointer + " changes neither the model nor the start nor the end",
                           "a number of the model, or of the initial data");
    return scenes;
}

PointResult combined(const std::vector<PointResult>& results, bool isMedian) {
    // The case in whose first metric the answer is.
    std::vector<std::size_t> order(results.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return excessFree(results[a], 0) < excessFree(results[b], 0);
    });
    const std::size_t place = isMedian ? (order.size() - 1) / 2 : order.size() - 1;
    PointResult all = results[order[place]];
    double seconds = 0;
    Cost cost;
    const auto n = static_cast<double>(results.size());
    for (const PointResult& each : results) {
        seconds += each.cpuSeconds / n;
        cost.evaluations += each.cost.evaluations;
        cost.iterations += each.cost.iterations;
        cost.linearSolves += each.cost.linearSolves;
        cost.rejected += each.cost.rejected;
    }
    const auto count = static_cast<long long>(results.size());
    cost.evaluations /= count;
    cost.iterations /= count;
    cost.linearSolves /= count;
    cost.rejected /= count;
    all.cost = cost;
    all.cpuSeconds = seconds;
    for (std::size_t m = 0; m < all.errors.size(); ++m) {
        std::vector<double> values;
        for (const PointResult& each : results) values.push_back(excessFree(each, m));
        std::sort(values.begin(), values.end());
        all.errors[m] = values[place];
    }
    if (!all.errors.empty()) all.error = all.errors.front();
    return all;
}

}  // namespace extremal
