// SPDX-License-Identifier: GPL-3.0-or-later
/// The models whose formula is typed in names of the user's own, as data: what the formula is called, which
/// names it has, and what a new name adds to it.
///
///     lagrangian    L(t, x, x_t)       coordinates x, velocities x_t
///     hamiltonian   H(t, x, p_x)       coordinates x, momenta p_x
///     phase-space   theta(x) . x' - H  variables x
///     poisson       x' = J(x) grad H   variables x
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

struct TypedKind {
    const char* model;    ///< its type
    const char* formula;  ///< the key of the formula
    const char* letter;   ///< what the formula is called in messages
    const char* title;    ///< of the editor
    const char* tip;
    const char* names;  ///< the key of the names
    /// What is before and behind the name of a coordinate in the name of its momentum or velocity; both
    /// empty: the formula is in the names alone, so that it makes no new ones.
    const char *before, *behind;
    int newNames;         ///< how many "+" adds
    const char* newTerm;  ///< what they add to the formula; %1, %2 are the names
    const char *newPart, *newPartName, *newPartFormula;  ///< and beside it; a key of the model or null
    const char* equations;                               ///< what the equations below are
    const char* help;                                    ///< page of the handbook
    const char* refused;                                 ///< its section on what is refused

    std::string formulaPlace() const { return std::string("/model/") + formula; }
    std::string namesPlace() const { return std::string("/model/") + names; }
    bool hasRates() const { return *before || *behind; }
    std::string rateOf(const std::string& name) const { return before + name + behind; }
    /// The x of x_t or p_x; empty: the name is none of these.
    std::string nameOfRate(const std::string& rate) const;
};

/// Of a type of model, of the one of a document; null: its formula is not typed so.
const TypedKind* typedKind(std::string_view model);
const TypedKind* typedKindOf(const Value& document);
/// The names of a document's model, as far as they are texts.
std::vector<std::string> typedNamesOf(const Value& document);

}  // namespace extremal
