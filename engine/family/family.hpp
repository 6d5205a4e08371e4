// SPDX-License-Identifier: GPL-3.0-or-later
/// A family of schemes: one folder engine/family/<id>, one constant, and one section of the paper. All that
/// is particular to it is there: its spaces and their keys, defaults, claims, checks before a run, stability,
/// cost, the reference it trusts, what the window offers, and its steps. Nothing outside the folder names it
/// (tests/tree); everybody else goes through the functions below the struct, which find the family of a
/// space.
///
/// The members of the struct are what every family sets. What only some families have are parts
/// (engine/family/parts), found by their type: each says what holds where a family has not got it. Functions
/// throw InvalidScene with pointers relative to the scheme only where they say so.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/family/choices.hpp"
#include "engine/family/discretization.hpp"
#include "engine/family/findings.hpp"
#include "engine/family/written_action.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/space/catalog.hpp"

namespace extremal {

/// A scheme before its run.
struct SchemeCase {
    const System& system;
    const State& initial;
    const Discretization& discretization;
    double step = 0;
    bool isComposed = false;
    bool allowsUnstable = false;
    double end = 0;  ///< of the run
};

struct Family {
    CatalogItem item;    ///< id: that of the folder
    std::string source;  ///< "Leok 2004, sec. 3"
    std::vector<SpaceEntry> spaces;
    /// The binding parts that its steps understand, of some discretization; a SchemeCondition is for those
    /// that one of them lacks.
    Takes takes = Takes::only<Mechanical>();
    /// The rule with its default keys; of an empty or automatic one the rule itself, where it does not depend
    /// on the step.
    Settings (*completeRule)(const Settings& space, const Settings& quadrature) = nullptr;
    /// The ids of the rules that a space can have, the preferred one first.
    std::vector<std::string> (*rules)(const Settings& space) = nullptr;
    Properties (*describe)(const Discretization&) = nullptr;
    /// What stands against a step, beyond the limits of the harmonic oscillator.
    void (*check)(const SchemeCase&, Findings&) = nullptr;
    ChoiceGrid (*choices)(const System&) = nullptr;
    /// The discrete action and its stationarity.
    WrittenAction (*written)(const Discretization&) = nullptr;
    /// Throws InvalidScene where it cannot.
    std::unique_ptr<Integrator> (*make)(const System&, const Discretization&, double step) = nullptr;
    Parts parts;  ///< of engine/family/parts
};

/// All families, in alphabetical order of their folders.
const std::vector<Family>& families();
/// The family of a space; null where there is no such space.
const Family* familyOf(const Settings& space);
/// A part of that family; null where there is no such space, or its family has not got the part.
template <class P>
const P* familyPart(const Settings& space) {
    const Family* const family = familyOf(space);
    return family ? family->parts.find<P>() : nullptr;
}
/// Whether it takes every part that the system needs, and the system meets its condition.
bool appliesTo(const Family& family, const System& system);
/// Whether the system's main family is another one (parts/variant.hpp).
bool isVariant(const Family& family, const System& system);
/// The family that the window starts from for a system, and that references come from; null where none
/// applies.
const Family* familyFor(const System& system);
/// What the window offers for a system: the choices of that family, with further rows of its variants, and
/// then the grids of all other families that apply.
std::vector<ChoiceGrid> choiceGrids(const System& system);
/// The first of them.
ChoiceGrid choicesFor(const System& system);
const Family* findFamily(std::string_view id);

/// All spaces of all families.
const std::vector<CatalogItem>& spaceCatalog();
/// Those of the families that apply to a system.
std::vector<CatalogItem> spacesFor(const System& system);

/// What the key `method` of a solver may be besides "auto".
const std::vector<std::string>& solverMethods(const Family& family);
/// Who chooses the times of the nodes, for the schemes of a space.
TimeGrid timeGridOf(const Settings& space);

/// Keys must be checked and complete. Results are remembered, so that asking again is cheap.
Properties describe(const Discretization& discretization);
/// On a system: rules for terms and spaces for coordinates promise what its terms and coordinates allow.
Properties describe(const Discretization& discretization, const System& system);
inline Properties describe(const Settings& space, const Settings& quadrature) {
    return describe({space, quadrature, {}});
}

/// Fills in what depends on the other choice: the default number of nodes, and "auto" (or no) quadrature.
Settings completeQuadrature(const Settings& space, const Settings& quadrature);

/// Why a discretization cannot be used on a system; empty if it can.
std::string mismatch(const Discretization& discretization, const System& system);
inline bool isFor(const Discretization& discretization, const System& system) {
    return mismatch(discretization, system).empty();
}

/// With everything decided that depends on the start of a run.
Discretization withEstimates(const Discretization& discretization, const System& system, const State& start);

/// Makes the integrator of a discretization. Throws InvalidScene.
std::unique_ptr<Integrator> makeIntegrator(const System& system, const Discretization& discretization,
                                           const Clock& clock);

/// Whether a discretization has one table for every system and step.
bool hasTable(const Discretization& discretization);
/// Highest frequency of the system at a state: its own, or, linearised there, the largest root w of
/// det(-L_qq - w^2 L_vv) = 0, or 0.
double highestFrequency(const System& system, const State& state);

}  // namespace extremal
