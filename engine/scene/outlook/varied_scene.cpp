// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/varied_scene.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/varied_numbers.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/reflections.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/typed_scene.hpp"

namespace extremal {
namespace {

using Parameters = std::map<std::string, double>;

/// Constants of a model's formulas: its own key "parameters", or its keys that are numbers.
Parameters constantsOf(const Settings& model) {
    Parameters all;
    const Value* const own = model.find("parameters");
    for (const auto& [name, value] : own && own->isObject() ? own->asObject() : model.keys)
        if (value.isNumber()) all.emplace(name, value.asNumber());
    return all;
}
Parameters constantsOf(const System& system, const Settings& model) {
    const auto* const form = system.parts.find<WrittenForm>();
    return constantsOf(form ? form->settings : model);
}

/// A formula with something in place of a name that stands by itself.
std::string replaced(const std::string& text, const std::string& name, const std::string& by) {
    const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    std::string result;
    std::size_t from = 0;
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
        const std::size_t end = at + name.size();
        if (at < from || (at > 0 && isPart(text[at - 1])) || (end < text.size() && isPart(text[end])))
            continue;
        result += text.substr(from, at - from) + by;
        from = end;
    }
    return result + text.substr(from);
}
bool hasName(const std::string& text, const std::string& name) { return replaced(text, name, "") != text; }
/// The same in every text of a value.
void replaceIn(Value& value, const std::string& name, const std::string& by) {
    if (value.isString()) value = Value(replaced(value.asString(), name, by));
    if (value.isArray())
        for (Value& each : value.asArray()) replaceIn(each, name, by);
    if (value.isObject())
        for (auto& [key, each] : value.asObject()) replaceIn(each, name, by);
}

const std::string* termAt(const Scene& scene, const std::vector<std::string>& place) {
    if (place.size() != 3 || place[0] != "model" || (place[1] != "lagrangian" && place[1] != "hamiltonian"))
        return nullptr;
    const Value* const terms = scene.model.find(place[1]);
    const Value* const term = terms && terms->isObject() ? terms->find(place[2]) : nullptr;
    return term && term->isString() ? &term->asString() : nullptr;
}

/// Which entry of q, p or v; empty: none.
std::optional<std::size_t> entryOf(const std::vector<std::string>& place, const System& system) {
    if (place.size() != 3 || place[0] != "initial") return {};
    for (std::size_t i = 0; i < system.coordinates.size(); ++i)
        if (system.coordinates[i].name == place[2]) return i;
    const auto index = arrayIndex(place[2]);
    return index && *index < system.coordinates.size() ? index : std::nullopt;
}

/// A number of a scene, and its documents with other values of it.
class ScenesBy {
public:
    ScenesBy(const Scene& scene, const System& system, const std::string& pointer)
        : place_(splitPointer(pointer).value_or(std::vector<std::string>{})) {
        if (const std::string* const term = termAt(scene, place_)) {
            term_ = *term;
            value_ = 1;
        } else if (const auto entry = entryOf(place_, system)) {
            place_[2] = std::to_string(*entry);
            const bool isSecond = (place_[1] == "p" && scene.initial.second == Initial::Second::momentum) ||
                                  (place_[1] == "v" && scene.initial.second == Initial::Second::velocity);
            if (place_[1] == "q" && *entry < scene.initial.q.size())
                value_ = scene.initial.q[*entry].value;
            else if (isSecond && *entry < scene.initial.pOrV.size())
                value_ = scene.initial.pOrV[*entry].value;
        } else if (place_.size() > 1 && place_[0] == "model") {
            Value given(scene.model.keys);
            const Value* at = &given;
            for (std::size_t i = 1; i < place_.size() && at; ++i) at = childOf(*at, place_[i]);
            if (at && at->isNumber()) value_ = at->asNumber();
        }
    }
    const std::optional<double>& value() const { return value_; }
    const std::string& term() const { return term_; }
    const std::vector<std::string>& place() const { return place_; }

    /// In `document`, where the number is there.
    void set(Value& document, double value) const {
        Value* at = &document;
        for (const std::string& token : place_) at = const_cast<Value*>(childOf(*at, token));
        *at = term_.empty() ? Value(value) : Value("(" + formatNumber(value, 17) + ")*(" + term_ + ")");
    }

private:
    std::vector<std::string> place_;
    std::string term_;  ///< empty: a number
    std::optional<double> value_;
};

/// What a scene starts from.
struct Start {
    Parameters parameters;
    std::vector<double> x;
};
std::optional<Start> startOf(const Scene& scene, const Value& document, std::string& problem) {
    Reader reader;
    Scene changed = scene;
    try {
        auto system = readModel(reader, document, changed);
        if (system) addReflections(*system, scene.events);
        if (system) readInitial(reader, document, *system, changed);
        if (reader.errors.empty())
            return Start{constantsOf(*system, changed.model), initialState(changed, *system).x};
        problem = reader.errors.front().message;
    } catch (const InvalidScene& e) {
        problem = e.problems().front().message;
    }
    return {};
}

/// Weights of a derivative at places k * e.
struct Differences {
    int first;
    std::vector<double> weights;
};
const Differences& central() {
    static const Differences order8{
        -4, {1.0 / 280, -4.0 / 105, 1.0 / 5, -4.0 / 5, 0, 4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280}};
    return order8;
}
/// At the least value that a number may have.
const Differences& ahead() {
    static const Differences order6{0, {-49.0 / 20, 6, -15.0 / 2, 20.0 / 3, -15.0 / 4, 6.0 / 5, -1.0 / 6}};
    return order6;
}

/// d/dmu; shorter differences where the scene does not exist so far away. What does not change has a
/// derivative of exactly 0: differences are taken from the values at mu.
std::optional<Start> derivativeBy(const Scene& scene, const Value& document, const ScenesBy& number,
                                  std::string& problem) {
    constexpr double longest = 0x1p-7, shortest = 0x1p-15;
    const double mu = *number.value(), scale = mu == 0 ? 1 : std::abs(mu);
    const auto here = startOf(scene, document, problem);
    if (!here) return {};
    for (const Differences* differences : {&central(), &ahead()})
        for (double part = longest; part >= shortest; part /= 16) {
            const double e = part * scale;
            Start sum;
            bool isWhole = true;
            for (std::size_t i = 0; i < differences->weights.size() && isWhole; ++i) {
                const double weight = differences->weights[i] / e;
                if (weight == 0) continue;
                Value changed = document;
                number.set(changed, mu + (differences->first + static_cast<int>(i)) * e);
                const auto there = startOf(scene, changed, problem);
                isWhole = there && there->x.size() == here->x.size();
                if (!isWhole) break;
                sum.x.resize(there->x.size());
                for (std::size_t k = 0; k < sum.x.size(); ++k)
                    sum.x[k] += weight * (there->x[k] - here->x[k]);
                for (const auto& [name, value] : there->parameters)
                    if (const auto now = here->parameters.find(name); now != here->parameters.end())
                        sum.parameters[name] += weight * (value - now->second);
            }
            if (isWhole) return sum;
        }
    return {};
}

/// A name that nothing of the model has.
std::string freeName(const Value& model, std::string name) {
    const std::string text = writeJson(model);
    while (hasName(text, name)) name += "u";
    return name;
}

/// The scene's model as formulas.
Value formulaModel(const ResolvedScene& scene) {
    const std::string& type = scene.scene.model.type;
    const bool isTyped = type == "lagrangian" || type == "hamiltonian";
    return *(isTyped ? toValue(scene.scene) : typedScene(scene)).find("model");
}

/// Adds L = M/2 u'^2 for each of the names, M so large that u stays where it is to round-off. In a
/// Hamiltonian nothing is to be added: without their momenta in it they do not move.
void addMasses(Value& model, const std::vector<std::string>& names) {
    Value* const lagrangian = model.find("lagrangian");
    if (!lagrangian) return;
    std::string squares;
    for (const std::string& name : names) squares += (squares.empty() ? "" : "+") + name + "_t^2";
    const std::string masses = "2^99*(" + squares + ")";
    if (lagrangian->isString())
        *lagrangian = Value("(" + lagrangian->asString() + ")+" + masses);
    else
        lagrangian->set(freeName(model, "masses"), masses);
}

std::string nameOf(const Scene& scene, const System& system, const std::string& pointer) {
    const auto place = splitPointer(pointer).value_or(std::vector<std::string>{pointer});
    if (termAt(scene, place)) return "term." + place[2];
    if (const auto entry = entryOf(place, system))
        return "initial." + place[1] + "." + system.coordinates[*entry].name;
    std::string name;
    for (std::size_t i = place.size() > 2 && place[1] == "parameters" ? 2 : 1; i < place.size(); ++i)
        name += (name.empty() ? "" : ".") + place[i];
    return name;
}

/// Pointers to all parameters.
std::vector<std::string> allOf(const System& system, const Scene& scene) {
    const ModelEntry* const entry = findModel(scene.model.type);
    const auto* const form = system.parts.find<WrittenForm>();
    const std::string text = entry && entry->lagrangian ? entry->lagrangian(scene.model) : std::string();
    std::vector<std::string> pointers;
    for (const auto& [name, value] : constantsOf(system, scene.model)) {
        const bool isOwn = scene.model.find("parameters") != nullptr;
        if (form)
            pointers.push_back("/model" + form->originOf(childPointer("/parameters", name)));
        else if (isOwn)
            pointers.push_back(childPointer("/model/parameters", name));
        else if (hasName(text, name))
            pointers.push_back(childPointer("/model", name));
    }
    return pointers;
}

/// How the numbers change the start and the parameters.
struct Changes {
    std::vector<ScenesBy> numbers;
    std::vector<Parameters> parameters;  ///< of each number, those that change with it
};

/// Of a model of formulas: the names as coordinates in place of constants. Null where that is not a model,
/// with the reason.
std::shared_ptr<const System> extendedSystem(const ResolvedScene& resolved, Value model,
                                             const Parameters& values, const std::vector<std::string>& names,
                                             std::string& problem) {
    if (Value* const controls = model.find("controls"); controls && controls->isObject()) {
        Value::Object kept;
        for (const auto& [name, control] : Value::Object(controls->asObject())) {
            const bool isVaried =
                control.isString() && std::any_of(names.begin(), names.end(), [&](const std::string& varied) {
                    return hasName(control.asString(), varied);
                });
            if (isVaried)
                replaceIn(model, name, "(" + control.asString() + ")");
            else
                kept.emplace_back(name, control);
        }
        model.set("controls", Value(std::move(kept)));
    }
    Value::Object constants;
    for (const auto& [name, value] : values)
        if (std::find(names.begin(), names.end(), name) == names.end()) constants.emplace_back(name, value);
    model.set("parameters", Value(std::move(constants)));
    for (const std::string& name : names) model.find("coordinates")->asArray().emplace_back(name);
    addMasses(model, names);
    Reader reader;
    Scene extended = resolved.scene;
    auto made = readModel(reader, Value(Value::Object{{"model", std::move(model)}}), extended);
    if (!made) {
        problem = reader.errors.empty() ? "is no model" : reader.errors.front().message;
        return {};
    }
    made->fast.frequency = resolved.system->fast.frequency;
    made->fast.coordinates = resolved.system->fast.coordinates;
    addReflections(*made, resolved.scene.events);
    return std::make_shared<const System>(std::move(*made));
}

/// Adds the factors of terms to a model and to the parameters that change.
void addFactors(Value& model, Parameters& values, std::vector<std::string>& names, Changes& changes) {
    for (std::size_t i = 0; i < changes.numbers.size(); ++i) {
        const ScenesBy& number = changes.numbers[i];
        if (number.term().empty()) continue;
        const std::string factor = freeName(model, "mu" + std::to_string(i + 1));
        *model.find(number.place()[1])->find(number.place()[2]) = Value(factor + "*(" + number.term() + ")");
        names.push_back(factor);
        values[factor] = 1;
        changes.parameters[i][factor] = 1;
    }
}

/// Adds u c to a Lagrangian, or -u c to a Hamiltonian.
void addIntegrand(Value& model, const std::string& u, const std::string& integrand) {
    Value* const lagrangian = model.find("lagrangian");
    Value* const formula = lagrangian ? lagrangian : model.find("hamiltonian");
    if (!formula) throw InvalidScene("--over", "the model has no Lagrangian that an integrand is added to");
    const std::string term = u + "*(" + integrand + ")";
    if (formula->isString())
        *formula = Value("(" + formula->asString() + ")" + (lagrangian ? "+" : "-") + term);
    else
        formula->set(freeName(model, "integrand"), (lagrangian ? "" : "-") + term);
}

/// The coefficients of a control, and the start of a step, in place of it; their names.
std::vector<std::string> addControl(Value& model, const ControlCurve& control) {
    std::vector<std::string> names;
    for (int j = 0; j < control.coefficients; ++j)
        names.push_back(freeName(model, control.name + "c" + std::to_string(j)));
    names.push_back(freeName(model, control.name + "start"));
    const std::string place = "((t-" + names.back() + ")/" + formatNumber(control.step, 17) + "-0.5)";
    std::string text = names[names.size() - 2];
    for (std::size_t j = names.size() - 2; j > 0; --j) text = names[j - 1] + "+" + place + "*(" + text + ")";
    Value::Object kept;
    for (const auto& [name, each] : model.find("controls")->asObject())
        if (name != control.name) kept.emplace_back(name, each);
    model.set("controls", Value(std::move(kept)));
    replaceIn(model, control.name, "(" + text + ")");
    return names;
}

/// What VariedExtras adds to a model, to its constants and to the names of its coordinates.
void addExtras(const VariedExtras& extras, Value& model, Parameters& values, std::vector<std::string>& names,
               VariedScene& varied) {
    if (!extras.integrand.empty()) {
        const std::string u = freeName(model, "weight");
        addIntegrand(model, u, extras.integrand);
        varied.integral = names.size();
        names.push_back(u);
        values[u] = 0;
    }
    for (const ControlCurve& control : extras.controls) {
        varied.controls.push_back(names.size());
        for (const std::string& name : addControl(model, control)) {
            names.push_back(name);
            values[name] = 0;
        }
    }
}

}  // namespace

std::map<std::string, double> formulaConstants(const Scene& scene, const System& system) {
    return constantsOf(system, scene.model);
}

std::string variedNumberProblem(const Scene& scene, const System& system, const std::string& pointer) {
    if (pointer.starts_with("/model/controls/")) return "is a control, not a number of a formula";
    if (ScenesBy(scene, system, pointer).value()) return {};
    return "is not a number of the model, an initial value that the scene gives, or a term with a name";
}

std::vector<NumberOfScene> numbersOf(const Scene& scene, const System& system) {
    std::vector<std::string> pointers = allOf(system, scene);
    for (const char* const part : {"/initial/q/", "/initial/p/", "/initial/v/"})
        for (std::size_t i = 0; i < system.coordinates.size(); ++i)
            pointers.push_back(part + std::to_string(i));
    std::vector<NumberOfScene> numbers;
    for (const std::string& pointer : pointers)
        if (const auto value = ScenesBy(scene, system, pointer).value())
            numbers.push_back({pointer, nameOf(scene, system, pointer), *value});
    return numbers;
}

void nameVariedNumbers(System& system, const Scene& scene) {
    const auto& observe = scene.observe;
    if (!system.hasCoordinates() || std::find(observe.begin(), observe.end(), "sensitivity") == observe.end())
        return;
    VariedNumbers numbers;
    for (const std::string& pointer : scene.sensitivity.empty() ? allOf(system, scene) : scene.sensitivity)
        numbers.all.push_back({pointer, nameOf(scene, system, pointer)});
    system.parts.set(std::move(numbers));
}

VariedScene variedScene(const ResolvedScene& resolved, const VariedExtras& extras) {
    const Scene& scene = resolved.scene;
    const System& system = *resolved.system;
    VariedScene varied;
    const auto* const part = system.parts.find<VariedNumbers>();
    const std::vector<VariedNumbers::Each> named = part ? part->all : std::vector<VariedNumbers::Each>{};
    if (named.empty() && extras.isEmpty())
        throw InvalidScene("/sensitivity", scene.model.type + " has no parameters in formulas",
                           "list initial values, \"/initial/q/0\"");
    if (scene.initial.second == Initial::Second::position)
        throw InvalidScene("/initial/q1", "starts differ from scheme to scheme", "give p or v");
    const Value document = toValue(scene);
    Changes changes;
    std::vector<std::string> names;  // of parameters that become coordinates, then factors of terms
    const auto leave = [&](std::size_t i, const std::string& problem) {
        varied.numbers[i].start.assign(resolved.initial.x.size(), std::numeric_limits<double>::quiet_NaN());
        if (varied.problem.empty()) varied.problem = named[i].pointer + " cannot be varied: " + problem;
    };
    for (std::size_t i = 0; i < named.size(); ++i) {
        const VariedNumbers::Each& each = named[i];
        const ScenesBy& number = changes.numbers.emplace_back(scene, system, each.pointer);
        std::string problem;
        const auto derivative =
            number.value() ? derivativeBy(scene, document, number, problem) : std::nullopt;
        varied.numbers.push_back({each.name, derivative ? derivative->x : std::vector<double>{}, {}});
        changes.parameters.emplace_back();
        if (!derivative) {
            leave(i, problem);
            continue;
        }
        for (const auto& [name, rate] : derivative->parameters) {
            if (rate == 0) continue;
            changes.parameters[i][name] = rate;
            if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        }
    }
    const bool hasTerms = std::any_of(changes.numbers.begin(), changes.numbers.end(),
                                      [](const ScenesBy& number) { return !number.term().empty(); });
    if (names.empty() && !hasTerms && extras.isEmpty()) return varied;

    Value model = formulaModel(resolved);
    Parameters values = constantsOf(system, scene.model);
    addFactors(model, values, names, changes);
    addExtras(extras, model, values, names, varied);
    std::string problem;
    varied.system = extendedSystem(resolved, model, values, names, problem);
    if (!varied.system && !extras.isEmpty()) throw InvalidScene("--over", problem);
    if (!varied.system) {  // without those that are no coordinates by themselves
        std::erase_if(names, [&](const std::string& name) {
            if (extendedSystem(resolved, model, values, {name}, problem)) return false;
            for (std::size_t i = 0; i < changes.numbers.size(); ++i)
                if (changes.parameters[i].contains(name)) leave(i, problem);
            return true;
        });
        if (!names.empty()) varied.system = extendedSystem(resolved, model, values, names, problem);
        if (!names.empty() && !varied.system) throw InvalidScene("/sensitivity", problem);
    }
    varied.names = names;
    for (const std::string& name : names) {
        varied.parameters.push_back(values.at(name));
        for (std::size_t i = 0; i < changes.numbers.size(); ++i) {
            const auto rate = changes.parameters[i].find(name);
            varied.numbers[i].parameters.push_back(rate == changes.parameters[i].end() ? 0 : rate->second);
        }
    }
    return varied;
}

}  // namespace extremal
