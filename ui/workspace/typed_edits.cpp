// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/typed_edits.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include "engine/core/text/expression.hpp"
#include "ui/workspace/tex_formula.hpp"
#include "ui/workspace/typed_kind.hpp"

namespace extremal {

namespace {

/// Of a document whose formula is typed.
std::string formulaTextOf(const Value& document) {
    const TypedKind* const kind = typedKindOf(document);
    const Value* const typed = kind ? valueAt(document, kind->formulaPlace()) : nullptr;
    return typed ? formulaText(*typed) : std::string();
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

Value::Object parametersOf(const Value& document) {
    const Value* parameters = valueAt(document, "/model/parameters");
    return parameters && parameters->isObject() ? parameters->asObject() : Value::Object{};
}

bool isTaken(const Value& document, const std::string& name, const std::vector<std::string>& others) {
    std::vector<std::string> names = typedNamesOf(document);
    names.insert(names.end(), others.begin(), others.end());
    const auto parameters = parametersOf(document);
    return std::find(names.begin(), names.end(), name) != names.end() ||
           std::any_of(parameters.begin(), parameters.end(),
                       [&](const Value::Member& m) { return m.first == name; });
}

std::string freeName(const Value& document, const std::vector<std::string>& wanted,
                     const std::vector<std::string>& others = {}) {
    for (const std::string& name : wanted)
        if (!isTaken(document, name, others)) return name;
    for (int i = 1;; ++i)
        if (const std::string name = wanted.back() + std::to_string(i); !isTaken(document, name, others))
            return name;
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
    for (const char* key : {"q", "p", "v", "x"}) {
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
    const TypedKind* const kind = typedKindOf(document);
    if (!kind) return all;
    for (const auto& [key, value] : model->asObject())
        if (key != "type" && key != "parameters" && key != kind->names && key != kind->formula)
            addTexts(value, "/model/" + key, all);
    return all;
}

bool isInFormulas(const Value& document, const std::string& name) {
    const auto has = [&](const std::string& text) { return withNameReplaced(text, name, "") != text; };
    const std::vector<PlacedFormula> parts = partFormulas(document);
    return has(formulaTextOf(document)) ||
           std::any_of(parts.begin(), parts.end(), [&](const PlacedFormula& p) { return has(p.text); });
}

typed::Formula formulaIn(const Value& model) {
    Value document(Value::Object{{"model", model}});
    typed::Formula formula;
    formula.coordinates = typedNamesOf(document);
    // Momenta are no rates of a typed formula, but names beside the coordinates (typed_hamiltonian.hpp).
    if (const TypedKind* const kind = typedKindOf(document); kind && *kind->before)
        for (std::size_t i = 0, d = formula.coordinates.size(); i < d; ++i)
            formula.coordinates.push_back(kind->rateOf(formula.coordinates[i]));
    for (const auto& [name, value] : parametersOf(document))
        formula.parameters.emplace_back(name, value.isNumber() ? value.asNumber() : 1);
    formula.text = formulaTextOf(document);
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

std::string formulaText(const Value& typed) {
    if (typed.isString()) return typed.asString();
    std::string text;
    if (typed.isObject())
        for (const auto& [name, term] : typed.asObject())
            text += (text.empty() ? "" : "\n") + name + ": " +
                    (term.isString() ? term.asString() : std::string());
    return text;
}

Value formulaFrom(const std::string& text) {
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
    const TypedKind* const kind = typedKindOf(document);
    for (const std::string& place : {kind ? kind->formulaPlace() : std::string("/model"),
                                     std::string("/initial"), std::string("/time"), std::string("/output")})
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
    const std::vector<std::string> old = typedNamesOf(document);
    const auto changed = renamedCoordinate(old, names);
    if (!changed) return text;
    const std::string &from = old[*changed], &to = names[*changed];
    const TypedKind& kind = *typedKindOf(document);
    const std::string renamed = withNameReplaced(text, from, to);
    return kind.hasRates() ? withNameReplaced(renamed, kind.rateOf(from), kind.rateOf(to)) : renamed;
}

namespace {

/// The formulas beside the typed one by the new name of a coordinate, and what is there for it by name.
void addRenamedParts(const Value& document, const std::vector<std::string>& names, std::vector<Edit>& edits) {
    const std::vector<std::string> old = typedNamesOf(document);
    const auto changed = renamedCoordinate(old, names);
    if (!changed) return;
    for (const PlacedFormula& part : partFormulas(document))
        if (const std::string text = formulaFor(document, names, part.text); text != part.text)
            edits.push_back({part.pointer, text});
    for (const char* place : {"/model/forces", "/model/one_form", "/model/bracket"}) {
        const Value* const byName = valueAt(document, place);
        if (!byName || !byName->isObject()) continue;
        Value::Object renamed;
        for (const auto& [name, text] : byName->asObject())
            renamed.emplace_back(
                withNameReplaced(name, old[*changed], names[*changed]),
                text.isString() ? Value(formulaFor(document, names, text.asString())) : text);
        if (Value next(std::move(renamed)); !(next == *byName)) edits.push_back({place, std::move(next)});
    }
}

}  // namespace

std::vector<Edit> editsForCoordinates(const Value& document, const std::vector<std::string>& names) {
    const TypedKind& kind = *typedKindOf(document);
    const std::vector<std::string> old = typedNamesOf(document);
    std::vector<std::string> source = names;  // under which name the initial data of each are found
    std::vector<Edit> edits{{kind.namesPlace(), namesValue(names)}};
    if (renamedCoordinate(old, names)) {
        source = old;
        edits.push_back(
            {kind.formulaPlace(), formulaFrom(formulaFor(document, names, formulaTextOf(document)))});
        addRenamedParts(document, names, edits);
    }
    edits.push_back({"/initial", initialFor(document, old, source)});
    // Plots and columns named after coordinates that are gone would be errors: the defaults follow the new
    // ones.
    edits.push_back({"/views", std::nullopt});
    return edits;
}

std::vector<Edit> editsForNewCoordinates(const Value& document) {
    const TypedKind& kind = *typedKindOf(document);
    std::vector<std::string> names = typedNamesOf(document);
    std::string added[2];
    for (int i = 0; i < kind.newNames; ++i) {
        added[i] = freeName(document, {"x", "y", "z", "q"}, names);
        names.push_back(added[i]);
    }
    const auto written = [&](const char* text) {
        return QString::fromUtf8(text)
            .replace("%1", QString::fromStdString(added[0]))
            .replace("%2", QString::fromStdString(added[1]))
            .toStdString();
    };
    std::vector<Edit> edits = editsForCoordinates(document, names);
    edits.push_back(
        {kind.formulaPlace(), formulaFrom(formulaTextOf(document) + " + " + written(kind.newTerm))});
    if (kind.newPart)
        edits.push_back({std::string("/model/") + kind.newPart + "/" + written(kind.newPartName),
                         written(kind.newPartFormula)});
    return edits;
}

void renameColumns(const Value& value, const std::string& pointer, const std::string& from,
                   const std::string& to, std::vector<Edit>& edits) {
    if (value.isString()) {
        const std::string& text = value.asString();
        const auto dot = text.find('.');
        const auto end = dot == std::string::npos ? dot : std::min(text.find('.', dot + 1), text.size());
        if (dot != std::string::npos && text.substr(dot + 1, end - dot - 1) == from)
            edits.push_back({pointer, text.substr(0, dot + 1) + to + text.substr(end)});
    } else if (value.isArray()) {
        for (std::size_t i = 0; i < value.asArray().size(); ++i)
            renameColumns(value.asArray()[i], pointer + "/" + std::to_string(i), from, to, edits);
    } else if (value.isObject()) {
        for (const auto& [key, member] : value.asObject())
            renameColumns(member, pointer + "/" + key, from, to, edits);
    }
}

std::vector<Edit> withoutRefused(std::vector<Edit> edits, const std::vector<Problem>& problems) {
    std::set<std::string, std::greater<>> places;  // from the end, so that indices stay what they are
    for (const Problem& problem : problems)
        for (const char* part : {"/observe/", "/views/"})
            if (problem.pointer.starts_with(part))
                places.insert(problem.pointer.substr(0, problem.pointer.find('/', std::string(part).size())));
    for (const std::string& place : places) edits.push_back({place, std::nullopt});
    return edits;
}

}  // namespace extremal
