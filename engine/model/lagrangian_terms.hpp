// SPDX-License-Identifier: GPL-3.0-or-later
/// The terms that a Lagrangian is the sum of, by name: what schemes may have rules for.
///
/// A system says them in parts itself (Mechanics::terms). One that does not, but is separable, has "kinetic",
/// 1/2 sum_i m_i v_i^2, and "potential", -V(t, q). Others have none, and one rule for all.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/model/mechanics.hpp"

namespace extremal {

using GivesTerms = std::function<std::vector<LagrangianTerm<double>>()>;
/// What gives the terms that are made by `make`, when they are asked for first. They are kept, as every
/// scheme with rules for terms asks for them several times, and differentiating them takes long.
GivesTerms madeOnce(GivesTerms make);

std::vector<std::string> termNames(const Mechanics<double>& mechanics);
std::vector<LagrangianTerm<double>> termsOf(const Mechanics<double>& mechanics);
/// One term that is the sum of several.
LagrangianTerm<double> sumOf(const std::vector<LagrangianTerm<double>>& terms, int dimension);

}  // namespace extremal
