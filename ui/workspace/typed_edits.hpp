// SPDX-License-Identifier: GPL-3.0-or-later
/// What the editor of a typed model (ui/workspace/typed_kind.hpp) does to a scene, as edits of its document.
#pragma once

#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/value.hpp"
#include "engine/model/typed/formula.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

/// A formula as it is typed, one or a line "slow: ..." for each of its terms, and back.
std::string formulaText(const Value& typed);
Value formulaFrom(const std::string& text);

/// The formula as formulaIn() takes it, from text that may be TeX.
std::string formulaOfText(const std::string& text);

/// A formula of a typed model beside the first: a constraint, a force, a part of a wall, a bracket.
struct PlacedFormula {
    std::string pointer, text;
};
/// All of them, in the order of the document: every text below /model that is neither a name nor a parameter.
std::vector<PlacedFormula> partFormulas(const Value& document);
/// Whether the first formula or one of these has the name in it.
bool isInFormulas(const Value& document, const std::string& name);

/// The typed formula of a model, with numbers for its parameters as far as they are known. Its coordinates
/// are the names whose functions it is: of a Hamiltonian the momenta come behind the coordinates.
typed::Formula formulaIn(const Value& model);

/// A parameter under another name, in the formula and in every number that uses it.
std::vector<Edit> editsForParameterName(const Value& document, const std::string& from,
                                        const std::string& to);
/// One more parameter, of value 1 and with a free name; `name` gets it.
std::vector<Edit> editsForNewParameter(const Value& document, std::string& name);
std::vector<Edit> editsForParameterRemoval(const Value& document, const std::string& name);

/// A formula by these names, where one coordinate of the document is renamed.
std::string formulaFor(const Value& document, const std::vector<std::string>& names, const std::string& text);
/// Other coordinates or variables: initial data follow by name; where just one name differs it is renamed in
/// the formulas too.
std::vector<Edit> editsForCoordinates(const Value& document, const std::vector<std::string>& names);
/// One more coordinate, or two more variables that are conjugate, with free names, at rest at 0, and with the
/// terms that keep the model regular.
std::vector<Edit> editsForNewCoordinates(const Value& document);

/// Columns that are named after a part, "reaction.rod" and "reaction.rod.force", by its new name.
void renameColumns(const Value& value, const std::string& pointer, const std::string& from,
                   const std::string& to, std::vector<Edit>& edits);
/// The edits without the plots and columns in which these problems are.
std::vector<Edit> withoutRefused(std::vector<Edit> edits, const std::vector<Problem>& problems);

}  // namespace extremal
