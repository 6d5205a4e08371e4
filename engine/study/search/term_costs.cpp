// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/term_costs.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/clock.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/family.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/sensitivities.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/typed_scene.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostTerms = 24;

/// States at the nodes, and columns of derivatives behind each of them.
struct Nodes {
    std::size_t width = 0;
    std::vector<double> values;
    std::size_t count() const { return values.size() / width; }
    const double* at(std::size_t i) const { return values.data() + i * width; }
};

std::optional<Nodes> march(const ReadScene& read, bool isVaried, const std::stop_token& stop) {
    if (!read.resolved) return {};
    const ResolvedScene& scene = *read.resolved;
    const ResolvedScheme& scheme = scene.schemes.front();
    const double h = scheme.spec.step.value;
    try {
        auto integrator = scheme.make(*scene.system, h, scene.initial);
        const std::size_t own = integrator->quantities().size();
        if (isVaried)
            integrator = measuringSensitivities(std::move(integrator), scene, scheme, h, scene.initial);
        if (isVaried && integrator->quantities().size() == own) return {};
        integrator->setStop(stop);
        State state = scene.initial;
        integrator->begin(state);
        std::vector<double> said(integrator->quantities().size());
        Nodes nodes;
        nodes.width = state.x.size() + (isVaried ? said.size() - own : 0);
        const Clock clock{state.t, h};
        const long long steps = stepCount(state.t, scene.scene.end.value, h);
        for (long long k = 1; k <= steps; ++k) {
            if (integrator->advance(state, clock.at(k)).outcome != Outcome::converged) return {};
            if (isVaried) integrator->measure(state, said.data());
            nodes.values.insert(nodes.values.end(), state.x.begin(), state.x.end());
            if (isVaried)
                nodes.values.insert(nodes.values.end(), said.begin() + static_cast<std::ptrdiff_t>(own),
                                    said.end());
        }
        return nodes;
    } catch (const InvalidScene&) {
        return {};
    }
}

/// A metric of pairs of states.
class Compared {
public:
    Compared(const System& system, const State& start, Metric metric, const Nodes& nodes)
        : measure_(errorMeasure(system, start)),
          metric_(std::move(metric)),
          values_(measure_.columns.size()),
          terms_(metric_.terms.size()) {
        for (MetricTerm& term : metric_.terms)
            for (std::size_t i = 0; i < nodes.count() && term.size; ++i)
                term.own = std::max(term.own, term.size(start.t, nodes.at(i)));
    }
    double operator()(const double* x, const double* reference) {
        measure_.evaluate(x, reference, values_.data());
        for (std::size_t i = 0; i < terms_.size(); ++i) terms_[i] = values_[metric_.terms[i].index];
        return metric_.combined(terms_);
    }

private:
    ErrorMeasure measure_;
    Metric metric_;
    std::vector<double> values_, terms_;
};

bool isOfErrors(const Metric& metric) {
    return std::all_of(metric.terms.begin(), metric.terms.end(),
                       [](const MetricTerm& t) { return t.observable && t.observable->item.id == "error"; });
}

/// The scene as formulas with one scheme, which resolves it; null where that takes too long.
Value preparedScene(const ResolvedScene& scene) {
    constexpr double mostSteps = 2e4, fewest = 50;
    Value document = scene.scene.model.type == "lagrangian" ? toValue(scene.scene) : typedScene(scene);
    const double length = timeSpan(scene.scene).length(),
                 steps = std::max(fewest, std::ceil(length * highestFrequency(*scene.system, scene.initial)));
    if (!(steps <= mostSteps)) return {};
    Value scheme(
        Value::Object{{"label", "resolved"}, {"scheme", "galerkin-gauss-6"}, {"step", length / steps}});
    document.set("schemes", Value(Value::Array{std::move(scheme)}));
    document.set("views", Value(Value::Array{}));
    document.set("events", Value(Value::Array{}));
    document.set("reference", Value(Value::Object{{"type", "none"}}));
    return document;
}

}  // namespace

std::vector<std::string> summandsOf(const std::string& formula) {
    std::vector<std::string> all(1);
    int depth = 0;
    char before = '(';  // the last character that is not a blank
    for (std::size_t i = 0; i < formula.size(); ++i) {
        const char c = formula[i];
        if (c == '(' || c == '[') ++depth;
        if (c == ')' || c == ']') --depth;
        // 1e-3: the sign of an exponent, behind a number.
        const bool isExponent =
            (before == 'e' || before == 'E') && i >= 2 &&
            (std::isdigit(static_cast<unsigned char>(formula[i - 2])) || formula[i - 2] == '.');
        const bool isSign = (c == '+' || c == '-') && depth == 0 && !isExponent &&
                            std::string("+-*/^(,").find(before) == std::string::npos;
        if (isSign) all.emplace_back();
        const bool isBehindSign = c == ' ' && all.back() == "-";
        if ((!isSign || c == '-') && !isBehindSign) all.back() += c;
        if (c != ' ') before = c;
    }
    for (std::string& each : all) {
        each.erase(0, each.find_first_not_of(' '));
        each.erase(each.find_last_not_of(' ') + 1);
    }
    std::erase(all, "");
    return all;
}

std::vector<TermCost> termCosts(const ResolvedScene& scene, const Metric& metric,
                                const std::stop_token& stop) {
    if (!isOfErrors(metric) || isBackwards(scene.scene)) return {};
    try {
        Value document = preparedScene(scene);
        Value* const lagrangian = document.isObject() ? document.find("model")->find("lagrangian") : nullptr;
        if (!lagrangian) return {};
        std::vector<TermCost> costs;
        std::vector<std::string> names;
        if (lagrangian->isString()) {
            Value terms{Value::Object{}};
            for (const std::string& summand : summandsOf(lagrangian->asString())) {
                names.push_back("term" + std::to_string(names.size() + 1));
                terms.set(names.back(), summand);
                costs.push_back({summand});
            }
            *lagrangian = std::move(terms);
        } else {
            for (const auto& [name, text] : lagrangian->asObject()) {
                names.push_back(name);
                costs.push_back({name});
            }
        }
        if (names.size() < 2 || names.size() > mostTerms) return {};
        Value::Array pointers;
        for (const std::string& name : names) pointers.emplace_back(childPointer("/model/lagrangian", name));
        Value varied = document;
        varied.set("observe", Value(Value::Array{"sensitivity"}));
        varied.set("sensitivity", Value(std::move(pointers)));
        document.set("observe", Value(Value::Array{}));
        const auto motion = march(readScene(varied), true, stop);
        if (!motion) return {};
        const std::size_t n = scene.initial.x.size();
        Compared compared(*scene.system, scene.initial, metric, *motion);
        std::vector<double> moved(n);
        for (std::size_t term = 0; term < names.size(); ++term) {
            for (std::size_t i = 0; i < motion->count(); ++i) {
                const double *const x = motion->at(i), *const column = x + n * (term + 1);
                for (std::size_t k = 0; k < n; ++k) moved[k] = x[k] + column[k];
                costs[term].firstOrder = std::max(costs[term].firstOrder, compared(moved.data(), x));
            }
            Value without = document;
            without.find("model")->find("lagrangian")->set(names[term], "0");
            const auto other = march(readScene(without), false, stop);
            if (!other || other->count() != motion->count()) continue;
            costs[term].measured = 0;
            for (std::size_t i = 0; i < motion->count(); ++i)
                costs[term].measured = std::max(costs[term].measured, compared(other->at(i), motion->at(i)));
        }
        std::stable_sort(costs.begin(), costs.end(),
                         [](const TermCost& a, const TermCost& b) { return a.firstOrder < b.firstOrder; });
        return costs;
    } catch (const InvalidScene&) {
        return {};  // no formula
    }
}

}  // namespace extremal
