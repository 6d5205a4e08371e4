// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/part_kinds.hpp"

#include <QObject>

#include <algorithm>

#include "engine/model/system.hpp"
#include "ui/workspace/lagrangian_edits.hpp"

namespace extremal {

const std::vector<PartKind>& partKinds() {
    static const std::vector<PartKind> all{
        {"constraints", QT_TR_NOOP("constraint"), PartNaming::free, "rod", "= 0", "x^2 + y^2 - l^2",
         QT_TR_NOOP("A relation of coordinates and t that holds at all times: the formula is 0")},
        {"rolling", QT_TR_NOOP("rolling"), PartNaming::free, "wheel", "= 0", "x_t - r*theta_t",
         QT_TR_NOOP("A relation that is linear in velocities, as of what rolls: the formula is 0")},
        {"forces", QT_TR_NOOP("force"), PartNaming::byCoordinate, "", "", "-c*x_t + sin(t)",
         QT_TR_NOOP("A force on a coordinate that no Lagrangian has; velocities and t may be in it")},
        {"dissipation", QT_TR_NOOP("damping"), PartNaming::single, "", "", "c/2*x_t^2",
         QT_TR_NOOP("Rayleigh's function D: adds the force -dD/dv to each coordinate")},
        {"controls", QT_TR_NOOP("control"), PartNaming::free, "u", "", "sin(t)",
         QT_TR_NOOP("A name for a function of time that forces may use")},
        {"walls",
         QT_TR_NOOP("wall"),
         PartNaming::free,
         "floor",
         "≥ 0",
         "y",
         QT_TR_NOOP("The gap, a formula that stays positive, and what part of the speed comes back"),
         {{"gap", ""}, {"restitution", "1"}}}};
    return all;
}

bool isOffered(const PartKind& kind) {
    const ModelEntry* const entry = findModel("lagrangian");
    return entry && std::any_of(entry->item.parameters.begin(), entry->item.parameters.end(),
                                [&](const FieldInfo& field) { return field.key == kind.key; });
}

typed::PartTexts partTextsOf(const Value& model) {
    typed::PartTexts parts;
    const auto formulas = [&](const char* key) {
        std::vector<std::pair<std::string, std::string>> all;
        if (const Value* value = model.find(key); value && value->isObject())
            for (const auto& [name, text] : value->asObject())
                if (text.isString()) all.emplace_back(name, formulaOfText(text.asString()));
        return all;
    };
    parts.constraints = formulas("constraints");
    parts.rolling = formulas("rolling");
    parts.forces = formulas("forces");
    if (const Value* value = model.find("dissipation"); value && value->isString())
        parts.dissipation = formulaOfText(value->asString());
    if (const Value* value = model.find("controls"); value && value->isObject())
        for (const auto& [name, text] : value->asObject()) parts.controls.push_back(name);
    return parts;
}

}  // namespace extremal
