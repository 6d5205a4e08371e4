// SPDX-License-Identifier: GPL-3.0-or-later
/// What the window does with schemes, as edits of the document: add, duplicate, remove, move, switch on and
/// off.
#pragma once

#include <string>
#include <vector>

#include "engine/family/choices.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

/// A step to begin with: that of a similar scheme of the scene, else the model's example, scaled by the
/// order.
double sensibleStep(const Scene& scene, int order, double stabilityLimit);

/// A label no other scheme has: the wish, or the wish with "(2)", "(3)", ...
std::string uniqueLabel(const Scene& scene, const std::string& wish);

/// Settings as a member of a document: their type and the keys that have a value.
Value settingsTree(const Settings& settings);

/// A complete scheme for "/schemes/-".
Value newPair(const Scene& scene, const Settings& space, const Settings& quadrature);
Value newBaseline(const Scene& scene, const std::string& id);
Value newNamed(const Scene& scene, const std::string& id);
/// One of the user's catalogue, with its name as label; its own step, or a sensible one.
Value newOwn(const Scene& scene, const Value& kept);

/// The other schemes keep their colours and dashes; a new one gets those that no other has.
std::vector<Edit> editsForAdding(const Scene& scene, const Value& scheme);
std::vector<Edit> editsForDuplicate(const Scene& scene, int index);
std::vector<Edit> editsForRemoval(const Scene& scene, int index);
std::vector<Edit> editsForMove(const Scene& scene, int index, int by);
std::vector<Edit> editsForToggle(const Scene& scene, int index);
/// This scheme alone is on; all of them, if it is that already.
std::vector<Edit> editsForSolo(const Scene& scene, int index);
/// Another colour and dash; a scheme that has these takes the old ones.
std::vector<Edit> editsForStyle(const Scene& scene, int index, int style);
/// The step, or the tolerance, times a factor, to three digits; none for a scheme that has neither.
std::vector<Edit> editsForStep(const Scene& scene, int index, double factor);
/// The model with the values it starts from, where they are not its defaults.
Value exampleModel(const ModelEntry& entry);
/// A scene to begin with: a Lagrangian to be typed, and two schemes.
Value newLagrangianScene();
/// Another model: its example data and views, and a step that suits it for every scheme. Schemes that the
/// model has no use for turn into discretizations of the same order, or go.
std::vector<Edit> editsForModel(const Scene& scene, const ModelEntry& entry);

/// A case of a view "parameter-map" of one scheme: the parameter, and the step of this scheme.
std::vector<Edit> editsForCase(const Scene& scene, const View& view, double value, double step);

/// Shows a view, with what it observes, or hides it.
std::vector<Edit> editsForView(const Scene& scene, const std::string& id, bool isShown);

/// A space of the catalogue with its defaults and this degree.
Settings spaceOf(const std::string& id, int degree);
/// The rule, if a space of this kind goes with it, else the usual one of the space.
std::string fittingRule(const std::string& rule, const Settings& space);
/// A rule of the catalogue as it fits the space.
Settings ruleFor(const std::string& id, const Settings& space);

}  // namespace extremal
