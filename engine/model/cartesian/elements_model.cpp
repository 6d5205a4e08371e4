// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/elements_model.hpp"

#include "engine/core/problem.hpp"

namespace extremal::cartesian {
namespace {

FieldInfo elementsField(const ElementKind& kind) {
    FieldInfo field = optionalJsonField(kind.key, kind.key, kind.description + " By name, with the keys ");
    for (const FieldInfo& info : kind.fields) {
        const bool isFirst = &info == &kind.fields.front(), isLast = &info == &kind.fields.back();
        field.description += (isFirst ? "" : isLast ? " and " : ", ") + info.key;
        if (!info.unit.empty()) field.description += " (" + info.unit + ")";
    }
    field.description += ".";
    field.symbol.clear();
    return field;
}

}  // namespace

std::vector<FieldInfo> elementsFields(const std::vector<ElementKind>& kinds,
                                      const std::vector<std::pair<std::string, Value>>& examples) {
    std::vector<FieldInfo> fields{
        constantsField("parameters", "Constants by name; numbers of elements may be formulas in them."),
        numberField("gravity", "gravity", "m/s²", 9.81, "Acceleration of gravity, downwards.")};
    for (const ElementKind& kind : kinds) {
        fields.push_back(elementsField(kind));
        for (const auto& [key, example] : examples)
            if (key == kind.key) fields.back().example = example;
    }
    return fields;
}

System systemOf(const WrittenForm& form) {
    System s;
    try {
        s = findModel("lagrangian")->make(form.settings);
    } catch (const InvalidScene& e) {
        std::vector<Problem> problems = e.problems();
        for (Problem& p : problems) p.pointer = form.originOf(p.pointer);
        throw InvalidScene(std::move(problems));
    }
    s.timeUnit = "s";
    s.energyUnit = "J";
    return s;
}

DrawnRods drawnRods(const std::vector<std::string>& names, std::size_t first) {
    DrawnRods rods;
    for (std::size_t k = 0; k < names.size(); ++k) rods.all.push_back({first + k, names[k]});
    return rods;
}

}  // namespace extremal::cartesian
