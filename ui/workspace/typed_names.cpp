// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/typed_names.hpp"

#include <QCoreApplication>
#include <QStringList>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/write/codec.hpp"
#include "ui/workspace/typed_edits.hpp"
#include "ui/workspace/typed_kind.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {
namespace {

using Names = std::vector<std::string>;

bool has(const Names& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

Value::Object parametersAt(const Value& document) {
    const Value* all = valueAt(document, "/model/parameters");
    return all && all->isObject() ? all->asObject() : Value::Object{};
}

/// Without the digits or the word after it: "omega" of "omega_0".
std::string stemOf(const std::string& name) { return name.substr(0, name.find_first_of("_0123456789")); }

bool isGreek(const std::string& stem) {
    constexpr std::array<std::string_view, 26> letters = {
        "alpha", "beta",   "gamma", "delta", "epsilon", "zeta",  "eta",   "theta", "iota",
        "kappa", "lambda", "mu",    "nu",    "xi",      "rho",   "sigma", "tau",   "upsilon",
        "phi",   "chi",    "psi",   "omega", "Omega",   "Delta", "Phi",   "Psi"};
    return std::find(letters.begin(), letters.end(), stem) != letters.end();
}

/// A longer name beside a known one that it almost is. Letters of physics are meant, and so are indices.
bool isSlip(const std::string& name, const Names& known) {
    const std::string stem = stemOf(name);
    if (stem.size() < 2 || isGreek(stem)) return false;
    const std::string near = nearestName(name, known);
    return !near.empty() && stemOf(near) != stem;
}

/// The names in a formula, and the coordinates whose velocities or momenta it has.
struct FormulaNames {
    explicit FormulaNames(const TypedKind& its) : kind(its) {}

    const TypedKind& kind;
    Names all, rates;
    bool isRead = false;

    void read(const std::string& text) {
        Expression expression;
        try {
            expression = parseExpression(text);
        } catch (const ExpressionError&) {
            return;
        }
        isRead = true;
        for (const Expression::Node& node : expression.nodes) {
            if (node.kind == Operator::call && node.name == "dot" && node.left >= 0 && *kind.behind)
                add(rates, expression.nodes[static_cast<std::size_t>(node.left)].name);
            if (node.kind != Operator::name) continue;
            std::string base = kind.nameOfRate(node.name);
            if (!nameProblem(base).empty() || isFunctionName(base)) base.clear();  // p_0 is a constant
            add(rates, base);
            add(all, base.empty() ? node.name : base);
        }
    }

private:
    static void add(Names& names, const std::string& name) {
        if (!name.empty() && !has(names, name)) names.push_back(name);
    }
};

/// Of a part that is a formula, or an object of them.
Names namesInPart(const TypedKind& kind, const Value& typed) {
    FormulaNames own(kind);
    if (typed.isString()) own.read(typed.asString());
    if (typed.isObject())
        for (const auto& [key, member] : typed.asObject())
            if (member.isString()) own.read(member.asString());
    return own.all;
}

/// A value that lets one see something: gravity, weak damping, else 1.
double valueFor(const std::string& name) {
    const std::string stem = stemOf(name);
    if (stem == "g") return 9.81;
    for (const char* weak : {"c", "d", "gamma", "delta", "nu", "eta", "zeta", "eps", "epsilon"})
        if (stem == weak) return 0.1;
    return 1;
}

/// Numbers as texts can have names of parameters in them.
bool isInNumbers(const Value& value, const std::string& name) {
    if (value.isString()) return withNameReplaced(value.asString(), name, "") != value.asString();
    if (value.isArray())
        return std::any_of(value.asArray().begin(), value.asArray().end(),
                           [&](const Value& v) { return isInNumbers(v, name); });
    return value.isObject() &&
           std::any_of(value.asObject().begin(), value.asObject().end(), [&](const Value::Member& m) {
               return m.first != "label" && isInNumbers(m.second, name);
           });
}

bool isUsedBesides(const Value& document, const std::string& name) {
    for (const char* place : {"/initial", "/time", "/output", "/schemes", "/events", "/views"})
        if (const Value* value = valueAt(document, place); value && isInNumbers(*value, name)) return true;
    const Value::Object parameters = parametersAt(document);
    return std::any_of(parameters.begin(), parameters.end(), [&](const Value::Member& m) {
        return m.first != name && isInNumbers(m.second, name);
    });
}

/// Places and velocities to begin with: angles and first coordinates at 1, the others at 0, in the plane
/// moving across. The further attempts are away from places where formulas often have no value.
std::pair<double, double> startOf(const Names& names, std::size_t i, int attempt) {
    constexpr std::array<std::string_view, 8> angles = {"theta", "phi",   "psi", "alpha",
                                                        "beta",  "gamma", "r",   "rho"};
    const std::string stem = stemOf(names[i]);
    const bool isAngle = std::find(angles.begin(), angles.end(), stem) != angles.end();
    const double order = static_cast<double>(i);
    if (attempt == 1) return {1, 0};
    if (attempt == 2) return {0.5 + 0.3 * order, 0};
    if (attempt == 3) return {2 + order, 0.1};
    const bool isAcross = names.size() == 2 && i == 1 && stem == "y" && stemOf(names[0]) == "x";
    return {isAngle || i == 0 ? 1 : 0, isAcross ? 0.8 : 0};
}

constexpr int attempts = 4;

Value initialOf(const Value& document, const Names& before, const Names& after,
                const std::map<std::string, Value>& remembered, int attempt) {
    const Value* const now = valueAt(document, "/initial");
    Value initial = now && now->isObject() ? *now : Value(Value::Object{});
    std::erase_if(initial.asObject(),
                  [](const Value::Member& m) { return m.first == "q1" || m.first == "at"; });
    const bool isOther =
        std::none_of(after.begin(), after.end(), [&](const std::string& name) { return has(before, name); });
    if (isOther) std::erase_if(initial.asObject(), [](const Value::Member& m) { return m.first == "p"; });
    const TypedKind* const kind = typedKindOf(document);
    const char* const second = initial.find("p") || *kind->before ? "p" : "v";
    const auto moved = [&](const char* key, bool isPlace) {
        const Value* const old = initial.find(key);
        Value::Array numbers;
        for (std::size_t i = 0; i < after.size(); ++i) {
            const auto at =
                static_cast<std::size_t>(std::find(before.begin(), before.end(), after[i]) - before.begin());
            const auto kept = remembered.find(after[i]);
            const std::pair<double, double> start = startOf(after, i, attempt);
            if (old && old->isArray() && at < old->asArray().size())
                numbers.push_back(old->asArray()[at]);
            else if (isPlace && kept != remembered.end() && attempt == 0)
                numbers.push_back(kept->second);
            else
                numbers.emplace_back(isPlace ? start.first : isOther ? start.second : 0.0);
        }
        return Value(std::move(numbers));
    };
    const Value places = moved("q", true), rates = moved(second, false);
    initial.set("q", places);
    initial.set(second, rates);
    return initial;
}

/// The coordinates and initial data for them: the first ones from which the system can start, where these are
/// tried.
void addCoordinates(const Value& document, const Names& before, const Names& after,
                    const std::map<std::string, Value>& remembered, bool triesStarts,
                    std::vector<Edit>& edits) {
    Value::Array list;
    for (const std::string& name : after) list.emplace_back(name);
    edits.insert(edits.begin(), {typedKindOf(document)->namesPlace(), Value(std::move(list))});
    if (after != before) edits.push_back({"/views", std::nullopt});
    const std::size_t last = edits.size();
    edits.push_back({"/initial", initialOf(document, before, after, remembered, 0)});
    if (!triesStarts) return;
    const Value first = *edits[last].value;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        edits[last].value = initialOf(document, before, after, remembered, attempt);
        if (readScene(withEdits(document, edits)).errors.empty()) return;
    }
    edits[last].value = first;
}

QString sentence(const Names& coordinates, const Names& parameters, const Value::Object& values) {
    const auto tr = [](const char* text) { return QCoreApplication::translate("extremal", text); };
    QStringList parts;
    for (const std::string& name : coordinates)
        parts << tr("%1 is a coordinate").arg(QString::fromStdString(name));
    for (const std::string& name : parameters) {
        QString value;
        for (const auto& [key, v] : values)
            if (key == name && v.isNumber()) value = QString::number(v.asNumber());
        parts << tr("%1 = %2 is a parameter").arg(QString::fromStdString(name), value);
    }
    return parts.join(QStringLiteral(", "));
}

}  // namespace

void TypedNames::forget(const Value& document) {
    made_.clear();
    meant_.clear();
    remembered_.clear();
    slips_.clear();
    note_.clear();
    hasRefusedNames_ = false;
    const TypedKind* const kind = typedKindOf(document);
    const Value* const text = kind ? valueAt(document, kind->formulaPlace()) : nullptr;
    const ModelEntry* const entry = kind ? findModel(kind->model) : nullptr;
    if (!entry || !text) return;
    const bool isExample =
        std::any_of(entry->item.parameters.begin(), entry->item.parameters.end(),
                    [&](const FieldInfo& f) { return f.key == kind->formula && f.firstValue() == *text; });
    if (!isExample) return;
    for (const std::string& name : typedNamesOf(document)) made_.insert(name);
    for (const auto& [name, value] : parametersAt(document)) made_.insert(name);
}

TypedNames::Outcome TypedNames::outcomeOf(const Value& document, const std::string& place, const Value& typed,
                                          bool triesStarts) const {
    Outcome out{{{place, typed}}, {}, {}, {}, false};
    const TypedKind& kind = *typedKindOf(document);
    const Value next = withEdits(document, out.edits);
    FormulaNames names(kind);
    names.read(formulaIn(*valueAt(next, "/model")).text);
    if (!names.isRead) return out;
    const Names before = typedNamesOf(document);
    Value::Object parameters = parametersAt(document);
    FormulaNames beside(kind);
    for (const PlacedFormula& part : partFormulas(next)) beside.read(part.text);
    const auto isMentioned = [&](const std::string& name) {
        return has(names.all, name) || has(beside.all, name);
    };
    const bool isFirst = place == kind.formulaPlace(), makesNames = isFirst && kind.hasRates();

    // Names that were made while typing, and that nothing uses any more.
    std::erase_if(parameters, [&](const Value::Member& m) {
        return made_.contains(m.first) && !isMentioned(m.first) && !isUsedBesides(document, m.first);
    });
    Names after = before;
    std::erase_if(after, [&](const std::string& name) {
        return makesNames && made_.contains(name) && !isMentioned(name);
    });
    const auto isParameter = [&](const std::string& name) {
        return std::any_of(parameters.begin(), parameters.end(),
                           [&](const Value::Member& m) { return m.first == name; });
    };
    const auto isSound = [&](const std::string& name, const Names& known) {
        if (!nameProblem(name).empty() || isFunctionName(name)) return false;
        if (meant_.contains(name) || !isSlip(name, known)) return true;
        if (!has(out.slips, name)) out.slips.push_back(name);
        return false;
    };
    const Names coordinatesKnown = after;
    for (const std::string& name : makesNames ? names.rates : Names{}) {
        if (has(after, name) || (isParameter(name) && !made_.contains(name))) continue;
        if (isParameter(kind.rateOf(name))) continue;  // a constant that is called p_x
        if (!isSound(name, coordinatesKnown)) continue;
        std::erase_if(parameters, [&](const Value::Member& m) { return m.first == name; });
        after.push_back(name);
        out.coordinates.push_back(name);
    }
    // Another system altogether: coordinates that it does not have would have no inertia.
    if (!out.coordinates.empty())
        std::erase_if(after, [&](const std::string& name) { return !isMentioned(name); });
    Names known = after;
    for (const auto& [name, value] : parameters) known.push_back(name);
    const Names wanted = isFirst ? names.all : namesInPart(kind, typed);
    const Value* const controls = valueAt(next, "/model/controls");
    for (const std::string& name : wanted) {
        if (name == "t" || name == "pi" || has(after, name) || isParameter(name)) continue;
        if (has(names.rates, name) || has(beside.rates, name)) continue;
        if (controls && controls->find(name)) continue;
        if (!isSound(name, known)) continue;
        const auto kept = remembered_.find(name);
        parameters.emplace_back(name, kept != remembered_.end() ? kept->second : Value(valueFor(name)));
        out.parameters.push_back(name);
    }
    if (after.empty()) return out;

    const bool hasOtherCoordinates = after != before;
    out.changesNames = hasOtherCoordinates || !(parameters == parametersAt(document));
    if (out.changesNames || hasRefusedNames_)
        out.edits.insert(out.edits.begin(), {"/model/parameters", Value(parameters)});
    if (kind.hasRates() && (hasOtherCoordinates || hasRefusedNames_))
        addCoordinates(document, before, after, remembered_, triesStarts && hasOtherCoordinates, out.edits);
    // Places and lengths change by mouse and slider: the start follows the constraints.
    if (place.starts_with("/model/constraints/") && !valueAt(document, "/initial/project"))
        out.edits.push_back({"/initial/project", true});
    return out;
}

void TypedNames::drop(Workspace& workspace, const std::string& place) {
    if (std::exchange(hasRefusedNames_, false) && workspace.draftAt(place))
        for (const char* name : {"/model/coordinates", "/model/parameters", "/initial", "/initial/project"})
            workspace.dropDraft(name);
    workspace.dropDraft(place);
}

bool TypedNames::edit(Workspace& workspace, const std::string& place, const Value& typed,
                      const QString& what) {
    const Value document = workspace.document();
    const Outcome outcome = outcomeOf(document, place, typed, true);
    slips_ = outcome.slips;
    // What goes is remembered.
    const Value next = withEdits(document, outcome.edits);
    const Names before = typedNamesOf(document), after = typedNamesOf(next);
    const Value* const places = valueAt(document, "/initial/q");
    for (std::size_t i = 0; i < before.size(); ++i)
        if (!has(after, before[i]) && places && places->isArray() && i < places->asArray().size())
            remembered_[before[i]] = places->asArray()[i];
    const Value::Object parameters = parametersAt(next);
    for (const auto& [name, value] : parametersAt(document))
        if (std::none_of(parameters.begin(), parameters.end(),
                         [&name = name](const Value::Member& m) { return m.first == name; }))
            remembered_[name] = value;
    const bool isMade = workspace.edit(outcome.edits, what, QString::fromStdString(place));
    hasRefusedNames_ = !isMade && (outcome.changesNames || hasRefusedNames_);
    if (!isMade) return false;
    made_.insert(outcome.coordinates.begin(), outcome.coordinates.end());
    made_.insert(outcome.parameters.begin(), outcome.parameters.end());
    if (!outcome.coordinates.empty() || !outcome.parameters.empty())
        note_ = sentence(outcome.coordinates, outcome.parameters, parameters);
    return true;
}

}  // namespace extremal
