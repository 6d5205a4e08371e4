// SPDX-License-Identifier: GPL-3.0-or-later
/// The key `events` of a scene: where expressions in the state pass zero.
#include <algorithm>

#include "engine/core/text/text.hpp"
#include "engine/scene/event_names.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/reflections.hpp"
#include "engine/scene/switches.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostEvents = 50;

/// The place of a word among those that a key can have; the first where it is left out.
int wordOf(Reader& reader, const Value& object, const std::string& key, const std::string& pointer,
           const std::vector<std::string>& words) {
    const Value* value = object.find(key);
    if (!value) return 0;
    const std::string at = childPointer(pointer, key);
    const auto text = reader.text(*value, at);
    if (!text) return 0;
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found != words.end()) return static_cast<int>(found - words.begin());
    reader.unknownName(at, key, *text, words);
    return 0;
}

/// The expression, and the values of the parameters in it and in its integrals.
void readExpression(Reader& reader, const std::string& text, const std::string& at, const System& system,
                    EventSpec& event) {
    std::vector<std::string> parameters, names;
    for (const auto& [name, number] : reader.parameters) parameters.push_back(name);
    for (const StateName& each : stateNames(system, parameters)) names.push_back(each.name);
    EventText parts;
    try {
        parts = EventText::of(text);
    } catch (const ExpressionError& e) {
        return reader.error(
            at, "the expression " + std::string(e.what()) + "\n" + caretLines(text, e.position), e.hint);
    }
    std::vector<std::string> all = names;
    for (const std::string& name : parts.integralNames()) all.push_back(name);
    const auto add = [&](const std::string& part, const std::vector<std::string>& known) {
        const auto values = reader.function(part, at, known);
        if (!values) return false;
        for (const auto& each : *values)
            if (std::find(event.values.begin(), event.values.end(), each) == event.values.end())
                event.values.push_back(each);
        const auto used = parseExpression(part).names();
        const bool isOfState = std::any_of(used.begin(), used.end(), [&](const std::string& name) {
            return std::find(known.begin(), known.end(), name) != known.end();
        });
        if (!isOfState && &known == &all)
            reader.error(at, "has nothing of the state in it", "names are " + joinNames(names));
        return isOfState || &known != &all;
    };
    if (!add(parts.outer, all)) return;
    for (const std::string& each : parts.integrands)
        if (!add(each, names)) return;
}

/// The keys of one action, which the others do not have.
void readActionKeys(Reader& reader, const Value& object, const std::string& pointer, EventSpec& event) {
    using Action = EventSpec::Action;
    const auto isAllowed = [&](const char* key, Action action, const char* what, const char* hint) {
        if (object.find(key) && event.action != action) reader.error(pointer + "/" + key, what, hint);
        return event.action == action;
    };
    if (isAllowed("restitution", Action::reflect, "is for events that reflect", R"("action": "reflect")"))
        if (const Value* restitution = object.find("restitution"))
            if (const auto number = reader.number(*restitution, pointer + "/restitution",
                                                  {.min = 0, .max = 1, .hint = "1: elastic"}))
                event.restitution = number->value;
    const char* const what = "is for events that switch a parameter";
    const char* const hint = R"("action": "switch")";
    if (isAllowed("parameter", Action::change, what, hint)) {
        if (const Value* parameter = object.find("parameter"))
            event.parameter = reader.text(*parameter, pointer + "/parameter").value_or("");
        else
            reader.error(pointer + "/parameter", "is required: what is switched",
                         R"("parameter": "g", "value": 0)");
    }
    if (isAllowed("value", Action::change, what, hint)) {
        if (const Value* value = object.find("value"))
            event.value = reader.number(*value, pointer + "/value", {}).value_or(Number{});
        else
            reader.error(pointer + "/value", "is required: what the parameter is from then on",
                         R"("parameter": "g", "value": 0)");
    }
}

std::vector<Problem> actionProblems(const EventSpec& event, const Scene& scene, const System& system) {
    switch (event.action) {
        case EventSpec::Action::reflect:
            return reflectionProblems(event, system);
        case EventSpec::Action::change:
            return switchProblems(event, scene, system);
        default:
            return {};
    }
}

}  // namespace

void readEvents(Reader& reader, const Value& document, const System* system, Scene& scene) {
    const Value* events = document.find("events");
    if (!events || !reader.isArray(*events, "/events", "events") ||
        !reader.hasAtMost(*events, "/events", "events", mostEntries))
        return;
    if (events->asArray().size() > mostEvents)
        return reader.error("/events", "has " + std::to_string(events->asArray().size()) +
                                           " events, the limit is " + std::to_string(mostEvents));
    if (system && !events->asArray().empty() && (stateColumns(*system).empty() || system->independent != "t"))
        return reader.error("/events",
                            "need a motion of a few numbers, which " + scene.model.type + " is not",
                            "leave them out");
    for (std::size_t i = 0; i < events->asArray().size(); ++i) {
        const std::string pointer = childPointer("/events", i);
        const Value& value = events->asArray()[i];
        const Value object = value.isString() ? Value(Value::Object{{"expression", value}}) : value;
        if (!reader.isObject(object, pointer)) continue;
        reader.checkKeys(object, pointer, format::event);
        EventSpec event;
        event.direction = static_cast<EventSpec::Direction>(
            wordOf(reader, object, "direction", pointer, format::directions));
        event.action =
            static_cast<EventSpec::Action>(wordOf(reader, object, "action", pointer, format::actions));
        if (const Value* label = object.find("label"))
            event.label = reader.label(*label, pointer + "/label").value_or("");
        const Value* expression = object.find("expression");
        const std::string at = value.isString() ? pointer : pointer + "/expression";
        if (!expression) {
            reader.error(at, "is required: what passes zero", R"("expression": "x - 1")");
            continue;
        }
        const auto text = reader.text(*expression, at);
        if (!text || !system) continue;
        event.expression = *text;
        const std::size_t errorsBefore = reader.errors.size();
        readExpression(reader, *text, at, *system, event);
        readActionKeys(reader, object, pointer, event);
        if (reader.errors.size() == errorsBefore)
            for (const Problem& p : actionProblems(event, scene, *system))
                reader.error(p.pointer.empty() ? at : pointer + p.pointer, p.message, p.hint);
        if (reader.errors.size() == errorsBefore) scene.events.push_back(std::move(event));
    }
}

}  // namespace extremal
