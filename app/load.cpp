#include "app/load.hpp"

#include <filesystem>

#include "app/report.hpp"
#include "engine/run/reference.hpp"
#include "engine/scene/bind.hpp"

namespace extremal::app {
namespace {

/// Where relative paths of the scene start.
std::string directoryOf(const std::string& scene) {
    const std::string parent = std::filesystem::path(scene).parent_path().string();
    return parent.empty() || scene == "-" || scene.starts_with("preset:") ? "." : parent;
}

/// A reference file is read now, so that a bad one is an error before anything runs.
void checkReferenceFile(ReadScene& read) {
    if (!read.errors.empty() || read.scene.reference.kind != ReferenceSpec::Kind::file) return;
    try {
        (void)makeReference(*read.resolved, {});
    } catch (const InvalidScene& e) {
        read.errors = e.problems();
    }
}

}  // namespace

std::string sceneName(const std::string& scene) { return scene == "-" ? "standard input" : scene; }

ReadScene loadScene(const std::string& scene, const std::vector<std::string>& overrides) {
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
        result = readScene(loadSceneText(scene), parsed, directoryOf(scene));
        checkReferenceFile(result);
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
