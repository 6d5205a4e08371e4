// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/scene_formula.hpp"

#include "engine/model/parts/written_form.hpp"
#include "engine/model/typed/typed_model.hpp"

namespace extremal {

std::optional<typed::Formula> formulaOf(const ResolvedScene& scene) {
    const Settings& model = scene.scene.model;
    const ModelEntry* const entry = findModel(model.type);
    if (!entry) return {};
    // Of a field it is a density, which is no function of coordinates.
    if (model.find("lagrangian") && model.find("coordinates")) return typed::formulaOf(model);
    if (const auto* const form = scene.system->parts.find<WrittenForm>())
        return typed::formulaOf(form->settings);
    if (!entry->lagrangian) return {};
    typed::Formula formula;
    // Coordinates that are numbered, "1", "2", .., are q1, q2, ..
    for (const Coordinate& c : scene.system->coordinates)
        formula.coordinates.push_back((c.name.front() >= '0' && c.name.front() <= '9' ? "q" : "") + c.name);
    for (const auto& [key, value] : model.keys)
        if (value.isNumber()) formula.parameters.emplace_back(key, value.asNumber());
    formula.text = entry->lagrangian(model);
    return formula;
}

std::vector<std::string> modelsWithFormula() {
    std::vector<std::string> ids;
    for (const ModelEntry& entry : modelCatalog())
        if (entry.lagrangian) ids.push_back(entry.item.id);
    return ids;
}

}  // namespace extremal
