// SPDX-License-Identifier: GPL-3.0-or-later
/// Scene files: reading with every error named, and writing. The format is documented in the handbook
/// ("Scenes").
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// One --set: a JSON pointer ("/schemes/*/step"; "/schemes/-" appends) and a value (JSON, else a string).
struct Override {
    std::string pointer;
    Value value;
};
/// Splits "POINTER=VALUE" at the first '='. Throws InvalidScene.
Override parseOverride(std::string_view text);

struct ReadScene {
    Scene scene;
    std::vector<Problem> errors;                         ///< empty: the scene is valid
    std::vector<Problem> warnings;                       ///< never stop a run
    std::shared_ptr<const ResolvedScene> resolved = {};  ///< of a valid scene: what runs
    double work = 0;                                     ///< what reading has taken (core/work.hpp)
};

/// The budget of work of one reading: about ten seconds. What needs more is an error at the part that has
/// used most of it.
inline constexpr double mostReadingWork = 1e10;
/// Limits of the parts of a scene: beyond them only their number is reported.
inline constexpr std::size_t mostSchemes = 1000, mostEntries = 1000, mostParameters = 10000;

/// Reads, applies the overrides from left to right, checks everything and fills in defaults. Never throws for
/// bad content: all errors are in the result. `directory` is where relative paths of the scene start. A
/// request to stop ends the reading with an error, within a part of a second.
ReadScene readScene(std::string_view json, const std::vector<Override>& overrides = {},
                    const std::string& directory = ".", const std::stop_token& stop = {});
inline ReadScene readScene(const std::string& json, const std::vector<Override>& overrides = {},
                           const std::string& directory = ".", const std::stop_token& stop = {}) {
    return readScene(std::string_view(json), overrides, directory, stop);
}

/// The same for a tree: what forms and undo use.
ReadScene readScene(const Value& document, const std::vector<Override>& overrides = {},
                    const std::string& directory = ".", const std::stop_token& stop = {});

/// The scene with every default filled in, as JSON text ending in a newline: reading and writing it again
/// gives the same bytes.
std::string writeScene(const Scene& scene);
Value toValue(const Scene& scene);

/// The text of SCENE: a path, "preset:NAME" or "-" (standard input). Throws InvalidScene with a hint.
std::string loadSceneText(const std::string& name);

}  // namespace extremal
