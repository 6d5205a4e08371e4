// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene by its name, with its overrides, and what it may read: how the command line and the library load
/// scenes.
#pragma once

#include <string>
#include <vector>

#include "engine/scene/write/codec.hpp"

namespace extremal {

/// Where relative paths of a scene start: the folder of its file, else the current one.
std::string folderOf(const std::string& scene);

/// A reference file is read now, so that a bad one is an error before anything runs; one outside the folder
/// only if the scene is trusted, or the overrides name it.
void checkReferenceFile(ReadScene& read, const std::string& folder, const std::vector<Override>& overrides,
                        bool isTrusted);

/// Reads a path, preset:NAME, or - with its overrides ("POINTER=VALUE"). What cannot be read at all is an
/// error in the result as well. Never throws for bad input.
ReadScene loadScene(const std::string& scene, const std::vector<std::string>& overrides, bool isTrusted);

}  // namespace extremal
