// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/gauge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>

#include "engine/core/text/text.hpp"
#include "engine/model/typed/phase/graph_text.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal::typed {
namespace {

constexpr std::size_t mostForAllHalves = 8;
constexpr std::array<int, 6> integralNodes{1, 2, 3, 5, 8, 12};  // the first that is exact
constexpr double equalForms = 1e-11;                            // of the largest entry of Om

using Names = std::vector<std::string>;
using Parameters = std::vector<std::pair<std::string, double>>;
using Form = std::vector<std::optional<TypedFunction>>;

/// theta with its derivatives as graphs, and the variables that it has.
class GivenForm {
public:
    GivenForm(const Names& names, const Parameters& parameters, const Names& theta)
        : names_(names), texts_(theta) {
        for (const std::string& text : theta) {
            Formula formula;
            formula.coordinates = names;
            formula.parameters = parameters;
            formula.isExpanded = true;
            formula.text = text;
            formulas_.push_back(formula);
            derivatives_.push_back(differentiate(formula));
        }
        symbols_.assign(static_cast<std::size_t>(formulas_.front().firstParameter()), "0");
        std::copy(names.begin(), names.end(), symbols_.begin());
        for (const auto& [name, value] : parameters) symbols_.push_back(name);
    }

    /// P_j as a text, with y* = `origin` in each variable.
    std::string momentum(std::size_t j, const std::vector<int>& free, double origin,
                         const Rule<double>& rule) const {
        const std::string from = formatNumber(origin);
        std::string text = "(" + texts_[j] + ")";
        for (std::size_t k = 0; k < rule.b.size(); ++k) {
            Names there = symbols_;
            for (const int l : free) {
                const std::string& name = names_[static_cast<std::size_t>(l)];
                there[static_cast<std::size_t>(l)] =
                    "(" + from + "+" + formatNumber(rule.c[k]) + "*(" + name + "-" + from + "))";
            }
            for (const int l : free) {
                const SymbolicLagrangian& of = *derivatives_[static_cast<std::size_t>(l)];
                if (of.graph.isZero(of.gradient[j])) continue;
                text += "-" + formatNumber(rule.b[k]) + "*(" + names_[static_cast<std::size_t>(l)] + "-" +
                        from + ")*" + textOf(of.graph, of.gradient[j], there);
            }
        }
        return text;
    }
    TypedFunction compiled(std::size_t j, const std::string& text) const {
        Formula formula = formulas_[j];
        formula.text = text;
        return TypedFunction(formula);
    }

private:
    const Names &names_, &texts_;
    std::vector<Formula> formulas_;
    std::vector<std::shared_ptr<const SymbolicLagrangian>> derivatives_;
    Names symbols_;
};

/// Om at x, entry (i, j) at i m + j.
std::vector<double> formAt(const Form& theta, const double* x) {
    const std::size_t m = theta.size();
    std::vector<double> slope(m), om(m * m, 0);
    for (std::size_t j = 0; j < m; ++j) {
        if (!theta[j]) continue;
        double value = 0;
        theta[j]->evaluate(x, &value, slope.data(), nullptr);
        for (std::size_t i = 0; i < m; ++i) {
            om[i * m + j] += slope[i];
            om[j * m + i] -= slope[i];
        }
    }
    return om;
}

/// States near to the origin and far from it, at which two forms are compared.
std::vector<std::vector<double>> testStates(std::size_t m) {
    std::mt19937 random(1905);
    std::vector<std::vector<double>> states;
    for (const double size : {0.3, 1.0, 3.0, 10.0})
        for (int k = 0; k < 3; ++k) {
            std::vector<double> x(m);
            for (double& v : x) v = size * (static_cast<double>(random()) / 4294967296.0 - 0.3);
            states.push_back(std::move(x));
        }
    return states;
}

double largestOf(const std::vector<double>& values) {
    double most = 0;
    for (const double v : values) most = std::isnan(v) ? v : std::max(most, std::abs(v));
    return most;
}

/// Whether Om_yy is 0 wherever Om is finite.
bool isLagrangian(const Form& theta, const std::vector<int>& free) {
    const std::size_t m = theta.size();
    for (const std::vector<double>& x : testStates(m)) {
        const std::vector<double> om = formAt(theta, x.data());
        const double allowed = equalForms * largestOf(om);
        if (!std::isfinite(allowed)) continue;
        for (const int i : free)
            for (const int j : free)
                if (std::abs(om[static_cast<std::size_t>(i) * m + static_cast<std::size_t>(j)]) > allowed)
                    return false;
    }
    return true;
}

/// Whether both have the same Om wherever both are finite, which is at half of the states or more.
bool isSame(const Form& a, const Form& b) {
    int compared = 0, all = 0;
    for (const std::vector<double>& x : testStates(a.size())) {
        ++all;
        const std::vector<double> first = formAt(a, x.data()), second = formAt(b, x.data());
        const double allowed = equalForms * largestOf(first);
        if (!std::isfinite(allowed) || !std::isfinite(largestOf(second))) continue;
        ++compared;
        for (std::size_t k = 0; k < first.size(); ++k)
            if (std::abs(first[k] - second[k]) > allowed) return false;
    }
    return 2 * compared >= all;
}

Gauged gaugedWith(const GivenForm& given, const std::vector<int>& free, double origin, int nodes) {
    const Rule<double> rule = gauss<double>(nodes);
    const std::size_t m = 2 * free.size();
    Gauged made;
    made.free = free;
    made.theta.resize(m);
    for (std::size_t j = 0; j < m; ++j) {
        if (std::find(free.begin(), free.end(), static_cast<int>(j)) != free.end()) continue;
        made.places.push_back(static_cast<int>(j));
        made.theta[j].emplace(given.compiled(j, given.momentum(j, free, origin, rule)));
    }
    return made;
}

std::optional<Gauged> gaugedFrom(const GivenForm& given, const Form& original, const std::vector<int>& free) {
    for (const double origin : {0.0, 1.0})  // log(y) is not finite at 0
        for (const int nodes : integralNodes)
            if (Gauged made = gaugedWith(given, free, origin, nodes); isSame(original, made.theta))
                return made;
    return {};
}

}  // namespace

std::optional<Gauged> gaugedForm(const Names& names, const Parameters& parameters, const Names& texts,
                                 const Form& theta) {
    const std::size_t m = names.size();
    if (m > mostForAllHalves) return {};
    try {
        const GivenForm given(names, parameters, texts);
        std::vector<bool> isFree(m, false);
        std::fill(isFree.begin() + static_cast<std::ptrdiff_t>(m / 2), isFree.end(), true);
        do {
            std::vector<int> free;
            for (std::size_t i = 0; i < m; ++i)
                if (isFree[i]) free.push_back(static_cast<int>(i));
            if (!isLagrangian(theta, free)) continue;
            if (auto made = gaugedFrom(given, theta, free)) return made;
        } while (std::next_permutation(isFree.begin(), isFree.end()));
    } catch (const ExpressionError&) {
        // a derivative that has no text, or too long a one: the form stays as it was typed
    }
    return {};
}

}  // namespace extremal::typed
