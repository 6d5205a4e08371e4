// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/load_scene.hpp"

#include <algorithm>
#include <filesystem>

#include "engine/run/reference/reference.hpp"
#include "engine/scene/own_folder.hpp"

namespace extremal {
namespace {

/// Where the user names the reference, it does not come from a stranger.
bool setsReference(const std::vector<Override>& overrides) {
    return std::any_of(overrides.begin(), overrides.end(),
                       [](const Override& each) { return each.pointer.starts_with("/reference"); });
}

}  // namespace

std::string folderOf(const std::string& scene) {
    const std::string parent = std::filesystem::path(scene).parent_path().string();
    return parent.empty() || scene == "-" || scene.starts_with("preset:") ? "." : parent;
}

void checkReferenceFile(ReadScene& read, const std::string& folder, const std::vector<Override>& overrides,
                        bool isTrusted) {
    if (!read.errors.empty() || read.scene.reference.kind != ReferenceSpec::Kind::file) return;
    const bool mayRead = isTrusted || setsReference(overrides);
    try {
        if (const std::string file = fileOutside(read.scene, folder); !mayRead && !file.empty())
            throw InvalidScene({Problem{"/reference/path",
                                        "lies outside the folder of the scene: " + file,
                                        "put the file beside the scene, or allow it with --trust",
                                        {},
                                        {},
                                        "strangers"}});
        (void)makeReference(*read.resolved, {});
    } catch (const InvalidScene& e) {
        read.errors = e.problems();
    }
}

ReadScene loadScene(const std::string& scene, const std::vector<std::string>& overrides, bool isTrusted) {
    std::vector<Override> parsed;
    std::vector<Problem> wrong;
    for (const std::string& text : overrides) {
        try {
            parsed.push_back(parseOverride(text));
        } catch (const InvalidScene& e) {
            wrong.insert(wrong.end(), e.problems().begin(), e.problems().end());
        }
    }
    ReadScene result;
    try {
        result = readScene(loadSceneText(scene), parsed, folderOf(scene));
        checkReferenceFile(result, folderOf(scene), parsed, isTrusted);
    } catch (const InvalidScene& e) {
        result.errors = e.problems();
    }
    result.errors.insert(result.errors.begin(), wrong.begin(), wrong.end());
    return result;
}

}  // namespace extremal
