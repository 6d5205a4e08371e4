// SPDX-License-Identifier: GPL-3.0-or-later
/// Grids of choices with a space per row and a plain rule per column: the rules that have a heading
/// (quadrature/catalog.hpp).
#pragma once

#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/family/choices.hpp"

namespace extremal {

/// A row: the space with all keys, and what stands before the degree in the id of its cells.
struct SpaceRow {
    std::string text;  ///< "poly 3"
    std::string idPrefix;
    Settings space;
};

/// `further`: rules without a heading, for the last columns, under their own names, where some space takes
/// them; columns that none takes make room. A rule that is typed is there where most spaces take it, with
/// Gauss's nodes to begin with.
ChoiceGrid ruleChoices(const std::vector<SpaceRow>& rows, const std::vector<std::string>& further = {});

/// The ids of the rules that have nodes of their own, Gauss first.
std::vector<std::string> plainRules();

/// Whether the rule has nodes of its own, as those of spaces without fast oscillations must.
bool isPlainRule(const Settings& quadrature);

/// Sets the refusal of a rule that is not plain, with its remedy.
void refuseRule(const Settings& quadrature, Properties& properties);

/// Sets the refusal of a space and a rule that throw, at its place where that is inside one of them.
void refuse(const InvalidScene& error, Properties& properties);

/// The rule with its default keys; an empty or automatic one is Gauss. A tensor product is complete since it
/// was read.
Settings completePlainRule(const Settings& quadrature, int degree, int cells);

}  // namespace extremal
