#include <algorithm>
#include <cmath>

#include "app/report.hpp"
#include "app/verbs.hpp"
#include "engine/baseline/catalog.hpp"
#include "engine/core/text.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/family/scheme_claims.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/view/catalog.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/scene/codec.hpp"
#include "engine/scene/json.hpp"
#include "engine/study/catalog.hpp"
#include "engine/scene/preset.hpp"
#include "engine/space/catalog.hpp"

namespace extremal::app {
namespace {

struct Kind {
    std::string name;
    std::vector<CatalogItem> items;
    std::vector<Value> more = {};  ///< further members of each item; may be empty
};

template <class Entries>
std::vector<CatalogItem> itemsOf(const Entries& entries) {
    std::vector<CatalogItem> items;
    for (const auto& entry : entries) items.push_back(entry.item);
    return items;
}

std::vector<CatalogItem> presetItems() {
    std::vector<CatalogItem> items;
    for (const Preset& preset : presets()) {
        const Scene scene = readScene(preset.json).scene;
        CatalogItem item;
        item.id = std::string(preset.id);
        item.title = scene.title;
        item.description = scene.lesson;
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
Kind schemeKind() {
    Kind kind{"schemes", itemsOf(schemeCatalog())};
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

std::vector<Kind> kinds() {
    return {{"models", itemsOf(modelCatalog())},
            {"spaces", spaceCatalog()},
            {"quadratures", quadratureCatalog()},
            schemeKind(),
            {"baselines", itemsOf(baselineCatalog())},
            {"compositions", compositionCatalog()},
            {"observables", observableCatalog()},
            {"studies", studyCatalog()},
            {"views", viewCatalog()},
            {"profiles", {}},
            {"presets", presetItems()}};
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

Value kindValue(const Kind& kind) {
    Value::Array items;
    for (std::size_t i = 0; i < kind.items.size(); ++i) {
        Value value = itemValue(kind.items[i]);
        if (!kind.more.empty())
            for (const auto& [key, member] : kind.more[i].asObject()) value.set(key, member);
        items.push_back(value);
    }
    return items;
}

/// "degree 1..24, basis lobatto|chebyshev": what can be set, in one line.
std::string parameterText(const CatalogItem& item) {
    std::string text;
    for (const FieldInfo& field : item.parameters) {
        if (!text.empty()) text += ", ";
        text += field.key;
        if (!field.fallback.isNull())
            text.append(" = ").append(field.fallback.isString() ? field.fallback.asString()
                                                                : writeCompactJson(field.fallback));
        if (!field.unit.empty()) text.append(" ").append(field.unit);
    }
    return text.empty() ? text : " {" + text + "}";
}

std::string kindText(const Kind& kind, const std::string& indent) {
    Table table;
    for (const CatalogItem& item : kind.items) {
        std::string words = item.title;
        if (!item.description.empty()) words.append(": ").append(item.description);
        table.rows.push_back({indent + item.id, words + parameterText(item)});
    }
    return table.text();
}

}  // namespace

int listVerb(const std::string& wanted, const CommonOptions& options) {
    const std::vector<Kind> all = kinds();
    std::vector<std::string> names;
    for (const Kind& kind : all) names.push_back(kind.name);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Kind& k) { return k.name == wanted; });
    if (!wanted.empty() && found == all.end()) {
        printProblem("list", "unknown kind \"" + wanted + "\"", suggestName(wanted, names));
        return unusable;
    }
    if (options.isJson && !wanted.empty()) return print(writeJson(kindValue(*found)), done);
    if (!wanted.empty()) return print(kindText(*found, ""), done);
    Value document{Value::Object{}};
    std::string text;
    for (const Kind& kind : all) {
        document.set(kind.name, kindValue(kind));
        if (kind.items.empty()) continue;
        if (!text.empty()) text += '\n';
        text.append(kind.name).append("\n").append(kindText(kind, "  "));
    }
    return print(options.isJson ? writeJson(document) : text, done);
}

}  // namespace extremal::app
