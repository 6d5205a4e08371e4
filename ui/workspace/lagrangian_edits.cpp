// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/lagrangian_edits.hpp"

#include <algorithm>
#include <optional>

#include "engine/core/text/expression.hpp"
#include "ui/workspace/tex_formula.hpp"

namespace extremal {

namespace {

std::string lagrangianOf(const Value& document) {
    const Value* lagrangian = valueAt(document, "/model/lagrangian");
    return lagrangian ? lagrangianText(*lagrangian) : std::string();
}

/// Of "slow:" at the start of a line, with the colon; 0: there is none.
std::size_t labelLength(const std::string& line) {
    const auto isPart = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    };
    const auto end = std::find_if_not(line.begin(), line.end(), isPart);
    return end != line.begin() && end != line.end() && *end == ':'
               ? static_cast<std::size_t>(end - line.begin()) + 1
               : 0;
}

std::vector<std::string> coordinatesOf(const Value& document) {
    std::vector<std::string> names;
    if (const Value* coordinates = valueAt(document, "/model/coordinates");
        coordinates && coordinates->isArray())
        for (const Value& name : coordinates->asArray())
            if (name.isString()) names.push_back(name.asString());
    return names;
}

Value::Object parametersOf(const Value& document) {
    const Value* parameters = valueAt(document, "/model/parameters");
    return parameters && parameters->isObject() ? parameters->asObject() : Value::Object{};
}

bool isTaken(const Value& document, const std::string& name) {
    const auto coordinates = coordinatesOf(document);
    const auto parameters = parametersOf(document);
    return std::find(coordinates.begin(), coordinates.end(), name) != coordinates.end() ||
           std::any_of(parameters.begin(), parameters.end(),
                       [&](const Value::Member& m) { return m.first == name; });
}

std::string freeName(const Value& document, const std::vector<std::string>& wanted) {
    for (const std::string& name : wanted)
        if (!isTaken(document, name)) return name;
    for (int i = 1;; ++i)
        if (const std::string name = wanted.back() + std::to_string(i); !isTaken(document, name)) return name;
}

/// Every text below a value in which the name occurs, with the name replaced.
void renameBelow(const Value& value, const std::string& pointer, const std::string& from,
                 const std::string& to, std::vector<Edit>& edits) {
    if (value.isString()) {
        std::string text = withNameReplaced(value.asString(), from, to);
        if (text != value.asString()) edits.push_back({pointer, std::move(text)});
    } else if (value.isArray()) {
        for (std::size_t i = 0; i < value.asArray().size(); ++i)
            renameBelow(value.asArray()[i], pointer + "/" + std::to_string(i), from, to, edits);
    } else if (value.isObject()) {
        for (const auto& [key, member] : value.asObject())
            renameBelow(member, pointer + "/" + key, from, to, edits);
    }
}

Value namesValue(const std::vector<std::string>& names) {
    Value::Array array;
    for (const std::string& name : names) array.emplace_back(name);
    return array;
}

/// The initial data in the order of the new coordinates; new ones start from 0.
Value initialFor(const Value& document, const std::vector<std::string>& old,
                 const std::vector<std::string>& source) {
    const Value* initial = valueAt(document, "/initial");
    Value result = initial ? *initial : Value(Value::Object{});
    for (const char* key : {"q", "p", "v"}) {
        Value* numbers = result.find(key);
        if (!numbers || !numbers->isArray()) continue;
        Value::Array moved;
        for (const std::string& name : source) {
            const auto at = static_cast<std::size_t>(std::find(old.begin(), old.end(), name) - old.begin());
            moved.push_back(at < numbers->asArray().size() ? numbers->asArray()[at] : Value(0.0));
        }
        *numbers = Value(std::move(moved));
    }
    return result;
}

void addTexts(const Value& value, const std::string& pointer, std::vector<PlacedFormula>& all) {
    if (value.isString()) all.push_back({pointer, value.asString()});
    if (value.isArray())
        for (std::size_t i = 0; i < value.asArray().size(); ++i)
            addTexts(value.asArray()[i], pointer + "/" + std::to_string(i), all);
    if (value.isObject())
        for (const auto& [key, member] : value.asObject()) addTexts(member, pointer + "/" + key, all);
}

}  // namespace

std::string formulaOfText(const std::string& text) {
    const QString typed = QString::fromStdString(text);
    if (!isTex(typed)) return text;
    return formulaFromTex(typed).toStdString();
}

std::vector<PlacedFormula> partFormulas(const Value& document) {
    std::vector<PlacedFormula> all;
    const Value* model = valueAt(document, "/model");
    if (!model || !model->isObject()) return all;
    for (const auto& [key, value] : model->asObject())
        if (key != "type" && key != "coordinates" && key != "parameters" && key != "lagrangian")
            addTexts(value, "/model/" + key, all);
    return all;
}

bool isInFormulas(const Value& document, const std::string& name) {
    const auto has = [&](const std::string& text) { return withNameReplaced(text, name, "") != text; };
    const std::vector<PlacedFormula> parts = partFormulas(document);
    return has(lagrangianOf(document)) ||
           std::any_of(parts.begin(), parts.end(), [&](const PlacedFormula& p) { return has(p.text); });
}

typed::Formula formulaIn(const Value& model) {
    Value document(Value::Object{{"model", model}});
    typed::Formula formula;
    formula.coordinates = coordinatesOf(document);
    for (const auto& [name, value] : parametersOf(document))
        formula.parameters.emplace_back(name, value.isNumber() ? value.asNumber() : 1);
    formula.text = lagrangianOf(document);
    // Labels of terms give way to blanks, and to a sign between terms, so that places stay what they are.
    bool isFirst = true;
    for (std::size_t start = 0; start < formula.text.size();) {
        const std::size_t end = std::min(formula.text.find('\n', start), formula.text.size());
        if (const std::size_t label = labelLength(formula.text.substr(start, end - start))) {
            std::fill_n(formula.text.begin() + static_cast<std::ptrdiff_t>(start), label, ' ');
            if (!isFirst) formula.text[start] = '+';
            isFirst = false;
        }
        start = end + 1;
    }
    return formula;
}

std::string lagrangianText(const Value& lagrangian) {
    if (lagrangian.isString()) return lagrangian.asString();
    std::string text;
    if (lagrangian.isObject())
        for (const auto& [name, term] : lagrangian.asObject())
            text += (text.empty() ? "" : "\n") + name + ": " +
                    (term.isString() ? term.asString() : std::string());
    return text;
}

Value lagrangianFrom(const std::string& text) {
    Value terms{Value::Object{}};
    std::string name;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        const std::string line = text.substr(start, end - start);
        const std::size_t label = labelLength(line);
        if (label > 0) {
            name = line.substr(0, label - 1);
            const std::size_t from = line.find_first_not_of(' ', label);
            terms.set(name, from == std::string::npos ? std::string() : line.substr(from));
        } else if (!name.empty()) {
            terms.set(name, terms.find(name)->asString() + "\n" + line);
        } else if (line.find_first_not_of(" \t") != std::string::npos) {
            return text;  // no terms
        }
        start = end + 1;
    }
    return terms.asObject().empty() ? Value(text) : terms;
}

std::vector<Edit> editsForParameterName(const Value& document, const std::string& from,
                                        const std::string& to) {
    std::vector<Edit> edits;
    Value::Object parameters = parametersOf(document);
    for (auto& [name, value] : parameters) {
        if (value.isString()) value = Value(withNameReplaced(value.asString(), from, to));
        if (name == from) name = to;
    }
    edits.push_back({"/model/parameters", Value(std::move(parameters))});
    for (const char* place : {"/model/lagrangian", "/initial", "/time", "/output"})
        if (const Value* value = valueAt(document, place)) renameBelow(*value, place, from, to, edits);
    for (const PlacedFormula& part : partFormulas(document))
        renameBelow(part.text, part.pointer, from, to, edits);
    if (const Value* schemes = valueAt(document, "/schemes"))
        for (std::size_t i = 0; i < schemes->asArray().size(); ++i) {
            const std::string step = "/schemes/" + std::to_string(i) + "/step";
            if (const Value* value = valueAt(document, step)) renameBelow(*value, step, from, to, edits);
        }
    return edits;
}

std::vector<Edit> editsForNewParameter(const Value& document, std::string& name) {
    name = freeName(document, {"a", "b", "c", "d", "k"});
    return {{"/model/parameters/" + name, 1.0}};
}

std::vector<Edit> editsForParameterRemoval(const Value& document, const std::string& name) {
    Value::Object parameters = parametersOf(document);
    std::erase_if(parameters, [&](const Value::Member& m) { return m.first == name; });
    return {{"/model/parameters", Value(std::move(parameters))}};
}

namespace {

/// The place of the only coordinate whose name differs; none if there are others.
std::optional<std::size_t> renamedCoordinate(const std::vector<std::string>& old,
                                             const std::vector<std::string>& names) {
    std::optional<std::size_t> changed;
    if (names.size() != old.size()) return {};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == old[i]) continue;
        if (changed) return {};
        changed = i;
    }
    return changed;
}

}  // namespace

std::string formulaFor(const Value& document, const std::vector<std::string>& names,
                       const std::string& text) {
    const std::vector<std::string> old = coordinatesOf(document);
    const auto changed = renamedCoordinate(old, names);
    if (!changed) return text;
    const std::string &from = old[*changed], &to = names[*changed];
    return withNameReplaced(withNameReplaced(text, from, to), from + "_t", to + "_t");
}

namespace {

/// The formulas beside the Lagrangian by the new name of a coordinate, and the force on it.
void addRenamedParts(const Value& document, const std::vector<std::string>& names, std::vector<Edit>& edits) {
    const std::vector<std::string> old = coordinatesOf(document);
    const auto changed = renamedCoordinate(old, names);
    if (!changed) return;
    for (const PlacedFormula& part : partFormulas(document))
        if (const std::string text = formulaFor(document, names, part.text); text != part.text)
            edits.push_back({part.pointer, text});
    const Value* const forces = valueAt(document, "/model/forces");
    if (!forces || !forces->isObject() || !forces->find(old[*changed])) return;
    Value::Object renamed;
    for (const auto& [name, text] : forces->asObject())
        renamed.emplace_back(name == old[*changed] ? names[*changed] : name,
                             text.isString() ? Value(formulaFor(document, names, text.asString())) : text);
    edits.push_back({"/model/forces", Value(std::move(renamed))});
}

}  // namespace

std::vector<Edit> editsForCoordinates(const Value& document, const std::vector<std::string>& names) {
    const std::vector<std::string> old = coordinatesOf(document);
    std::vector<std::string> source = names;  // under which name the initial data of each are found
    std::vector<Edit> edits{{"/model/coordinates", namesValue(names)}};
    if (renamedCoordinate(old, names)) {
        source = old;
        edits.push_back(
            {"/model/lagrangian", lagrangianFrom(formulaFor(document, names, lagrangianOf(document)))});
        addRenamedParts(document, names, edits);
    }
    edits.push_back({"/initial", initialFor(document, old, source)});
    // Plots and columns named after coordinates that are gone would be errors: the defaults follow the new
    // ones.
    edits.push_back({"/views", std::nullopt});
    return edits;
}

std::vector<Edit> editsForNewCoordinate(const Value& document) {
    std::vector<std::string> names = coordinatesOf(document);
    names.push_back(freeName(document, {"x", "y", "z", "q"}));
    std::vector<Edit> edits = editsForCoordinates(document, names);
    edits.push_back(
        {"/model/lagrangian", lagrangianFrom(lagrangianOf(document) + " + " + names.back() + "_t^2/2")});
    return edits;
}

}  // namespace extremal
