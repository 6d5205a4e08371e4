// SPDX-License-Identifier: GPL-3.0-or-later
/// Gives an entry its rule in both precisions from one function. Internal to engine/quadrature: includes the
/// heavy header of quadruple numbers.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include <utility>

#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/rule_fields.hpp"

namespace extremal {

/// `make.template operator()<T>(settings)` returns the Rule<T> on one panel.
template <class Make>
void setMaker(RuleEntry& entry, Make make) {
    using Quad = boost::multiprecision::float128;
    entry.make = [make](const Settings& q) { return make.template operator()<double>(q); };
    entry.makeQuadruple = [make](const Settings& q) {
        const Rule<Quad> rule = make.template operator()<Quad>(q);
        Rule<__float128> plain;
        for (const Quad& c : rule.c) plain.c.push_back(c.backend().value());
        for (const Quad& b : rule.b) plain.b.push_back(b.backend().value());
        plain.degree = rule.degree;
        plain.isSymmetric = rule.isSymmetric;
        plain.caution = rule.caution;
        return plain;
    };
}

}  // namespace extremal
