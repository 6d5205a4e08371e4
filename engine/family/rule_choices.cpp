// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/rule_choices.hpp"

#include <algorithm>
#include <utility>

#include "engine/family/family.hpp"
#include "engine/quadrature/catalog.hpp"

namespace extremal {
namespace {

/// Cells are small: well-known names have well-known abbreviations.
std::string abbreviation(const std::string& knownAs) {
    if (knownAs.find("midpoint") != std::string::npos) return "mid";
    if (knownAs.find("Verlet") != std::string::npos) return "SV";
    if (knownAs.find("trapez") != std::string::npos) return "trap";
    return {};
}

bool isTyped(const RuleEntry& rule) {
    return std::any_of(rule.item.parameters.begin(), rule.item.parameters.end(),
                       [](const FieldInfo& f) { return f.type == FieldType::formulas && !f.isOptional; });
}

/// The nodes of Gauss's rule as they are typed, 1 to 3 of them exactly.
Value::Array gaussNodes(int count) {
    switch (count) {
        case 1:
            return {"1/2"};
        case 2:
            return {"(3-sqrt(3))/6", "(3+sqrt(3))/6"};
        case 3:
            return {"(5-sqrt(15))/10", "1/2", "(5+sqrt(15))/10"};
        default: {
            const Rule<double> rule = gauss<double>(count);
            return {rule.c.begin(), rule.c.end()};
        }
    }
}

Discretization discretizationOf(const Settings& space, const RuleEntry& rule) {
    Settings quadrature{rule.item.id, {}, {}};
    if (isTyped(rule)) {
        const Value* const functions = space.find("functions");
        const int size =
            functions ? static_cast<int>(functions->asArray().size()) - 1 : space.integer("degree");
        quadrature.keys.emplace_back("nodes", gaussNodes(std::max(1, size)));
    }
    return {space, completeQuadrature(space, quadrature), {}};
}

}  // namespace

std::vector<std::string> plainRules() {
    std::vector<std::string> ids{"gauss"};
    for (const RuleEntry* rule : rulesByPlace())
        if (rule->make && rule->item.id != ids.front()) ids.push_back(rule->item.id);
    return ids;
}

bool isPlainRule(const Settings& quadrature) {
    const RuleEntry* const rule = findRule(quadrature.type);
    return rule && rule->make;
}

void refuseRule(const Settings& quadrature, Properties& properties) {
    const RuleEntry* const rule = findRule(quadrature.type);
    properties.refusal = rule ? rule->refusal : "there is no rule \"" + quadrature.type + "\"";
    properties.hint = rule ? rule->hint : "extremal list quadratures";
    properties.shortName = "-";
}

void refuse(const InvalidScene& error, Properties& properties) {
    const Problem& problem = error.problems().front();
    properties.refusal = problem.message;
    properties.hint = problem.hint;
    if (problem.pointer.find('/', 1) != std::string::npos) properties.place = problem.pointer;
}

ChoiceGrid ruleChoices(const std::vector<SpaceRow>& rows, const std::vector<std::string>& further) {
    std::vector<const RuleEntry*> columns;
    for (const RuleEntry* rule : rulesByPlace())
        if (!rule->heading.empty()) columns.push_back(rule);
    const auto takers = [&](const RuleEntry* column) {
        return std::count_if(rows.begin(), rows.end(), [&](const SpaceRow& row) {
            return describe(discretizationOf(row.space, *column)).refusal.empty();
        });
    };
    const auto most = static_cast<std::ptrdiff_t>(rows.size());
    std::erase_if(columns, [&](const RuleEntry* c) { return isTyped(*c) && 2 * takers(c) <= most; });
    for (const std::string& id : further)
        if (const RuleEntry* rule = findRule(id); takers(rule) > 0) {
            std::erase_if(columns, [&](const RuleEntry* c) { return takers(c) == 0; });  // to make room
            columns.push_back(rule);
        }
    ChoiceGrid grid;
    for (const RuleEntry* column : columns)
        grid.columns.push_back(
            {column->heading.empty() ? column->item.id : column->heading, column->item.title});
    for (const SpaceRow& row : rows) {
        std::string description;
        for (const RuleEntry* column : columns) {
            ChoiceGrid::Cell cell;
            cell.discretization = discretizationOf(row.space, *column);
            cell.isOwn = isTyped(*column) || row.space.find("functions");
            const Properties known = describe(cell.discretization);
            const std::string order = std::to_string(known.claims.order);
            cell.id = row.idPrefix + std::to_string(row.space.integer("degree")) + "." + column->item.id;
            cell.text = isTyped(*column) ? std::string() : abbreviation(known.knownAs);
            if (cell.text.empty())
                cell.text = column->letter + order;
            else
                cell.superscript = order;
            cell.title = known.space + " × " + column->item.title;
            description = known.space;
            grid.cells.push_back(std::move(cell));
        }
        grid.rows.push_back({row.text, description});
    }
    return grid;
}

Settings completePlainRule(const Settings& quadrature, int degree, int cells) {
    const bool isAutomatic = quadrature.type.empty() || quadrature.type == "auto";
    return completeRule(isAutomatic ? Settings{"gauss", {}, {}} : quadrature, {degree, cells});
}

}  // namespace extremal
