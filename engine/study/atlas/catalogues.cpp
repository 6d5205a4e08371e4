// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/atlas/catalogues.hpp"

#include <algorithm>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme_claims.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/model/profiles.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/space/catalog.hpp"
#include "engine/study/catalog.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

template <class Entries>
std::vector<CatalogItem> itemsOf(const Entries& entries) {
    std::vector<CatalogItem> items;
    for (const auto& entry : entries) items.push_back(entry.item);
    return items;
}

std::vector<CatalogItem> presetItems() {
    std::vector<CatalogItem> items;
    for (const Preset& preset : presets()) {
        const Value scene = parseJson(preset.json);  // reading them as scenes would take seconds
        const auto text = [&](const char* key) {
            const Value* const value = scene.find(key);
            return value && value->isString() ? value->asString() : std::string();
        };
        CatalogItem item;
        item.id = std::string(preset.id);
        item.title = text("title");
        item.description = text("lesson");
        items.push_back(item);
    }
    return items;
}

Value claimsValue(const Claims& claims) {
    Value::Array conserves;
    for (const std::string& c : claims.conserves) conserves.emplace_back(c);
    Value value{Value::Object{}};
    value.set("order", claims.order);
    value.set("symmetric", claims.isSymmetric);
    value.set("symplectic", claims.isSymplectic);
    value.set("conserves", conserves);
    return value;
}

/// Schemes claim what their discretizations do: of those with degrees, `claims` are of the lowest, with a
/// formula of the order where there is one, and "claims_by_degree" of the first eight.
Catalogue schemes() {
    Catalogue kind{"schemes", itemsOf(schemeCatalog())};
    for (std::size_t i = 0; i < kind.items.size(); ++i) {
        const auto claims = claimsByDegree(schemeCatalog()[i], 8);
        Value more{Value::Object{}}, lowest = claimsValue(claims.front().claims);
        if (const std::string formula = orderFormula(claims); !formula.empty())
            lowest.set("order_formula", formula);
        more.set("claims", lowest);
        more.set("needs", kind.items[i].needs);
        if (claims.size() > 1) {
            Value::Array all;
            for (const DegreeClaims& c : claims) {
                const Value claimed = claimsValue(c.claims);
                Value entry(Value::Object{{"degree", c.degree}});
                for (const auto& [key, value] : claimed.asObject()) entry.set(key, value);
                all.push_back(entry);
            }
            more.set("claims_by_degree", all);
        }
        kind.more.push_back(more);
    }
    return kind;
}

std::string typeName(FieldType type) {
    switch (type) {
        case FieldType::number:
            return "number";
        case FieldType::numbers:
            return "numbers";
        case FieldType::integer:
            return "integer";
        case FieldType::boolean:
            return "boolean";
        case FieldType::text:
            return "text";
        case FieldType::choice:
            return "choice";
        case FieldType::names:
            return "names";
        case FieldType::constants:
            return "constants";
        case FieldType::formulas:
            return "formulas";
        case FieldType::definitions:
            return "definitions";
        case FieldType::terms:
            return "text";
        case FieldType::json:
            return "json";
    }
    return {};
}

Value fieldValue(const FieldInfo& field) {
    Value value{Value::Object{}};
    value.set("key", field.key);
    value.set("type", typeName(field.type));
    value.set("unit", field.unit);
    value.set("default", field.fallback);
    value.set("min", field.min);  // JSON writes an infinity as null
    value.set("max", field.max);
    value.set("description", field.description.empty() ? field.title : field.description);
    if (!field.choices.empty()) {
        Value::Array choices;
        for (const std::string& c : field.choices) choices.emplace_back(c);
        value.set("choices", choices);
    }
    return value;
}

Value itemValue(const CatalogItem& item) {
    Value value{Value::Object{}};
    value.set("id", item.id);
    value.set("title", item.title);
    value.set("description", item.description);
    Value::Array parameters;
    for (const FieldInfo& field : item.parameters) parameters.push_back(fieldValue(field));
    value.set("parameters", parameters);
    if (!item.claims) return value;
    value.set("claims", claimsValue(*item.claims));
    value.set("needs", item.needs);
    return value;
}

}  // namespace

const std::vector<Catalogue>& catalogues() {
    static const std::vector<Catalogue> all = {{"models", itemsOf(modelCatalog())},
                                               {"spaces", spaceCatalog()},
                                               {"quadratures", quadratureCatalog()},
                                               schemes(),
                                               {"baselines", itemsOf(baselineCatalog())},
                                               {"compositions", compositionCatalog()},
                                               {"observables", observableCatalog()},
                                               {"studies", studyCatalog()},
                                               {"views", viewCatalog()},
                                               {"profiles", profileCatalog()},
                                               {"presets", presetItems()}};
    return all;
}

const Catalogue* findCatalogue(std::string_view name) {
    const auto found = std::find_if(catalogues().begin(), catalogues().end(),
                                    [&](const Catalogue& c) { return c.name == name; });
    return found == catalogues().end() ? nullptr : &*found;
}

Value catalogueValue(const Catalogue& catalogue) {
    Value::Array items;
    for (std::size_t i = 0; i < catalogue.items.size(); ++i) {
        Value value = itemValue(catalogue.items[i]);
        if (!catalogue.more.empty())
            for (const auto& [key, member] : catalogue.more[i].asObject()) value.set(key, member);
        items.push_back(value);
    }
    return items;
}

}  // namespace extremal
