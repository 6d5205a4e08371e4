// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/parameters_page.hpp"

#include <cmath>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/family/scheme.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/space/catalog.hpp"

namespace extremal::tools {
namespace {

std::string rangeOf(const FieldInfo& f) {
    if (f.type == FieldType::choice) {
        std::string all;
        for (const std::string& c : f.choices) all += (all.empty() ? "`" : ", `") + c + "`";
        return all;
    }
    if (f.type == FieldType::boolean) return "`true`, `false`";
    if (f.type == FieldType::text || f.type == FieldType::json) return "";
    if (f.type == FieldType::formulas) return "array of expressions";
    if (f.type == FieldType::definitions) return "object of expressions";
    const std::string kind = f.type == FieldType::integer ? "integer" : "number";
    const bool hasMin = std::isfinite(f.min), hasMax = std::isfinite(f.max);
    if (hasMin && hasMax) return kind + ", " + formatNumber(f.min) + " to " + formatNumber(f.max);
    if (hasMin) return kind + (f.isMinExcluded ? " above " : " from ") + formatNumber(f.min);
    return kind;
}

std::string fallbackOf(const FieldInfo& f) {
    if (f.fallback.isNumber()) return formatNumber(f.fallback.asNumber());
    if (f.fallback.isString()) return f.fallback.asString().empty() ? "" : "`" + f.fallback.asString() + "`";
    if (f.fallback.isBool()) return f.fallback.asBool() ? "`true`" : "`false`";
    return "";
}

std::string keysOf(const std::vector<CatalogItem>& items) {
    std::string text;
    for (const CatalogItem& item : items) {
        text += "\n### " + item.id + "\n\n" + item.description + "\n";
        if (item.parameters.empty()) continue;
        text += "\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
        for (const FieldInfo& f : item.parameters)
            text +=
                "| `" + f.key + "` | " + rangeOf(f) + " | " + fallbackOf(f) + " | " + f.description + " |\n";
    }
    return text;
}

std::string limitText(double limit) {
    return std::isinf(limit) ? "∞" : formatNumber(std::round(limit * 1000) / 1000);
}

/// "G6: order 6, ∞" for degrees 1 to 8 of polynomials and each rule with its default nodes.
std::string pairsTable() {
    std::string text = "\n| degree |";
    std::vector<std::string> rules;
    for (const CatalogItem& rule : quadratureCatalog()) {
        // Of one direction or one term each, and those without defaults.
        if (isTensorRule({rule.id, {}, {}}) || isTermRule({rule.id, {}, {}}) || rule.id == "nodes") continue;
        const Settings space{"polynomial", {{"degree", 2.0}, {"basis", "lobatto"}}, {}};
        const Settings complete = completeQuadrature(space, {rule.id, {}, {}});
        if (complete.type != rule.id) continue;  // "auto" is one of the others
        rules.push_back(rule.id);
        text += " `" + rule.id + "` |";
    }
    text += "\n| --- |";
    for (std::size_t i = 0; i < rules.size(); ++i) text += " --- |";
    text += "\n";
    for (int s = 1; s <= 8; ++s) {
        const Settings space{"polynomial", {{"degree", static_cast<double>(s)}, {"basis", "lobatto"}}, {}};
        text += "| " + std::to_string(s) + " |";
        for (const std::string& rule : rules) {
            const Properties known = describe(space, completeQuadrature(space, {rule, {}, {}}));
            text += known.refusal.empty() ? " " + std::to_string(known.claims.order) + ", " +
                                                limitText(known.stabilityLimit) + " |"
                                          : " – |";
        }
        text += "\n";
    }
    return text;
}

}  // namespace

std::string parametersPage() {
    return "# Keys of spaces and quadratures\n\nThis page is generated from the descriptors that also "
           "define the checks of scenes and the forms of the window; a test compares the two. Spaces and "
           "rules are explained in [Spaces](spaces.md) and [Quadratures](quadratures.md).\n\n"
           "## Spaces\n" +
           keysOf(spaceCatalog()) + "\n## Quadratures\n" + keysOf(quadratureCatalog()) +
           "\n## Claims of the discretizations\n\nPolynomials of each degree with each rule and its default "
           "number of nodes: the order, and the step times frequency up to which every step is stable on the "
           "harmonic oscillator (∞: without end). A dash marks a discretization that is refused; the "
           "discretizer "
           "shows the reason. The orders are [measured](orders.md).\n" +
           pairsTable();
}

}  // namespace extremal::tools
