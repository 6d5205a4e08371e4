// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/load.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/typed_scene.hpp"

namespace extremal::app {

int formulasVerb(const std::string& scene, const FormulasRequest& request, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    try {
        const std::string text = writeJson(typedScene(*read.resolved));
        if (request.out.empty()) return print(text, done);
        writeFile(request.out, text, replacingOf(scene, read, options));
    } catch (const InvalidScene& e) {
        return tellUnusable(e, sceneName(scene));
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    }
    return options.isQuiet ? done : print("typed Lagrangian: " + request.out + "\n", done);
}

}  // namespace extremal::app
