// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of a scene, each read into its place; findings go to the reader. Internal to engine/scene.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/scene/read/reader.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {

/// Reads the model, makes the values of its parameters known to expressions, and builds the system.
/// Empty if the model is wrong.
std::optional<System> readModel(Reader& reader, const Value& document, Scene& scene);

/// Initial data; the model's example where the scene has none.
void readInitial(Reader& reader, const Value& document, const System& system, Scene& scene);

/// For starts from two positions, after the schemes: the time between them, and whether a motion joins them.
void readStart(Reader& reader, const System& system, Scene& scene);

/// Schemes and their default labels. Those that are wrong are left out; the result says where in the document
/// each of scene.schemes stands.
std::vector<std::size_t> readSchemes(Reader& reader, const Value& document, Scene& scene);
std::optional<SchemeSpec> readScheme(Reader& reader, const Value& value, const std::string& pointer);
/// The rule of a scheme, complete for its space; null: not given.
std::optional<Settings> readRule(Reader& reader, const Value* given, const std::string& pointer,
                                 const Settings& space);
/// The rule as a scene writes it: a tensor product has no type.
Value ruleValue(const Settings& rule);
/// Gives the schemes without a label one made from their parts, unique among all.
void fillLabels(std::vector<SchemeSpec>& schemes);

/// Reference, output, observables, events and views.
void readReference(Reader& reader, const Value& document, const std::string& directory, Scene& scene);
void readTime(Reader& reader, const Value& document, Scene& scene);
void readOutput(Reader& reader, const Value& document, Scene& scene);
void readObserve(Reader& reader, const Value& document, const System* system, Scene& scene);
/// After the initial data: names the numbers of the system, where sensitivities are observed.
void readSensitivity(Reader& reader, const Value& document, System* system, Scene& scene);
void readEvents(Reader& reader, const Value& document, const System* system, Scene& scene);
void readViews(Reader& reader, const Value& document, const System* system, Scene& scene);
/// How the window shows the scene; after its interval.
void readShown(Reader& reader, const Value& document, Scene& scene);
/// The size of a view's card.
CardSize readCardSize(Reader& reader, const Value& object, const std::string& pointer);

/// The keys of a view "parameter-map", with those it leaves out; `others` are keys read elsewhere.
void readMap(Reader& reader, const Value& object, const std::string& pointer,
             const std::vector<std::string>& others, const System& system, const Scene& scene, View& view);

/// The starts of a view, and whether its plane can have any. Whether the energy admits each of them is a
/// warning, once the start of the scene is known.
void readStarts(Reader& reader, const Value& object, const std::string& pointer, const System* system,
                View& view);
void checkStarts(Reader& reader, const ResolvedScene& resolved);

/// What needs several parts at once: numbers of steps and rows, refused and unstable discretizations,
/// stability limits, cost. A scene whose model is wrong has no system. Fills in the state at the start.
void checkWhole(Reader& reader, ResolvedScene& resolved, const std::vector<std::size_t>& places);

Value schemeValue(const SchemeSpec& scheme);

}  // namespace extremal
