#include "app/load.hpp"

#include <algorithm>
#include <filesystem>

#include "app/report.hpp"
#include "engine/run/reference.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/own_folder.hpp"

namespace extremal::app {
namespace {

/// Where relative paths of the scene start.
std::string directoryOf(const std::string& scene) {
    const std::string parent = std::filesystem::path(scene).parent_path().string();
    return parent.empty() || scene == "-" || scene.starts_with("preset:") ? "." : parent;
}

/// Where the user names the reference on the command line, it is no stranger's.
bool setsReference(const std::vector<Override>& overrides) {
    return std::any_of(overrides.begin(), overrides.end(),
                       [](const Override& each) { return each.pointer.starts_with("/reference"); });
}

/// A reference file is read now, so that a bad one is an error before anything runs.
void checkReferenceFile(ReadScene& read, const std::string& directory, bool isTrusted) {
    if (!read.errors.empty() || read.scene.reference.kind != ReferenceSpec::Kind::file) return;
    try {
        if (const std::string file = fileOutside(read.scene, directory); !isTrusted && !file.empty())
            throw InvalidScene("/reference/path", "lies outside the folder of the scene: " + file,
                               "put the file beside the scene, or allow it with --trust");
        (void)makeReference(*read.resolved, {});
    } catch (const InvalidScene& e) {
        read.errors = e.problems();
    }
}

}  // namespace

std::string sceneName(const std::string& scene) { return scene == "-" ? "standard input" : scene; }

ReadScene loadScene(const std::string& scene, const CommonOptions& options) {
    std::vector<Override> parsed;
    std::vector<Problem> wrong;
    for (const std::string& text : options.overrides) {
        try {
            parsed.push_back(parseOverride(text));
        } catch (const InvalidScene& e) {
            wrong.insert(wrong.end(), e.problems().begin(), e.problems().end());
        }
    }
    ReadScene result;
    try {
        result = readScene(loadSceneText(scene), parsed, directoryOf(scene));
        checkReferenceFile(result, directoryOf(scene), options.isTrusted || setsReference(parsed));
    } catch (const InvalidScene& e) {
        result.errors = e.problems();
    }
    result.errors.insert(result.errors.begin(), wrong.begin(), wrong.end());
    return result;
}

bool reportScene(const std::string& scene, const ReadScene& read, const CommonOptions& options) {
    printProblems(sceneName(scene), read.errors);
    if (!options.isQuiet) printProblems(sceneName(scene), read.warnings, "warning: ");
    return read.errors.empty();
}

}  // namespace extremal::app
