// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/write/schema.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/model/system.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/phase/monitor.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/write/format.hpp"
#include "engine/space/catalog.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

Value typed(const char* type, const char* description = "") {
    Value v{Value::Object{}};
    v.set("type", type);
    if (*description) v.set("description", description);
    return v;
}

Value reference(const char* definition) {
    Value v{Value::Object{}};
    v.set("$ref", std::string("#/$defs/") + definition);
    return v;
}

Value strings(const std::vector<std::string>& texts) {
    Value::Array all;
    for (const std::string& t : texts) all.emplace_back(t);
    return all;
}

Value enumeration(const std::vector<std::string>& texts) {
    Value v{Value::Object{}};
    v.set("enum", strings(texts));
    return v;
}

Value anyOf(std::vector<Value> choices) {
    Value v{Value::Object{}};
    v.set("anyOf", Value(std::move(choices)));
    return v;
}

Value arrayOf(Value items, const char* description = "") {
    Value v = typed("array", description);
    v.set("items", std::move(items));
    return v;
}

Value object(Value properties, const std::vector<std::string>& required, const char* description = "") {
    Value v = typed("object", description);
    v.set("properties", std::move(properties));
    if (!required.empty()) v.set("required", strings(required));
    v.set("additionalProperties", false);
    return v;
}

/// A number, or an expression whose value only the program knows.
Value numberOf(const FieldInfo& field) {
    Value number = typed(field.type == FieldType::integer ? "integer" : "number");
    if (std::isfinite(field.min)) number.set(field.isMinExcluded ? "exclusiveMinimum" : "minimum", field.min);
    if (std::isfinite(field.max)) number.set("maximum", field.max);
    Value::Array allowed;
    if (field.type == FieldType::integer)
        for (const std::string& choice : field.choices) allowed.emplace_back(parseNumber(choice).value_or(0));
    if (!allowed.empty()) number.set("enum", std::move(allowed));
    return anyOf({number, typed("string")});
}

Value property(const FieldInfo& field) {
    Value v{Value::Object{}};
    switch (field.type) {
        case FieldType::number:
        case FieldType::integer:
            v = numberOf(field);
            break;
        case FieldType::numbers:
            v = typed("array");
            v.set("items", numberOf(field));
            v.set("minItems", static_cast<double>(field.components.size()));
            v.set("maxItems", static_cast<double>(field.components.size()));
            break;
        case FieldType::boolean:
            v = typed("boolean");
            break;
        case FieldType::text:
            v = typed("string");
            break;
        case FieldType::terms: {
            Value byName = typed("object");
            byName.set("additionalProperties", typed("string"));
            v = anyOf({typed("string"), byName});
            break;
        }
        case FieldType::choice:
            v = enumeration(field.choices);
            break;
        case FieldType::names:
            v = arrayOf(typed("string"));
            break;
        case FieldType::formulas:
            v = arrayOf(reference("number"));
            break;
        case FieldType::definitions:
        case FieldType::constants:
            v = typed("object");
            v.set("additionalProperties", reference("number"));
            break;
        case FieldType::json:
            break;
    }
    const std::string& words = field.description.empty() ? field.title : field.description;
    v.set("description", field.unit.empty() ? words : words + " Unit: " + field.unit + ".");
    if (!field.fallback.isNull()) v.set("default", field.fallback);
    return v;
}

/// {"type": ID, keys...} for each entry, or the bare name where no key is required.
template <class Entries>
Value typedChoice(const Entries& entries) {
    std::vector<Value> choices;
    std::vector<std::string> names;
    for (const auto& entry : entries) {
        const CatalogItem* item = nullptr;
        if constexpr (requires { entry.item; })
            item = &entry.item;
        else
            item = &entry;
        Value properties{Value::Object{}}, type{Value::Object{}};
        type.set("const", item->id);
        properties.set("type", type);
        for (const FieldInfo& field : item->parameters) properties.set(field.key, property(field));
        choices.push_back(object(properties, {"type"}, item->description.c_str()));
        names.push_back(item->id);
    }
    choices.push_back(enumeration(names));
    return anyOf(std::move(choices));
}

/// One rule, or one for each direction, or one for each term.
Value quadratureChoice() {
    Value product{Value::Object{}};
    for (const char* direction : {tensorParts[0], acrossPart, tensorParts[1]})
        product.set(direction, reference("rule"));
    Value terms = typed("object", findRule("terms")->item.description.c_str());
    terms.set("additionalProperties", reference("rule"));
    return anyOf(
        {reference("rule"),
         object(product, {tensorParts[0], tensorParts[1]}, findRule("product")->item.description.c_str()),
         terms});
}

Value ruleDefinition() {
    std::vector<CatalogItem> single;
    for (const CatalogItem& item : quadratureCatalog())
        if (!isTensorRule({item.id, {}, {}}) && !isTermRule({item.id, {}, {}})) single.push_back(item);
    return typedChoice(single);
}

Value namedSchemes() {
    std::string pattern;
    for (const SchemeEntry& entry : schemeCatalog()) {
        if (!pattern.empty()) pattern += '|';
        pattern += entry.item.id.substr(0, entry.item.id.find('<'));
        if (entry.maxDegree > 0) pattern += "[1-9][0-9]*";
    }
    Value v = typed("string", "A named scheme.");
    v.set("pattern", "^(" + pattern + ")$");
    return v;
}

Value schemeDefinition() {
    Value solver{Value::Object{}};
    solver.set("method", enumeration({"auto", "newton", "fixed-point", "banded", "dense", "krylov"}));
    solver.set("tolerance", reference("number"));
    solver.set("max_iterations", reference("number"));
    Value p{Value::Object{}};
    p.set("label", typed("string", "Unique; made from the parts if left out."));
    p.set("enabled", typed("boolean"));
    p.set("style", typed("integer", "Colour and dash, from 1; the place of the scheme if left out."));
    p.set("step", reference("number"));
    p.set("tolerance", reference("number"));
    p.set("space", typedChoice(spaceCatalog()));
    p.set("quadrature", quadratureChoice());
    p.set("baseline", typedChoice(baselineCatalog()));
    p.set("scheme", namedSchemes());
    p.set("composition", typedChoice(compositionCatalog()));
    p.set("keep", anyOf({enumeration({"symplectic", "energy"}), arrayOf(typed("string"))}));
    p.set("impact", enumeration(format::impactLaws));
    p.set(
        "monitor",
        anyOf({typedChoice(monitorCatalog()),
               typed("string", "An expression in coordinates and momenta: steps are in proportion to it.")}));
    p.set("solver", object(solver, {}));
    p.set("allow_unstable", typed("boolean", "Accept a discretization that is unstable for every step."));
    return object(p, {}, "A row of the comparison: a space and a quadrature, a baseline, or a named scheme.");
}

Value initialData() {
    const Value vector = reference("vector");
    Value p{Value::Object{}};
    p.set("q", vector);
    p.set("p", vector);
    p.set("v", vector);
    p.set("q1", vector);
    p.set("at", reference("number"));
    p.set("project", typed("boolean", "Whether q may be moved onto the constraints of the model."));
    for (const ModelEntry& entry : modelCatalog())
        for (const FieldInfo& field : entry.initial)
            if (!p.find(field.key)) p.set(field.key, property(field));
    Value data = object(p, {},
                        "Coordinates, and momenta, velocities or a second position (q1, a time `at` later); "
                        "or the keys of the model.");
    // Points on spheres and components of fields, by names of the user's own.
    data.set("additionalProperties", anyOf({arrayOf(reference("number")), reference("number")}));
    return data;
}

Value referenceChoice() {
    Value p{Value::Object{}};
    p.set("type", enumeration(format::referenceKinds));
    p.set("scheme", reference("scheme"));
    p.set("path", typed("string", "A CSV file with t and the state columns, relative to the scene."));
    return anyOf({object(p, {"type"}), enumeration(format::plainReferences)});
}

Value definitions() {
    Value byName = typed("object");
    byName.set("additionalProperties", reference("number"));
    Value number = anyOf({typed("number"), typed("string")});
    number.set("description", "A number, or an expression in the model's parameters.");
    Value d{Value::Object{}};
    d.set("number", number);
    d.set("vector", anyOf({arrayOf(reference("number")), byName}));
    d.set("rule", ruleDefinition());
    d.set("scheme", schemeDefinition());
    return d;
}

Value viewChoice() {
    Value p{Value::Object{}};
    p.set("view", enumeration(idsOf(viewCatalog())));
    p.set("x", typed("string", "A column, for phase portraits, trajectories and sections."));
    p.set("y", typed("string", "A column, for phase portraits, trajectories and sections."));
    p.set("at", typed("string", "The column whose zeros make a section."));
    p.set("scheme", typed("string", "The label of a scheme, for pictures of one."));
    p.set("node", reference("number"));
    Value ends = arrayOf(reference("number")), range{Value::Object{}};
    ends.set("minItems", 2);
    ends.set("maxItems", 2);
    range.set("x", ends);
    range.set("y", ends);
    p.set("range",
          object(range, {}, "The part that the plot shows at first: two increasing numbers for an axis."));
    p.set("log", typed("boolean", "Whether the axis y is logarithmic, where something is positive."));
    p.set("curve", typed("string", "An expression in the variable along x, drawn for comparison."));
    p.set("starts", arrayOf(ends));
    Value size{Value::Object{}};
    for (const std::string& key : format::cardSize) size.set(key, reference("number"));
    p.set("size", object(size, {}, "Of its card in the window, in pixels; widths in the ratio of a row."));
    for (const CatalogItem& item : viewCatalog())
        for (const FieldInfo& field : item.parameters)
            if (!p.find(field.key)) p.set(field.key, property(field));
    return anyOf({enumeration(idsOf(viewCatalog())), object(p, {"view"})});
}

Value lessonStep() {
    Value bounds{Value::Object{}}, byPlace = typed("object", "What the step makes of places of the scene.");
    for (const std::string& key : format::goal) bounds.set(key, reference("number"));
    Value goals = typed("object", "When the step is done: values of places, or bounds on them.");
    goals.set("additionalProperties",
              anyOf({object(bounds, {}), typed("number"), typed("string"), typed("boolean")}));
    Value p{Value::Object{}};
    p.set("text", typed("string", "What the reader is told: Markdown with formulas."));
    p.set("scheme", typed("string", "The label of the scheme that is selected."));
    p.set("view", enumeration(idsOf(viewCatalog())));
    p.set("time", reference("number"));
    p.set("set", byPlace);
    p.set("until", goals);
    return object(p, {"text"}, "A step of a lesson.");
}

Value rootProperties() {
    Value version{Value::Object{}}, time{Value::Object{}}, output{Value::Object{}}, limits{Value::Object{}};
    version.set("const", 1);
    time.set("start", reference("number"));
    time.set("end", reference("number"));
    output.set("every", reference("number"));
    output.set("dense", typed("boolean", "Rows exactly at the multiples, from the scheme's own curve."));
    limits.set("steps", reference("number"));
    Value schemes = arrayOf(reference("scheme"));
    schemes.set("minItems", 1);
    Value p{Value::Object{}};
    p.set("$schema", typed("string"));
    p.set("extremal", version);
    for (const char* key : {"title", "source", "lesson", "notes"}) p.set(key, typed("string"));
    p.set("model", typedChoice(modelCatalog()));
    p.set("initial", initialData());
    p.set("time", object(time, {"end"}));
    p.set("schemes", schemes);
    p.set("reference", referenceChoice());
    p.set("observe", arrayOf(enumeration(idsOf(observableCatalog()))));
    p.set("sensitivity",
          arrayOf(
              typed("string",
                    "A number to differentiate motions by: \"/model/parameters/k\", \"/initial/q/0\", or the "
                    "factor of a term, \"/model/lagrangian/<term>\".")));
    Value event{Value::Object{}};
    event.set("expression",
              typed("string",
                    "An expression in the state: coordinates by name, p_<name>, velocities <name>_t, energy, "
                    "reaction_<constraint>, integral(expression), t."));
    event.set("label", typed("string", "What it is called; by default the expression."));
    event.set("direction", enumeration(format::directions));
    event.set("action", enumeration(format::actions));
    event.set("restitution", typed("number", "Of reflect: the part of the speed that is left, 0 to 1."));
    event.set("parameter",
              typed("string", "Of switch: the parameter of the model that takes another value."));
    event.set("value", reference("number"));
    p.set("events", arrayOf(anyOf({typed("string"), object(event, {"expression"})})));
    p.set("output", object(output, {}));
    p.set("views", arrayOf(viewChoice()));
    Value show{Value::Object{}};
    show.set("time", reference("number"));
    show.set("pinned", reference("number"));
    show.set("layout", enumeration(format::layouts));
    p.set("show", object(show, {}, "How the window shows the scene when it is opened."));
    p.set("limits", object(limits, {}));
    p.set("steps", arrayOf(lessonStep(), "A lesson: what a reader does next, one after the other."));
    return p;
}

}  // namespace

Value sceneSchema() {
    Value schema = object(rootProperties(), {"extremal", "model", "schemes"}, "A comparison for Extremal.");
    Value document{Value::Object{}};
    document.set("$schema", "https://json-schema.org/draft/2020-12/schema");
    document.set("title", "Extremal scene");
    for (const auto& [key, value] : schema.asObject()) document.set(key, value);
    document.set("$defs", definitions());
    return document;
}

}  // namespace extremal
