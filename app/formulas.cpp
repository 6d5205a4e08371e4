// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/load.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/model/typed/phase/motion_lines.hpp"
#include "engine/run/files/export.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/typed_scene.hpp"

namespace extremal::app {

namespace {

/// The equations of motion of a typed model, or of one that says its Lagrangian.
std::string equationsOf(const ResolvedScene& resolved, bool isTex) {
    const auto model = typedModel(resolved);
    const auto text = [&](const Settings& typed) {
        if (isTex) return typed::texOfMotion(typed);
        std::string lines;
        for (const std::string& line : typed::motionLines(typed, typed::TextForm::plain))
            lines += line + "\n";
        return lines;
    };
    std::string written = model ? text(*model) : std::string();
    if (written.empty())
        throw InvalidScene(
            "/model/type",
            resolved.scene.model.type +
                (model ? " has too many equations to show" : " does not say its equations"),
            "typed models of up to 12 freedoms, mechanisms and most models with coordinates do");
    return written;
}

}  // namespace

int formulasVerb(const std::string& scene, const FormulasRequest& request, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    if (!reportScene(scene, read, options)) return unusable;
    try {
        const bool isScene = request.equations.empty();
        const std::string text = isScene ? writeJson(typedScene(*read.resolved))
                                         : equationsOf(*read.resolved, request.equations == "tex");
        if (request.out.empty()) return print(text, done);
        writeFile(request.out, text, replacingOf(scene, read, options));
    } catch (const InvalidScene& e) {
        return tellUnusable(e, sceneName(scene));
    } catch (const ExportError& e) {
        return tellUnwritable(e);
    }
    const std::string what = request.equations.empty() ? "typed Lagrangian: " : "equations of motion: ";
    return options.isQuiet ? done : print(what + request.out + "\n", done);
}

}  // namespace extremal::app
