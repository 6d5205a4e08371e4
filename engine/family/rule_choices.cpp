#include "engine/family/rule_choices.hpp"

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

ChoiceGrid ruleChoices(const std::vector<SpaceRow>& rows) {
    std::vector<const RuleEntry*> columns;
    for (const RuleEntry* rule : rulesByPlace())
        if (!rule->heading.empty()) columns.push_back(rule);
    ChoiceGrid grid;
    for (const RuleEntry* column : columns) grid.columns.push_back({column->heading, column->item.title});
    for (const SpaceRow& row : rows) {
        std::string description;
        for (const RuleEntry* column : columns) {
            ChoiceGrid::Cell cell;
            cell.discretization = {row.space, completeQuadrature(row.space, {column->item.id, {}, {}}), {}};
            const Properties known = describe(cell.discretization);
            const std::string order = std::to_string(known.claims.order);
            cell.id = row.idPrefix + std::to_string(row.space.integer("degree")) + "." + column->item.id;
            cell.text = abbreviation(known.knownAs);
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
