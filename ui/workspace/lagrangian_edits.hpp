// SPDX-License-Identifier: GPL-3.0-or-later
/// What the editor of a typed Lagrangian does to a scene, as edits of its document.
#pragma once

#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/model/typed/formula.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

/// A Lagrangian as it is typed: a formula, or one line "slow: ..." for each of its terms, and back.
std::string lagrangianText(const Value& lagrangian);
Value lagrangianFrom(const std::string& text);

/// The Lagrangian as formulaIn() takes it, from text that may be TeX.
std::string formulaOfText(const std::string& text);

/// A formula of a typed model beside its Lagrangian: a constraint, a force, a part of a wall.
struct PlacedFormula {
    std::string pointer, text;
};
/// All of them, in the order of the document: every text below /model that is neither a name nor a parameter.
std::vector<PlacedFormula> partFormulas(const Value& document);
/// Whether the Lagrangian or one of these has the name in it.
bool isInFormulas(const Value& document, const std::string& name);

/// The typed Lagrangian of a document, with numbers for its parameters as far as they are known.
typed::Formula formulaIn(const Value& model);

/// A parameter under another name, in the formula and in every number that uses it.
std::vector<Edit> editsForParameterName(const Value& document, const std::string& from,
                                        const std::string& to);
/// One more parameter, of value 1 and with a free name; `name` gets it.
std::vector<Edit> editsForNewParameter(const Value& document, std::string& name);
std::vector<Edit> editsForParameterRemoval(const Value& document, const std::string& name);

/// Other coordinates: initial data follow by name; where just one name differs it is renamed in the formula
/// too.
/// A formula by these names, where one coordinate of the document is renamed.
std::string formulaFor(const Value& document, const std::vector<std::string>& names, const std::string& text);
std::vector<Edit> editsForCoordinates(const Value& document, const std::vector<std::string>& names);
/// One more coordinate with a free name, at rest at 0, with a kinetic term so that the Lagrangian stays
/// regular.
std::vector<Edit> editsForNewCoordinate(const Value& document);

}  // namespace extremal
