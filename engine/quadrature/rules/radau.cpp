// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss-Radau: one end is a node. On [-1, 1] from the left the nodes are -1 and the roots of
/// (P_{n-1} + P_n) / (1 + x), with weights 2/n^2 and (1 - x) / (n P_{n-1}(x))^2.
#include <algorithm>

#include "engine/quadrature/legendre.hpp"
#include "engine/quadrature/rule_maker.hpp"

namespace extremal::rules {
namespace {

template <class T>
Rule<T> radauRule(int n, bool isRight) {
    using std::cos;
    using W = Wide<T>;
    Rule<T> rule;
    rule.degree = 2 * n - 2;
    appendNode(rule, W(-1), W(W(2) / (n * n)));
    for (int i = 1; i < n; ++i) {
        const W x = newtonRoot(W(-cos(pi<W>() * 2 * i / (2 * n - 1))), [n](const W& y) {
            const Legendre<W> l(n, y), k(n - 1, y);
            const W f = (l.p + k.p) / (1 + y);
            return std::pair(f, W((l.derivative + k.derivative - f) / (1 + y)));
        });
        const W p = Legendre<W>(n - 1, x).p;
        appendNode(rule, x, W((1 - x) / (n * n * p * p)));
    }
    if (isRight) {
        std::reverse(rule.c.begin(), rule.c.end());
        std::reverse(rule.b.begin(), rule.b.end());
        for (T& c : rule.c) c = T(1) - c;
    }
    return rule;
}

}  // namespace

RuleEntry radau() {
    RuleEntry e;
    e.item = {
        "radau",
        "Radau",
        "Gauss-Radau: one end is a node, exact to degree 2n - 2; not symmetric.",
        {ruleFields::nodes(1, "the degree of the space"),
         choiceField("end", "end that is a node", {"right", "left"}, "Which end of the step is a node."),
         ruleFields::panels()},
        {},
        ""};
    e.heading = "Rad";
    e.letter = "R";
    e.place = 5;
    e.nodes = [](int degree) { return degree; };
    e.isSymmetric = false;
    setMaker(e, []<class T>(const Settings& q) {
        return radauRule<T>(q.integer("nodes"), q.text("end") != "left");
    });
    return e;
}

}  // namespace extremal::rules
