// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/work.hpp"
#include "engine/family/parts/steps.hpp"
#include "engine/family/parts/test_space.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/phase/kept_step.hpp"
#include "engine/phase/monitor.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/format.hpp"
#include "engine/space/catalog.hpp"

namespace extremal {
namespace {

template <class Entries>
std::vector<const CatalogItem*> itemsOf(const Entries& entries) {
    std::vector<const CatalogItem*> items;
    for (const auto& entry : entries) {
        if constexpr (requires { entry.item; })
            items.push_back(&entry.item);
        else
            items.push_back(&entry);
    }
    return items;
}

/// Spaces inside a space: complete, as objects; what was written is kept where an expression is in it.
bool readSpaceParts(Reader& reader, const std::string& pointer, Settings& space) {
    const std::size_t errorsBefore = reader.errors.size();
    std::vector<const CatalogItem*> single;
    for (const SpaceEntry& entry : tableSpaces())
        if (entry.item.id != space.type) single.push_back(&entry.item);
    const auto readPart = [&](const Value& given, const std::string& place, Value& read, Value& written) {
        auto part = readSettings(reader, given, place, "space", single);
        if (!part) return;
        written = settingsValue(*part);
        part->expressions.clear();
        read = settingsValue(*part);
    };
    for (auto& [key, value] : space.keys) {
        const std::string place = childPointer(pointer, key);
        Value written = value;
        if (key == "otherwise") {
            readPart(Value(value), place, value, written);
        } else if (reader.isObject(value, place)) {
            for (auto& [name, own] : value.asObject())
                readPart(Value(own), childPointer(place, name), own, *written.find(name));
        }
        if (!(written == value)) space.expressions.emplace_back(key, written);
    }
    return reader.errors.size() == errorsBefore;
}

void readSpaceAndQuadrature(Reader& reader, const Value& scheme, const std::string& pointer,
                            SchemeSpec& spec) {
    const std::string place = childPointer(pointer, "space");
    auto space = readSettings(reader, *scheme.find("space"), place, "space", itemsOf(spaceCatalog()));
    if (space && space->find("otherwise") && !readSpaceParts(reader, place, *space)) return;
    if (space) spec.space = *space;
    const auto rule =
        readRule(reader, scheme.find("quadrature"), childPointer(pointer, "quadrature"), spec.space);
    if (rule) spec.quadrature = *rule;
}

std::vector<std::string> schemeNames() {
    std::vector<std::string> names;
    for (const SchemeEntry& entry : schemeCatalog()) {
        if (entry.minDegree == 0 && entry.maxDegree == 0) names.push_back(entry.item.id);
        const std::string stem = entry.item.id.substr(0, entry.item.id.rfind('-'));
        for (int s = entry.minDegree; s <= entry.maxDegree && entry.maxDegree > 0; ++s)
            names.push_back(stem + "-" + std::to_string(s));
    }
    return names;
}

std::vector<std::string> schemeFamilies() {
    std::vector<std::string> names;
    for (const SchemeEntry& entry : schemeCatalog()) names.push_back(entry.item.id);
    return names;
}

void readNamed(Reader& reader, const Value& value, const std::string& pointer, SchemeSpec& spec) {
    const auto name = reader.text(value, pointer);
    if (!name) return;
    if (namedScheme(*name)) {
        spec.named = *name;
        return;
    }
    const auto names = schemeNames();
    const std::string near = nearestName(*name, names);
    reader.error(pointer, "unknown scheme " + describeValue(*name),
                 near.empty() ? "known: " + joinNames(schemeFamilies()) : "did you mean \"" + near + "\"?");
}

/// A method must be known, and solve the equations of this scheme.
bool checkSolverMethod(Reader& reader, const std::string& method, const std::string& place,
                       const SchemeSpec& spec) {
    std::vector<std::string> known{"auto"};
    for (const Family& family : families())
        for (const std::string& id : solverMethods(family))
            if (std::find(known.begin(), known.end(), id) == known.end()) known.push_back(id);
    if (std::find(known.begin(), known.end(), method) == known.end()) {
        reader.unknownName(place, "method", method, known);
        return false;
    }
    if (method == "auto") return true;
    if (!spec.baseline.type.empty()) {
        reader.error(place, spec.baseline.type + " is a baseline and solves its equations in its own way",
                     "leave the solver out");
        return false;
    }
    const auto discretization = discretizationOf(spec);
    const Family* const family = discretization ? familyOf(discretization->space) : nullptr;
    if (!family) return false;  // reported elsewhere
    const auto& own = solverMethods(*family);
    if (std::find(own.begin(), own.end(), method) != own.end()) return true;
    reader.error(place, method + " does not solve the equations of " + family->item.title + " schemes",
                 own.empty() ? "leave the solver out" : "auto or " + joinNames(own));
    return false;
}

void readSolver(Reader& reader, const Value& scheme, const std::string& pointer, SchemeSpec& spec) {
    spec.solver.type = "auto";
    const Value* solver = scheme.find("solver");
    if (!solver || !reader.isObject(*solver, pointer)) return;
    reader.checkKeys(*solver, pointer, format::solver);
    if (const Value* method = solver->find("method")) {
        const std::string place = childPointer(pointer, "method");
        const auto name = reader.text(*method, place);
        if (name && checkSolverMethod(reader, *name, place, spec)) spec.solver.type = *name;
    }
    const auto readLimit = [&](const char* key, const Limits& limits) {
        const Value* value = solver->find(key);
        if (!value) return;
        if (const auto n = reader.number(*value, childPointer(pointer, key), limits))
            spec.solver.keys.emplace_back(key, n->value);
    };
    readLimit("tolerance", {0, 1, true, false});
    readLimit("max_iterations", {1, 1e6, false, true});
}

/// What a baseline finds in its keys.
void examineBaseline(Reader& reader, const std::string& pointer, const Settings& settings) {
    const BaselineEntry* const entry = findBaseline(settings.type);
    const auto* const check = entry ? entry->parts.find<KeyCheck>() : nullptr;
    if (!check) return;
    Findings findings;
    check->examine(settings, findings);
    reader.add(pointer, findings);
}

/// Exactly one of space, baseline and scheme says what the scheme is.
bool readKind(Reader& reader, const Value& scheme, const std::string& pointer, SchemeSpec& spec) {
    std::vector<std::string> given;
    for (const char* key : {"space", "baseline", "scheme"})
        if (scheme.find(key)) given.emplace_back(key);
    if (given.size() > 1) {
        reader.error(pointer, "has " + joinNames(given) + " at once", "keep one of them");
        return false;
    }
    if (scheme.find("quadrature") && !scheme.find("space")) {
        reader.error(childPointer(pointer, "quadrature"), "requires a space",
                     "add \"space\": { \"type\": \"polynomial\", \"degree\": 2 }");
        return false;
    }
    if (given.empty()) {
        reader.error(pointer, "names neither a space, a baseline nor a scheme",
                     "for example \"baseline\": \"stormer-verlet\"");
        return false;
    }
    const std::size_t errorsBefore = reader.errors.size();
    const std::string place = childPointer(pointer, given[0]);
    if (given[0] == "space") {
        spec.kind = SchemeSpec::Kind::discretization;
        readSpaceAndQuadrature(reader, scheme, pointer, spec);
    } else if (given[0] == "baseline") {
        spec.kind = SchemeSpec::Kind::baseline;
        const auto baseline =
            readSettings(reader, *scheme.find("baseline"), place, "baseline", itemsOf(baselineCatalog()));
        if (baseline) spec.baseline = *baseline;
        if (baseline) examineBaseline(reader, pointer, spec.baseline);
    } else {
        spec.kind = SchemeSpec::Kind::named;
        readNamed(reader, *scheme.find("scheme"), place, spec);
    }
    return reader.errors.size() == errorsBefore;
}

/// A scheme in parts of its step, for a higher order.
void readComposition(Reader& reader, const Value& value, const std::string& pointer, bool isAdaptive,
                     SchemeSpec& spec) {
    auto composition = readSettings(reader, value, pointer, "composition", itemsOf(compositionCatalog()));
    if (!composition) return;
    if (isAdaptive)
        return reader.error(pointer, "requires a fixed step, and " + spec.baseline.type + " is adaptive",
                            "a scheme with a fixed step, or no composition");
    if (const auto discretization = discretizationOf(spec);
        discretization && !describe(*discretization).refusal.empty())
        return;
    const Claims claims = resolve(spec).claims;
    const bool isGiven = composition->find("order");
    if (!isGiven)
        composition->keys.emplace_back("order", static_cast<double>(defaultOrder(composition->type, claims)));
    std::string hint;
    const std::string refusal = compositionRefusal(*composition, claims, hint);
    if (!refusal.empty())
        return reader.error(claims.isSymmetric && isGiven ? childPointer(pointer, "order") : pointer, refusal,
                            hint);
    spec.composition = *composition;
}

/// What the steps keep: "symplectic", which is left out, "energy", or a list of invariants.
void readKeep(Reader& reader, const Value& value, const std::string& pointer, SchemeSpec& spec) {
    if (value == Value("symplectic")) return;
    if (!value.isArray() && !(value == Value("energy")))
        return reader.error(pointer,
                            "must be \"symplectic\", \"energy\" or a list, got " + describeValue(value),
                            R"(for example ["energy", "x*p_y-y*p_x"])");
    const auto discretization = discretizationOf(spec);
    const Family* const family = discretization ? familyOf(discretization->space) : nullptr;
    if (!family || !family->parts.find<TestSpace>())
        return reader.error(pointer, "is a choice of schemes with a space of polynomials",
                            "for example \"scheme\": \"galerkin-gauss-2\"");
    const Value::Array all = value.isArray() ? value.asArray() : Value::Array{value};
    if (all.empty() || all.size() > mostInvariants)
        return reader.error(pointer, "must have 1 to " + std::to_string(mostInvariants) +
                                         " invariants, got " + std::to_string(all.size()));
    std::vector<KeptQuantity> kept;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string place = value.isArray() ? childPointer(pointer, i) : pointer;
        const auto text = reader.text(all[i], place);
        if (!text) return;
        const bool isNamed =
            *text == "energy" || text->starts_with("momentum.") || text->starts_with("casimir.");
        const auto formula = isNamed ? text : reader.formula(*text, place, reader.stateNames);
        if (!formula) return;
        kept.push_back({*text, *formula});
    }
    spec.keep = std::move(kept);
}

/// What is equal on both sides of an impact.
void readImpact(Reader& reader, const Value& value, const std::string& pointer, SchemeSpec& spec) {
    const auto& laws = format::impactLaws;
    const auto law = value.isString() ? std::find(laws.begin(), laws.end(), value.asString()) : laws.end();
    if (law == laws.end())
        return reader.error(pointer, "must be \"energy\" or \"variational\", got " + describeValue(value),
                            "\"energy\" is what it is without the key");
    const auto discretization = discretizationOf(spec);
    const Family* const family = discretization ? familyOf(discretization->space) : nullptr;
    if (!family || !family->takes.contains(Wall::part))
        return reader.error(pointer, "is a choice of schemes that solve for the times of impacts",
                            "for example \"scheme\": \"galerkin-gauss-2\"");
    spec.impact = static_cast<ImpactLaw>(law - laws.begin());
}

/// What the steps follow: a function of the state, or the name of an automatic one.
void readMonitor(Reader& reader, const Value& value, const std::string& pointer, SchemeSpec& spec) {
    if (!spec.keep.empty())
        return reader.error(pointer,
                            "has energies in another time, in which the invariants are not what is asked for",
                            "one of monitor and keep");
    if (resolve(spec).grid != TimeGrid::fixed)
        return reader.error(pointer, "has nothing to choose: the times of the scheme are unknowns already",
                            "a scheme with a fixed step, or no monitor");
    std::vector<CatalogItem> items = monitorCatalog();
    std::vector<std::string> names = reader.stateNames;
    for (CatalogItem& item : items)
        for (FieldInfo& field : item.parameters)
            if (field.type == FieldType::definitions) field.components = names;
    const bool isFormula = value.isString() && std::none_of(items.begin(), items.end(), [&](const auto& i) {
                               return i.id == value.asString();
                           });
    const Value object =
        isFormula ? Value(Value::Object{{"type", items.front().id}, {"monitor", value}}) : value;
    auto monitor = readSettings(reader, object, pointer, "monitor", itemsOf(items));
    if (!monitor) return;
    if (const Value* let = monitor->find("let"))
        for (const auto& [name, meaning] : let->asObject()) names.push_back(name);
    for (auto& [key, written] : monitor->keys) {
        if (key != "monitor") continue;
        const std::string text = written.asString();
        const auto read = reader.formula(text, isFormula ? pointer : childPointer(pointer, key), names);
        if (!read) return;
        if (*read != text) monitor->expressions.emplace_back(key, text);
        written = *read;
    }
    spec.monitor = *std::move(monitor);
}

/// The step that follows from the space, with the parameters of the model.
std::optional<ImpliedStep> impliedStepOf(const Reader& reader, const SchemeSpec& spec) {
    const auto discretization = discretizationOf(spec);
    const auto* const step = discretization ? familyPart<StepOfSpace>(discretization->space) : nullptr;
    if (!step) return {};
    return step->implied(discretization->space, reader.model,
                         [&](std::string_view name) -> std::optional<double> {
                             const auto known = reader.parameters.find(name);
                             return known == reader.parameters.end() ? std::nullopt : known->second;
                         });
}

void readStep(Reader& reader, const Value& scheme, const std::string& pointer, bool isAdaptive,
              SchemeSpec& spec) {
    const char* wanted = isAdaptive ? "tolerance" : "step";
    const char* other = isAdaptive ? "step" : "tolerance";
    const std::string place = childPointer(pointer, wanted);
    if (scheme.find(other))
        reader.warning(childPointer(pointer, other),
                       isAdaptive
                           ? "is not used: " + spec.baseline.type + " chooses its steps by its tolerance"
                           : std::string("is not used: the scheme has a step"));
    const Value* value = scheme.find(wanted);
    if (const auto implied = impliedStepOf(reader, spec)) {
        const auto given =
            value && implied->isOfSpace ? reader.number(*value, place, Limits::positive()) : std::nullopt;
        if (given && std::abs(given->value / implied->step - 1) > 1e-9)
            reader.warning(place, "is not used: the space has its own", "", implied->step);
        if (implied->isOfSpace || !value) {
            spec.step = Number{implied->step, implied->expression};
            return;
        }
    }
    if (!value)
        return reader.error(place, "is required: a positive finite number",
                            isAdaptive ? "for example 1e-9" : "");
    const auto number =
        reader.number(*value, place, isAdaptive ? Limits{0, 1, true, false} : Limits::positive());
    if (!number) return;
    if (isAdaptive)
        spec.tolerance = number->value;
    else
        spec.step = *number;
}

std::string innerLabel(const SchemeSpec& scheme) {
    if (scheme.kind == SchemeSpec::Kind::named) return scheme.named;
    const auto text = [](const Settings& s, const char* key) {
        std::string label = s.type;
        if (const Value* v = s.find(key); v && v->isNumber()) label += " " + formatNumber(v->asNumber());
        return label;
    };
    if (scheme.kind == SchemeSpec::Kind::baseline) return text(scheme.baseline, "stages");
    std::string basis = scheme.space.text("basis");
    basis = basis.empty() || basis == "lobatto" ? "" : " " + basis;
    std::string rule = text(scheme.quadrature, "nodes");
    if (isTermRule(scheme.quadrature)) {
        rule.clear();
        for (const auto& [name, own] : scheme.quadrature.keys)
            rule +=
                (rule.empty() ? "" : ", ") + name + " " + text(termPart(scheme.quadrature, name), "nodes");
    }
    if (isTensorRule(scheme.quadrature)) rule.clear();
    for (const char* direction : tensorPartsOf(scheme.quadrature))
        rule += (rule.empty() ? "" : " x ") + text(tensorPart(scheme.quadrature, direction), "nodes");
    return text(scheme.space, "degree") + basis + ", " + rule;
}

std::string keptNames(const SchemeSpec& scheme) {
    std::vector<std::string> names;
    for (const KeptQuantity& each : scheme.keep) names.push_back(each.text);
    return joinNames(names);
}

std::string partsLabel(const SchemeSpec& scheme) {
    const Settings &c = scheme.composition, &m = scheme.monitor;
    return innerLabel(scheme) +
           (c.type.empty() ? "" : ", " + c.type + " " + formatNumber(c.number("order"))) +
           (scheme.keep.empty() ? "" : ", keeps " + keptNames(scheme)) +
           (scheme.impact == ImpactLaw::variational ? ", variational impacts" : "") +
           (m.type.empty() ? "" : ", monitored");
}

}  // namespace

std::optional<SchemeSpec> readScheme(Reader& reader, const Value& value, const std::string& pointer) {
    if (!reader.isObject(value, pointer)) return {};
    const std::size_t errorsBefore = reader.errors.size();
    reader.checkKeys(value, pointer, format::scheme);
    SchemeSpec spec;
    if (const Value* label = value.find("label"))
        spec.label = reader.label(*label, childPointer(pointer, "label")).value_or("");
    const auto readFlag = [&](const char* key, bool& target) {
        if (const Value* flag = value.find(key))
            target = reader.flag(*flag, childPointer(pointer, key)).value_or(target);
    };
    readFlag("enabled", spec.isEnabled);
    readFlag("allow_unstable", spec.allowsUnstable);
    if (const Value* style = value.find("style"))
        if (const auto n = reader.number(*style, childPointer(pointer, "style"), {1, 64, false, true}))
            spec.style = static_cast<int>(n->value) - 1;
    const bool isKindKnown = readKind(reader, value, pointer, spec);
    const BaselineEntry* baseline = findBaseline(spec.baseline.type);
    if (const Value* keep = value.find("keep"); keep && isKindKnown)
        readKeep(reader, *keep, childPointer(pointer, "keep"), spec);
    if (const Value* impact = value.find("impact"); impact && isKindKnown)
        readImpact(reader, *impact, childPointer(pointer, "impact"), spec);
    if (const Value* composition = value.find("composition"); composition && isKindKnown)
        readComposition(reader, *composition, childPointer(pointer, "composition"),
                        baseline && baseline->isAdaptive(), spec);
    if (const Value* monitor = value.find("monitor"); monitor && isKindKnown)
        readMonitor(reader, *monitor, childPointer(pointer, "monitor"), spec);
    if (isKindKnown || value.find("step"))
        readStep(reader, value, pointer, baseline && baseline->isAdaptive(), spec);
    readSolver(reader, value, childPointer(pointer, "solver"), spec);
    // A step that follows from a parameter whose own error is reported is unknown without a further one.
    const bool hasStep = spec.step.value > 0 || spec.tolerance;
    if (!hasStep && reader.errors.empty())
        reader.error(pointer + "/step", "follows from the model, where it is not a positive number",
                     "parameters of the model of ordinary size");
    if (reader.errors.size() > errorsBefore || !hasStep) return {};
    return spec;
}

void fillLabels(std::vector<SchemeSpec>& schemes) {
    std::map<std::string, int> uses;
    std::set<std::string> taken;
    for (const SchemeSpec& scheme : schemes) {
        if (scheme.label.empty())
            ++uses[partsLabel(scheme)];
        else
            taken.insert(scheme.label);
    }
    for (SchemeSpec& scheme : schemes) {
        if (!scheme.label.empty()) continue;
        std::string label = partsLabel(scheme);
        if (uses[label] > 1)
            label += scheme.tolerance ? ", tolerance " + formatNumber(*scheme.tolerance)
                                      : ", h " + formatNumber(scheme.step.value);
        scheme.label = label;
        for (int n = 2; !taken.insert(scheme.label).second; ++n)
            scheme.label = label + " (" + std::to_string(n) + ")";
    }
}

std::vector<std::size_t> readSchemes(Reader& reader, const Value& document, Scene& scene) {
    std::vector<std::size_t> places;
    const Value* schemes = document.find("schemes");
    if (!schemes) {
        reader.error("/schemes", "is required",
                     "for example \"schemes\": [{ \"scheme\": \"midpoint\", \"step\": 0.1 }]");
        return places;
    }
    if (!reader.isArray(*schemes, "/schemes", "schemes")) return places;
    if (schemes->asArray().empty())
        reader.error("/schemes", "must have at least one scheme",
                     "for example { \"scheme\": \"midpoint\", \"step\": 0.1 }");
    if (!reader.hasAtMost(*schemes, "/schemes", "schemes", mostSchemes)) return places;
    std::map<std::string, std::size_t> firstUse;
    for (std::size_t i = 0; i < schemes->asArray().size(); ++i) {
        const std::string pointer = childPointer("/schemes", i);
        const work::Part part(pointer);
        const Value& value = schemes->asArray()[i];
        if (const Value* label = value.find("label");
            label && label->isString() && !label->asString().empty()) {
            const auto [first, isNew] = firstUse.emplace(label->asString(), i);
            if (!isNew)
                reader.error(pointer + "/label",
                             "is the label of /schemes/" + std::to_string(first->second) +
                                 " already: " + describeValue(*label),
                             "labels are unique");
        }
        if (const auto spec = readScheme(reader, value, pointer)) {
            scene.schemes.push_back(*spec);
            places.push_back(i);
        }
    }
    fillLabels(scene.schemes);
    const bool runsNothing =
        std::none_of(scene.schemes.begin(), scene.schemes.end(), [](const auto& s) { return s.isEnabled; });
    if (!scene.schemes.empty() && runsNothing)
        reader.warning("/schemes", "has no enabled scheme: nothing will run");
    return places;
}

}  // namespace extremal
