#include "app/load.hpp"

#include "app/report.hpp"
#include "engine/run/load_scene.hpp"

namespace extremal::app {

std::string sceneName(const std::string& scene) { return scene == "-" ? "standard input" : scene; }

ReadScene loadScene(const std::string& scene, const CommonOptions& options) {
    return extremal::loadScene(scene, options.overrides, options.isTrusted);
}

bool reportScene(const std::string& scene, const ReadScene& read, const CommonOptions& options) {
    printProblems(sceneName(scene), read.errors);
    if (!options.isQuiet) printProblems(sceneName(scene), read.warnings, "warning: ");
    return read.errors.empty();
}

}  // namespace extremal::app
