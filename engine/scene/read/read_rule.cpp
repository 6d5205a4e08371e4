// SPDX-License-Identifier: GPL-3.0-or-later
/// The quadrature of a scheme: one rule with what it leaves to the space, one for each direction, or one for
/// each term.
#include "engine/family/scheme.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"

namespace extremal {
namespace {

/// What a rule leaves to the space, as its number of nodes.
std::optional<Value> fitToSpace(std::string_view rule, std::string_view key, const Settings& space) {
    const Settings fitting = completeQuadrature(space, {std::string(rule), {}, {}});
    const Value* value = fitting.find(key);
    return value ? std::optional(*value) : std::nullopt;
}

/// The same in one direction, which the degree is of.
std::optional<Value> fitToDegree(std::string_view rule, std::string_view key, const Settings& direction) {
    const Settings fitting = completeRule({std::string(rule), {}, {}}, {direction.integer("degree")});
    const Value* value = fitting.find(key);
    return value ? std::optional(*value) : std::nullopt;
}

bool isAutomatic(const Value* quadrature) {
    if (!quadrature) return true;
    const Value* type = quadrature->isString() ? quadrature : quadrature->find("type");
    return type && *type == Value("auto");
}

std::vector<const CatalogItem*> singleRules() {
    std::vector<const CatalogItem*> items;
    for (const CatalogItem& item : quadratureCatalog())
        if (!isTensorRule({item.id, {}, {}}) && !isTermRule({item.id, {}, {}})) items.push_back(&item);
    return items;
}

/// A product needs no type: it is known by its directions.
bool isProductValue(const Value& value) {
    const Value* type = value.isString() ? &value : value.find("type");
    if (type) return *type == Value("product");
    return value.find("space") || value.find("time") || value.find(acrossPart);
}

/// The degree of a space in one direction: degrees may be given for each.
double degreeIn(const Settings& space, const char* direction) {
    const Value* degree = space.find("degree");
    const Value* own = degree && degree->isObject() ? degree->find(direction) : nullptr;
    return own && own->isNumber() ? own->asNumber() : space.number("degree");
}

std::optional<Settings> readProduct(Reader& reader, const Value& value, const std::string& pointer,
                                    const Settings& space) {
    if (!reader.isObject(value, pointer)) return {};
    const std::size_t errorsBefore = reader.errors.size();
    reader.checkKeys(value, pointer, {"type", tensorParts[0], acrossPart, tensorParts[1]});
    Settings product{"product", {}, {}};
    for (const char* direction : {tensorParts[0], acrossPart, tensorParts[1]}) {
        const std::string place = childPointer(pointer, direction);
        const Value* const given = value.find(direction);
        if (!given) {
            if (direction == acrossPart) continue;
            reader.error(place, std::string("is required: the rule in ") + direction,
                         "for example \"" + std::string(direction) + "\": \"gauss\"");
            continue;
        }
        const char* const ofDegree = direction == acrossPart ? tensorParts[0] : direction;
        const Settings context{"", {{"degree", degreeIn(space, ofDegree)}}, {}};
        const Value gauss("gauss");
        auto part = readSettings(reader, isAutomatic(given) ? gauss : *given, place, "quadrature",
                                 singleRules(), fitToDegree, context);
        if (!part) continue;
        const Value written = settingsValue(*part);
        const bool hasExpression = !part->expressions.empty();
        part->expressions.clear();
        product.keys.emplace_back(direction, settingsValue(*part));
        if (hasExpression) product.expressions.emplace_back(direction, written);
    }
    if (reader.errors.size() > errorsBefore) return {};
    return product;
}

/// Terms need no type: the keys are their names, which only the system knows.
bool isTermsValue(const Value& value) {
    if (!value.isObject()) return false;
    const Value* type = value.find("type");
    return type ? *type == Value("terms") : !value.asObject().empty() && !isProductValue(value);
}

std::optional<Settings> readTermRules(Reader& reader, const Value& value, const std::string& pointer,
                                      const Settings& space) {
    const std::size_t errorsBefore = reader.errors.size();
    Settings all{"terms", {}, {}};
    for (const auto& [name, given] : value.asObject()) {
        if (name == "type") continue;
        const std::string place = childPointer(pointer, name);
        auto part = readSettings(reader, given, place, "quadrature", singleRules(), fitToSpace, space);
        if (!part) continue;
        if (isAutomatic(&given)) part = completeQuadrature(space, {});
        const Value written = settingsValue(*part);
        const bool hasExpression = !part->expressions.empty();
        part->expressions.clear();
        all.keys.emplace_back(name, settingsValue(*part));
        if (hasExpression) all.expressions.emplace_back(name, written);
    }
    if (reader.errors.size() > errorsBefore) return {};
    return all;
}

}  // namespace

std::optional<Settings> readRule(Reader& reader, const Value* given, const std::string& pointer,
                                 const Settings& space) {
    if (given && isProductValue(*given)) return readProduct(reader, *given, pointer, space);
    if (given && isTermsValue(*given)) return readTermRules(reader, *given, pointer, space);
    const Value automatic("auto");
    const auto rule = readSettings(reader, given ? *given : automatic, pointer, "quadrature", singleRules(),
                                   fitToSpace, space);
    if (!rule) return {};
    return isAutomatic(given) ? completeQuadrature(space, {}) : *rule;
}

Value ruleValue(const Settings& rule) {
    const Value whole = settingsValue(rule);
    if (!isTensorRule(rule) && !isTermRule(rule)) return whole;
    Value value{Value::Object{}};
    for (const auto& [key, part] : whole.asObject())
        if (key != "type") value.set(key, part);
    return value;
}

}  // namespace extremal
