// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/quadrature/typed_rule.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/exact_number.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/quadrature/legendre.hpp"

namespace extremal {
namespace {

using Quad = boost::multiprecision::float128;

constexpr std::size_t mostNodes = 64;
/// Moments that are right to this were meant to be right.
constexpr double meant = 1e-3;

std::vector<Quad> valuesOf(const Settings& quadrature, const char* key) {
    std::vector<Quad> values;
    const Value* const given = quadrature.find(key);
    if (!given || !given->isArray()) return values;
    for (const Value& entry : given->asArray()) {
        const std::string pointer = std::string("/quadrature/") + key + "/" + std::to_string(values.size());
        values.push_back(exactNumber(entry, pointer, "\"(3-sqrt(3))/6\""));
    }
    return values;
}

std::string text(const Quad& x) { return formatNumber(static_cast<double>(x), 6); }

void checkNodes(const std::vector<Quad>& c) {
    if (c.empty() || c.size() > mostNodes)
        throw InvalidScene(
            "/quadrature/nodes",
            "must be 1 to " + std::to_string(mostNodes) + " nodes, got " + std::to_string(c.size()),
            "for example [\"(3-sqrt(3))/6\", \"(3+sqrt(3))/6\"]");
    for (std::size_t i = 0; i < c.size(); ++i) {
        const std::string pointer = "/quadrature/nodes/" + std::to_string(i);
        if (c[i] < 0 || c[i] > 1)
            throw InvalidScene(pointer, "must be in the step, from 0 to 1, got " + text(c[i]),
                               c[i] >= -1 ? "a rule on [-1,1]? (1+x)/2 for the nodes, half the weights" : "");
        if (i > 0 && !(c[i] > c[i - 1] + Quad(1e-14)))
            throw InvalidScene(pointer, "must be greater than the node before it, got " + text(c[i]),
                               "nodes are ascending and different, with their weights in the same order");
    }
}

/// P_0 to P_most at 2 c - 1.
std::vector<Quad> legendreValues(const Quad& c, std::size_t most) {
    const Quad x = 2 * c - 1;
    std::vector<Quad> P{Quad(1), x};
    for (std::size_t k = 1; k < most; ++k)
        P.push_back((Quad(2 * k + 1) * x * P[k] - Quad(k) * P[k - 1]) / Quad(k + 1));
    return P;
}

/// Weights that are exact for polynomials through all nodes: integrals of the cardinal ones.
std::vector<Quad> interpolatory(const std::vector<Quad>& c) {
    const Rule<Quad> inner = gauss<Quad>(static_cast<int>(c.size()) / 2 + 1);
    std::vector<Quad> b;
    for (std::size_t i = 0; i < c.size(); ++i) {
        Quad sum(0);
        for (std::size_t k = 0; k < inner.c.size(); ++k) {
            Quad cardinal(1);
            for (std::size_t l = 0; l < c.size(); ++l)
                if (l != i) cardinal *= (inner.c[k] - c[l]) / (c[i] - c[l]);
            sum += inner.b[k] * cardinal;
        }
        b.push_back(sum);
    }
    return b;
}

void checkWeights(const std::vector<Quad>& b, std::size_t nodes) {
    if (b.size() != nodes)
        throw InvalidScene("/quadrature/weights",
                           "must be one for each of the " + std::to_string(nodes) + " nodes, got " +
                               std::to_string(b.size()),
                           "leave them out for those of the polynomial through the nodes");
    Quad sum(0);
    for (const Quad& weight : b) sum += weight;
    const double off = std::abs(static_cast<double>(sum - 1));
    if (off > 1e-12)
        throw InvalidScene(
            "/quadrature/weights", "must sum to 1, got " + formatNumber(static_cast<double>(sum), 8),
            std::abs(static_cast<double>(sum) - 2) < 1e-6
                ? "a rule on [-1,1]? halve the weights, (1+x)/2 for the nodes"
                : "more digits, or leave them out for those of the polynomial through the nodes");
}

/// What an author of rounded numbers would have meant.
std::string formulaOf(const std::vector<Quad>& c) {
    const auto isNear = [&](std::size_t i, double value) {
        return std::abs(static_cast<double>(c[i]) - value) < meant;
    };
    if (c.size() == 2 && isNear(0, (3 - std::sqrt(3.0)) / 6)) return "write (3-sqrt(3))/6";
    if (c.size() == 3 && isNear(0, (5 - std::sqrt(15.0)) / 10)) return "write (5-sqrt(15))/10";
    return "more digits, or formulas";
}

}  // namespace

template <class T>
Rule<T> typedRule(const Settings& quadrature) {
    const std::vector<Quad> c = valuesOf(quadrature, "nodes");
    checkNodes(c);
    std::vector<Quad> b = valuesOf(quadrature, "weights");
    if (b.empty()) b = interpolatory(c);
    checkWeights(b, c.size());
    const std::size_t n = c.size(), most = 2 * n + 1;
    std::vector<Quad> moment(most + 1, Quad(0));
    for (std::size_t i = 0; i < n; ++i) {
        const std::vector<Quad> P = legendreValues(c[i], most);
        for (std::size_t k = 0; k <= most; ++k) moment[k] += b[i] * P[k];
    }
    const auto degreeTo = [&](double tolerance) {
        int degree = 0;
        while (degree + 1 <= static_cast<int>(most) &&
               abs(moment[static_cast<std::size_t>(degree) + 1]) < tolerance)
            ++degree;
        return degree;
    };
    Rule<T> rule;
    rule.degree = degreeTo(1e-13);
    const int wanted = degreeTo(meant);
    if (wanted > rule.degree) {
        Quad worst(0);
        for (int k = 1; k <= wanted; ++k)
            worst = std::max(worst, Quad(abs(moment[static_cast<std::size_t>(k)])));
        rule.caution = "has a rule of degree " + std::to_string(wanted) + " to " +
                       formatNumber(static_cast<double>(worst), 2) + " only, and of degree " +
                       std::to_string(rule.degree) + " to round-off: " + formulaOf(c);
    }
    rule.isSymmetric = true;
    for (std::size_t i = 0; i < n; ++i)
        rule.isSymmetric =
            rule.isSymmetric && abs(c[i] + c[n - 1 - i] - 1) < 1e-14 && abs(b[i] - b[n - 1 - i]) < 1e-14;
    for (std::size_t i = 0; i < n; ++i) {
        rule.c.push_back(static_cast<T>(c[i]));
        rule.b.push_back(static_cast<T>(b[i]));
    }
    if (rule.isSymmetric) symmetrise(rule);
    return rule;
}

template Rule<double> typedRule<double>(const Settings&);
template Rule<Quad> typedRule<Quad>(const Settings&);

}  // namespace extremal
