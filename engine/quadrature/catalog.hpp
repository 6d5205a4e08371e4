// SPDX-License-Identifier: GPL-3.0-or-later
/// Quadrature rules by name; one file of quadrature/rules makes one entry.
///
/// An entry says everything that is particular to a rule: its keys, what they are where a scene leaves them
/// out, its place and symbol in tables of discretizations, what it needs of a space, and how its nodes and
/// weights are made, on one panel and in both precisions.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/quadrature/filon.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

struct RuleEntry {
    CatalogItem item;
    std::string heading;  ///< of its column in a table of discretizations: "Gauss"; empty: it has no column
    std::string letter;   ///< stands before the order in a cell of that column: "G"
    int place = 100;      ///< in lists, the simplest first; equal ones by the names of their files
    int (*nodes)(int degree) = nullptr;  ///< the key "nodes" where it is left out, by the degree of the space
    bool isSymmetric = true;             ///< its nodes and weights are mirror images of themselves
    std::optional<FilonNodes> filon;     ///< set: its weights follow from the frequencies of the space
    std::string refusal;  ///< of a space that lacks what the rule needs; empty: it needs nothing
    std::string hint;     ///< the remedy
    /// One panel; keys are checked and complete. Empty: the rule has no nodes of its own.
    std::function<Rule<double>(const Settings&)> make;
    std::function<Rule<__float128>(const Settings&)> makeQuadruple;
};

/// All rules, in alphabetical order of their files; gathered from quadrature/rules.
const std::vector<RuleEntry>& ruleEntries();
/// By place; the same as catalogue items.
const std::vector<const RuleEntry*>& rulesByPlace();
const std::vector<CatalogItem>& quadratureCatalog();
/// Null if there is none.
const RuleEntry* findRule(std::string_view id);

/// The rule of an entry (makeRule of its name), also of one that is not gathered.
template <class T>
Rule<T> makeRule(const RuleEntry& entry, const Settings& quadrature);

/// What a rule is to resolve, where its own keys are left out.
struct RuleDemand {
    int degree = 0;                 ///< highest degree of polynomials in the space
    int cells = 1;                  ///< equal cells of the space in one step
    int harmonic = 1;               ///< highest harmonic in the space
    std::optional<int> nodes = {};  ///< of a rule with a number of nodes, in place of its own default
};
/// The rule with every key of its entry: nodes by the degree, one panel per cell, phases by the harmonic, and
/// the entry's own defaults. Keys that are there stay. A rule without an entry ("auto" decided elsewhere) is
/// returned as it is.
Settings completeRule(const Settings& rule, const RuleDemand& demand);

}  // namespace extremal
