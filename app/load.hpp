// SPDX-License-Identifier: GPL-3.0-or-later
/// SCENE, --add and --set of a command line, read and checked.
#pragma once

#include <string>
#include <vector>

#include "app/verbs.hpp"
#include "engine/run/files/replacing.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal::app {

/// Reads SCENE with its overrides; what cannot be read at all, or may not be (--trust), is an error in the
/// result as well. Prints nothing.
ReadScene loadScene(const std::string& scene, const CommonOptions& options);

/// What --out may replace: not what the scene was read from, and of others what --force says. `further`:
/// files that are read besides.
Replacing replacingOf(const std::string& scene, const ReadScene& read, const CommonOptions& options,
                      const std::vector<std::string>& further = {});

/// How messages call a scene: its path, preset:NAME, or "standard input".
std::string sceneName(const std::string& scene);

/// Prints the errors, and the warnings unless quiet. True: the scene can be used.
bool reportScene(const std::string& scene, const ReadScene& read, const CommonOptions& options);

}  // namespace extremal::app
