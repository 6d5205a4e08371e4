// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/kept_momenta.hpp"

#include <algorithm>

#include "engine/family/family.hpp"
#include "engine/family/ruled_terms.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/quadrature/tensor.hpp"

namespace extremal {
namespace {

/// No coordinate has a space of its own.
bool hasOneSpace(const Settings& space) {
    return std::none_of(space.keys.begin(), space.keys.end(), [](const auto& key) {
        return (key.first == "variables" || key.first == "fast") && !key.second.isNull();
    });
}

bool mixesCoordinates(const Symmetry& s) {
    for (int i = 0; i < s.dimension; ++i)
        for (int j = 0; j < s.dimension; ++j)
            if (i != j && s.a(i, j) != 0) return true;
    return false;
}

}  // namespace

bool keeps(const Discretization& discretization, const Symmetry& symmetry, const System& system) {
    const Settings& space = discretization.space;
    if (!symmetry.isExact() || symmetry.movesTime()) return false;
    if (mixesCoordinates(symmetry) && !hasOneSpace(space)) return false;
    const bool isBoost = hasNonzero(symmetry.c);
    if (isTermRule(discretization.quadrature)) {
        const auto parts = ruledTerms(system.mechanics(), discretization.quadrature);
        return symmetry.F.empty() && !isBoost && breakerOf(parts, symmetry).empty();
    }
    if (symmetry.F.empty() && !isBoost) return true;
    if (!hasTable(discretization) || space.find("cells") || !space.find("degree")) return false;
    const Rule<double> rule = makeRule<double>(discretization.quadrature);
    if (rule.panels > 1) return false;
    const int s = space.integer("degree");
    return std::all_of(symmetry.F.begin(), symmetry.F.end(), [&](const GaugeTerm& term) {
        return rule.degree >= term.degree() * s + term.power - 1;
    });
}

}  // namespace extremal
