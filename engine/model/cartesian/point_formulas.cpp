// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/point_formulas.hpp"

#include <algorithm>

#include "engine/core/text/text.hpp"

namespace extremal::cartesian {
namespace {

bool isWord(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '.';
    });
}

/// One term, or a product: nothing that a minus in front of it would not reach.
bool isTerm(const std::string& text) {
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (depth == 0 && (c == ' ' || c == '-')) return false;
    }
    return true;
}

}  // namespace

std::string textOf(const Amount& amount) {
    return amount.formula.empty() ? formatNumber(amount.value) : bracketed(amount.formula);
}

std::string bracketed(const std::string& formula) { return isWord(formula) ? formula : "(" + formula + ")"; }

std::string product(const std::string& factor, const std::string& formula) {
    if (factor == "0" || formula == "0") return "0";
    if (factor == "1") return formula;
    if (formula == "1") return factor;
    const bool isNegative = !factor.empty() && factor[0] == '-';
    return (isNegative ? "(" + factor + ")" : factor) + "*" +
           (isTerm(formula) ? formula : "(" + formula + ")");
}

std::string sum(const std::string& a, const std::string& b) {
    if (a == "0") return b;
    return b == "0" ? a : a + " + " + (b[0] == '-' ? "(" + b + ")" : b);
}

std::string difference(const std::string& a, const std::string& b) {
    if (b == "0") return a;
    const std::string taken = isTerm(b) ? b : "(" + b + ")";
    return (a == "0" ? "-" : a + " - ") + taken;
}

PointFormulas formulasOf(const Elements& elements, std::size_t point) {
    const PointElement& p = elements.points[point];
    if (p.isFixed) return {textOf(p.at.x), textOf(p.at.y), "0", "0", {}};
    if (!p.body) {
        const std::string x = "x_" + p.name, y = "y_" + p.name;
        return {x, y, x + "_t", y + "_t", {{x, "1", "0"}, {y, "0", "1"}}};
    }
    const std::string body = elements.bodies[*p.body].name, phi = "phi_" + body, X = "x_" + body,
                      Y = "y_" + body, a = textOf(p.at.x), b = textOf(p.at.y), c = "cos(" + phi + ")",
                      s = "sin(" + phi + ")";
    const std::string right = difference(product(a, c), product(b, s)),
                      up = sum(product(a, s), product(b, c));
    const std::string rate = phi + "_t", left = difference("0", up);
    return {sum(X, right),
            sum(Y, up),
            difference(X + "_t", product(rate, up)),
            sum(Y + "_t", product(rate, right)),
            {{X, "1", "0"}, {Y, "0", "1"}, {phi, left, right}}};
}

}  // namespace extremal::cartesian
