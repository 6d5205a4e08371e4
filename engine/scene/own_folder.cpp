// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/own_folder.hpp"

#include <filesystem>

namespace extremal {
namespace {

/// From `folder` to `file`, links followed; empty where the file is not in the folder.
std::filesystem::path pathInside(const std::filesystem::path& file, const std::filesystem::path& folder) {
    std::error_code unknown;
    const auto inside = std::filesystem::weakly_canonical(file, unknown)
                            .lexically_relative(std::filesystem::weakly_canonical(folder, unknown));
    const bool isInside = !unknown && !inside.empty() && *inside.begin() != ".." && inside.is_relative();
    return isInside ? inside : std::filesystem::path();
}

}  // namespace

std::string fileOutside(const Scene& scene, const std::string& directory) {
    if (scene.reference.kind != ReferenceSpec::Kind::file) return {};
    return pathInside(scene.reference.path, directory).empty() ? scene.reference.path : std::string();
}

Scene namedFrom(const std::string& directory, Scene scene) {
    if (scene.reference.kind == ReferenceSpec::Kind::file)
        if (const auto inside = pathInside(scene.reference.path, directory); !inside.empty())
            scene.reference.path = inside.string();
    return scene;
}

}  // namespace extremal
