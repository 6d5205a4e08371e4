// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/quadrature/catalog.hpp"

#include <algorithm>

namespace extremal {

const std::vector<const RuleEntry*>& rulesByPlace() {
    static const std::vector<const RuleEntry*> all = [] {
        std::vector<const RuleEntry*> entries;
        for (const RuleEntry& e : ruleEntries()) entries.push_back(&e);
        std::stable_sort(entries.begin(), entries.end(),
                         [](const RuleEntry* a, const RuleEntry* b) { return a->place < b->place; });
        return entries;
    }();
    return all;
}

const std::vector<CatalogItem>& quadratureCatalog() {
    static const std::vector<CatalogItem> all = [] {
        std::vector<CatalogItem> items;
        for (const RuleEntry* e : rulesByPlace()) items.push_back(e->item);
        return items;
    }();
    return all;
}

const RuleEntry* findRule(std::string_view id) {
    for (const RuleEntry& e : ruleEntries())
        if (e.item.id == id) return &e;
    return nullptr;
}

Settings completeRule(const Settings& rule, const RuleDemand& demand) {
    const RuleEntry* const entry = findRule(rule.type);
    if (!entry) return rule;
    Settings complete = rule;
    for (const FieldInfo& field : entry->item.parameters) {
        Value value = field.fallback;
        if (field.key == "nodes" && entry->nodes) value = demand.nodes.value_or(entry->nodes(demand.degree));
        if (field.key == "panels") value = std::max(1, demand.cells);
        if (field.key == "phases") value = 4 * demand.harmonic + 4;
        const auto there = std::find_if(complete.keys.begin(), complete.keys.end(),
                                        [&](const Value::Member& m) { return m.first == field.key; });
        if (there == complete.keys.end() && value.isNull()) continue;
        if (there == complete.keys.end())
            complete.keys.emplace_back(field.key, std::move(value));
        else if (there->second.isNull())
            there->second = std::move(value);
    }
    return complete;
}

}  // namespace extremal
