// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "engine/core/text/indexed.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/parts/named_start.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {
namespace {

constexpr std::size_t maxTwice = 2000;  ///< names that are looked at for two values of one

std::vector<std::string> coordinateNames(const System& system) {
    std::vector<std::string> names;
    for (const Coordinate& c : system.coordinates) names.push_back(c.name);
    return names;
}

std::string countOf(std::size_t n, const std::vector<std::string>& names) {
    return std::to_string(n) + (n == 1 ? " number (" : " numbers (") + joinNames(names) + ")";
}

/// An object by name with what is typed by index written out: {"x[1..n]": 0, "y[i = 1..n]": "-i*l"}. Others
/// are left as they are.
Value byNames(Reader& reader, const Value& value, const std::string& pointer) {
    const auto isByIndex = [](const Value::Member& m) { return hasIndices(m.first); };
    if (!value.isObject() || std::none_of(value.asObject().begin(), value.asObject().end(), isByIndex))
        return value;
    NamedNumbers parameters;
    for (const auto& [name, number] : reader.parameters)
        if (number) parameters.emplace_back(name, *number);
    Value::Object all;
    for (const auto& [key, given] : value.asObject()) {
        try {
            for (const IndexedName& n : namesOf(key, parameters)) {
                const bool isText = given.isString() && !n.index.empty();
                all.emplace_back(n.name, isText ? Value(writtenOut(given.asString(), parameters, n)) : given);
            }
        } catch (const ExpressionError& e) {
            reader.error(childPointer(pointer, key), std::string(e.what()), e.hint);
        }
    }
    for (std::size_t i = 1; i < all.size(); ++i)
        for (std::size_t j = 0; j < i && all.size() <= maxTwice; ++j)
            if (all[i].first == all[j].first)
                reader.error(childPointer(pointer, all[i].first), "has two values",
                             "one for each coordinate");
    return Value(std::move(all));
}

/// One number per coordinate: an array in their order, or an object by name.
std::vector<Number> readVector(Reader& reader, const Value& given, const std::string& pointer,
                               const System& system) {
    const Value value = byNames(reader, given, pointer);
    const auto names = coordinateNames(system);
    std::vector<Number> numbers(names.size());
    if (value.isArray()) {
        if (value.asArray().size() != names.size()) {
            reader.error(pointer, "must have " + countOf(names.size(), names) + ", got " +
                                      std::to_string(value.asArray().size()));
            return numbers;
        }
        for (std::size_t i = 0; i < names.size(); ++i)
            if (const auto n = reader.number(value.asArray()[i], childPointer(pointer, i), {}))
                numbers[i] = *n;
    } else if (value.isObject()) {
        reader.checkKeys(value, pointer, names);
        for (std::size_t i = 0; i < names.size(); ++i) {
            const std::string place = childPointer(pointer, names[i]);
            if (const Value* member = value.find(names[i])) {
                if (const auto n = reader.number(*member, place, {})) numbers[i] = *n;
            } else {
                reader.error(place, "is required", "every coordinate needs a value: " + joinNames(names));
            }
        }
    } else {
        reader.error(pointer, "must be an array of " + countOf(names.size(), names) +
                                  " or an object by name, got " + describeValue(value));
    }
    return numbers;
}

std::vector<Number> literals(const std::vector<double>& values) {
    std::vector<Number> numbers;
    for (const double v : values) numbers.push_back({v, {}});
    return numbers;
}

/// Keys of the model's own; the system says what is wrong with them together.
void readGiven(Reader& reader, const Value* initial, const System& system, const ModelEntry& entry,
               double start, Initial& result) {
    const NamedStart* const own = system.parts.find<NamedStart>();
    const std::vector<FieldInfo>& fields = own ? own->fields : entry.initial;
    Reader quiet;
    readFields(quiet, entry.exampleInitial, "/initial", fields, {}, result.given);
    if (!initial && fields.empty()) return;  // nothing to say
    if (!initial) return reader.warning("/initial", "is missing: the run starts from the model's example");
    if (!reader.isObject(*initial, "/initial")) return;
    Settings given;
    if (!readFields(reader, *initial, "/initial", fields, {}, given)) return;
    try {
        system.start(given, start);
        if (own)
            for (const Problem& p : own->notes(given))
                reader.warning("/initial" + p.pointer, p.message, p.hint);
        result.given = std::move(given);
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) reader.error("/initial" + p.pointer, p.message, p.hint);
    }
}

}  // namespace

void readInitial(Reader& reader, const Value& document, const System& system, Scene& scene) {
    const ModelEntry* entry = findModel(scene.model.type);
    const Value* initial = document.find("initial");
    Initial& result = scene.initial;
    if (system.start) return readGiven(reader, initial, system, *entry, scene.start.value, result);
    // The example of a model whose coordinates are the user's own fits only some; the others start from zero.
    const std::size_t d = system.coordinates.size();
    const bool saysItself = system.parts.find<WrittenForm>() != nullptr;
    if (saysItself && !initial) return;
    const bool fits = entry->exampleQ.size() == d;
    result.q = fits ? literals(entry->exampleQ) : std::vector<Number>(d);
    result.second = Initial::Second::momentum;
    result.pOrV = fits ? literals(entry->exampleP) : std::vector<Number>(d);
    if (!initial) {
        reader.warning("/initial", "is missing: the run starts from the model's example");
        return;
    }
    if (!reader.isObject(*initial, "/initial")) return;
    reader.checkKeys(*initial, "/initial", format::initial);
    if (const Value* project = initial->find("project"))
        result.isProjected = reader.flag(*project, "/initial/project").value_or(false);
    const Value* q = initial->find("q");
    const Value* p = initial->find("p");
    const Value* v = initial->find("v");
    if (q)
        result.q = readVector(reader, *q, "/initial/q", system);
    else if (!saysItself)
        reader.warning("/initial/q", "is missing: the model's example is taken");
    else
        result.q.clear();
    const Value* q1 = initial->find("q1");
    const Value* at = initial->find("at");
    std::vector<std::string> given;
    for (const char* key : {"p", "v", "q1"})
        if (initial->find(key)) given.emplace_back(key);
    if (given.size() > 1)
        reader.error("/initial", "has " + std::string(given.size() == 2 ? "both " : "") + joinNames(given),
                     q1 ? "give the momentum, the velocity or the second position"
                        : "give the momentum or the velocity");
    if (at && !q1) reader.error("/initial/at", "requires q1", "q1 is the position that much after the start");
    const Mechanical* const lagrangian = system.parts.find<Mechanical>();  // whose L_v is the momentum
    if (!lagrangian && (v || q1)) {
        reader.error(v ? "/initial/v" : "/initial/q1",
                     "does not say the momenta of a model without a Lagrangian", "p, one per coordinate");
        v = q1 = nullptr;
    }
    if (saysItself) result.second = Initial::Second::none;
    if (saysItself) result.pOrV.clear();
    if (!saysItself && (q || p || v)) result.pOrV.assign(system.coordinates.size(), Number{});
    if (p) result.pOrV = readVector(reader, *p, "/initial/p", system);
    if (p) result.second = Initial::Second::momentum;
    if (v && !p) {
        result.second = Initial::Second::velocity;
        result.pOrV = readVector(reader, *v, "/initial/v", system);
    }
    if (!q1 || given.size() > 1) return;
    if (result.q.empty()) result.q = literals(system.parts.find<WrittenForm>()->q);
    result.second = Initial::Second::position;
    result.pOrV = readVector(reader, *q1, "/initial/q1", system);
    if (at) result.at = reader.number(*at, "/initial/at", Limits::positive());
}

void readStart(Reader& reader, const System& system, Scene& scene) {
    Initial& initial = scene.initial;
    if (initial.second != Initial::Second::position) return;
    const std::size_t before = reader.errors.size();
    if (!initial.at && before == 0) {
        // The position after the first step, where all schemes agree how long that is.
        for (const SchemeSpec& scheme : scene.schemes) {
            if (scheme.tolerance) continue;
            if (!initial.at) initial.at = scheme.step;
            if (initial.at->value != scheme.step.value) {
                reader.error("/initial/at", "is required: the schemes have different steps",
                             "the time from q to q1, for example " + formatNumber(initial.at->value));
                break;
            }
        }
        if (!initial.at)
            reader.error("/initial/at", "is required: no scheme has a step", "the time from q to q1");
    }
    try {
        if (reader.errors.empty()) exactStart(scene, system);
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) reader.error(p.pointer, p.message, p.hint);
    }
    if (reader.errors.empty()) return;
    // What is wrong is said; the rest is checked as for a start at rest.
    initial.second = Initial::Second::momentum;
    initial.pOrV.assign(system.coordinates.size(), Number{});
}

}  // namespace extremal
