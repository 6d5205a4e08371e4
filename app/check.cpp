#include "app/load.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/scene/json.hpp"

namespace extremal::app {

int checkVerb(const std::string& scene, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options.overrides);
    const bool isValid = reportScene(scene, read, options);
    const int code = isValid ? done : unusable;
    if (options.isJson) {
        Value document{Value::Object{}};
        document.set("valid", isValid);
        document.set("errors", problemsValue(read.errors));
        document.set("warnings", problemsValue(read.warnings));
        return print(writeJson(document), code);
    }
    return isValid && !options.isQuiet ? print(sceneName(scene) + ": valid\n", code) : code;
}

}  // namespace extremal::app
