// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>
#include <string>

#include "app/load.hpp"
#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/core/switching.hpp"
#include "engine/core/text/indexed.hpp"
#include "engine/family/kept_momenta.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/model/typed/phase/motion_lines.hpp"
#include "engine/model/typed/typed_model.hpp"
#include "engine/scene/outlook/topics.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/symmetry/symmetry.hpp"

namespace extremal::app {
namespace {

/// The keys of a typed Lagrangian, or of the one that the model writes; null: there is none.
const Settings* typedSettings(const ResolvedScene& resolved) {
    if (const auto* const form = resolved.system->parts.find<WrittenForm>()) return &form->settings;
    return resolved.scene.model.type == "lagrangian" ? &resolved.scene.model : nullptr;
}

/// The equations of motion of a typed model.
Value equationsValue(const ResolvedScene& resolved) {
    Value::Array lines;
    const Settings& model = resolved.scene.model;
    if (const Settings* const typed = typed::hasMotionLines(model) ? &model : typedSettings(resolved))
        for (std::string& line : typed::motionLines(*typed, typed::TextForm::plain))
            lines.emplace_back(std::move(line));
    return lines;
}

/// Where a typed Lagrangian has kinks and jumps: the functions that change sign there.
std::vector<SwitchingFunction> switchesOf(const ResolvedScene& resolved) {
    const Settings* const typed = typedSettings(resolved);
    if (!typed) return {};
    return switchingFunctions(parseWrittenOut(typed::formulaOf(*typed).text));
}
Value switchesValue(const ResolvedScene& resolved) {
    Value::Array all;
    for (const SwitchingFunction& s : switchesOf(resolved)) {
        Value each;
        each.set("zero", s.function.text);
        each.set("kind", s.mayJump ? "jump" : "kink");
        all.push_back(std::move(each));
    }
    return all;
}
std::string switchesText(const ResolvedScene& resolved) {
    std::string text;
    for (const SwitchingFunction& s : switchesOf(resolved))
        text += (text.empty() ? "not smooth where " : ", ") + s.function.text + " = 0" +
                (s.mayJump ? " (jump)" : " (kink)");
    return text.empty() ? text : text + "\n";
}

/// The symmetries of the system, and which discretizations of the scene keep their momenta.
Value symmetriesValue(const ResolvedScene& resolved) {
    Value::Array all;
    for (const Symmetry& s : *symmetriesOf(*resolved.system)) {
        Value each;
        each.set("name", s.name);
        each.set("title", s.title);
        each.set("generator", s.generator);
        each.set("defect", s.defect);
        each.set("dependent", s.isDependent);
        Value::Array kept;
        for (const ResolvedScheme& scheme : resolved.schemes)
            if (scheme.family && keeps(scheme.discretization, s, *resolved.system))
                kept.emplace_back(scheme.spec.label);
        each.set("kept_by", std::move(kept));
        all.push_back(std::move(each));
    }
    return all;
}

/// The pages that explain what was found, on one line.
void nameHandbook(const ReadScene& read) {
    std::set<std::string> places;
    for (const auto* all : {&read.errors, &read.warnings})
        for (const Problem& p : *all) places.insert(handbookPlace(p));
    std::string line;
    for (const std::string& place : places) line += (line.empty() ? "" : ", ") + place;
    if (!line.empty()) printProblem("", "explained in the handbook: " + line, "extremal handbook PAGE");
}

}  // namespace

int checkVerb(const std::string& scene, const CommonOptions& options) {
    const ReadScene read = loadScene(scene, options);
    const bool isValid = reportScene(scene, read, options);
    const int code = isValid ? done : unusable;
    if (!options.isJson && !options.isQuiet) nameHandbook(read);
    if (options.isJson) {
        Value document{Value::Object{}};
        document.set("valid", isValid);
        setProblems(document, "errors", read.errors);
        setProblems(document, "warnings", read.warnings);
        if (isValid) {
            document.set("equations", equationsValue(*read.resolved));
            document.set("switches", switchesValue(*read.resolved));
            document.set("symmetries", symmetriesValue(*read.resolved));
        }
        return print(writeJson(document), code);
    }
    if (!isValid || options.isQuiet) return code;
    std::string text = sceneName(scene) + ": valid\n";
    if (const System& system = *read.resolved->system; system.isMovedOnlyBy<Mechanical>())
        text += "symmetries: " + symmetryText(system) + "\n";
    text += switchesText(*read.resolved);
    return print(text, code);
}

}  // namespace extremal::app
