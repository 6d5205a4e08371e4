#include "app/load.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/model/typed/typed_model.hpp"
#include "engine/model/typed/typeset.hpp"
#include "engine/scene/json.hpp"

namespace extremal::app {
namespace {

/// The Euler-Lagrange equations of a typed Lagrangian.
Value equationsValue(const Scene& scene) {
    Value::Array lines;
    if (scene.model.type == "lagrangian")
        for (std::string& line : typed::equationLines(typed::formulaOf(scene.model), typed::TextForm::plain))
            lines.emplace_back(std::move(line));
    return lines;
}

}  // namespace

int checkVerb(const std::string& scene, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    const bool isValid = reportScene(scene, read, options);
    const int code = isValid ? done : unusable;
    if (options.isJson) {
        Value document{Value::Object{}};
        document.set("valid", isValid);
        document.set("errors", problemsValue(read.errors));
        document.set("warnings", problemsValue(read.warnings));
        if (isValid) document.set("equations", equationsValue(read.scene));
        return print(writeJson(document), code);
    }
    return isValid && !options.isQuiet ? print(sceneName(scene) + ": valid\n", code) : code;
}

}  // namespace extremal::app
