// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/ruled_terms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/model/lagrangian_terms.hpp"
#include "engine/quadrature/tensor.hpp"

namespace extremal {

std::vector<RuledTerms> ruledTerms(const Mechanics<double>& mechanics, const Settings& quadrature) {
    std::vector<std::pair<Settings, std::vector<LagrangianTerm<double>>>> groups;
    for (const LagrangianTerm<double>& term : termsOf(mechanics)) {
        Settings rule = termPart(quadrature, term.name);
        if (rule.type.empty()) rule = termPart(quadrature, otherTerms);
        const auto same = std::find_if(groups.begin(), groups.end(),
                                       [&](const auto& group) { return group.first == rule; });
        if (same == groups.end())
            groups.push_back({rule, {term}});
        else
            same->second.push_back(term);
    }
    std::vector<RuledTerms> parts;
    for (auto& [rule, terms] : groups) parts.push_back({rule, sumOf(terms, mechanics.dimension)});
    return parts;
}

std::string breakerOf(const std::vector<RuledTerms>& parts, const Symmetry& symmetry) {
    const auto d = static_cast<std::size_t>(symmetry.dimension);
    SampledState state;
    state.q.resize(d);
    state.v.resize(d);
    state.gradient.resize(2 * d);
    for (const RuledTerms& ruled : parts) {
        Mechanics<double> alone;
        alone.dimension = symmetry.dimension;
        alone.model = ruled.part.model;
        alone.jet = ruled.part.jet;
        alone.gradient = ruled.part.gradient;
        for (int trial = 1; trial <= 4; ++trial) {
            for (std::size_t k = 0; k < d; ++k) {
                state.q[k] = 0.8 + std::sin(1.7 * trial + 0.9 * static_cast<double>(k)) / 2;
                state.v[k] = std::cos(1.1 * trial + 0.6 * static_cast<double>(k));
            }
            state.t = 0.3 * trial;
            StateSampler(alone).evaluate(state);
            if (symmetry.violation(state) > 1e-9) return ruled.part.name;
        }
    }
    return {};
}

}  // namespace extremal
