// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/scene_fields.hpp"

#include <algorithm>
#include <utility>

#include "engine/model/spatial/space_kinds.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/scene.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {

namespace {

/// Another action, with the keys that it needs and without those of the one before.
std::vector<Edit> actionEdits(const EventSpec& event, const std::vector<ModelParameter>& parameters,
                              const std::string& place, const Value& action) {
    std::vector<Edit> edits{{place + "/action", action}};
    if (event.action == EventSpec::Action::reflect) edits.push_back({place + "/restitution", std::nullopt});
    if (event.action == EventSpec::Action::change)
        for (const char* key : {"/parameter", "/value"}) edits.push_back({place + key, std::nullopt});
    if (action == Value("reflect") && event.direction == EventSpec::Direction::both)
        edits.push_back({place + "/direction", Value("down")});
    if (action == Value("switch") && !parameters.empty()) {
        edits.push_back({place + "/parameter", Value(parameters.front().name)});
        edits.push_back({place + "/value", Value(parameters.front().value)});
    }
    return edits;
}

FormField switchedParameter(const std::vector<ModelParameter>& parameters, const std::string& place,
                            const QString& label) {
    std::vector<std::string> names;
    for (const ModelParameter& each : parameters) names.push_back(each.name);
    return {choiceField("parameter", "parameter", names, "The parameter of the model that is switched."),
            place + "/parameter",
            label,
            {}};
}

void addEventFields(const EventSpec& event, const std::vector<ModelParameter>& parameters,
                    const std::string& place, const QString& number, std::vector<FormField>& fields) {
    fields.push_back({textField("expression", "event", nullptr,
                                "Where this passes zero: coordinates by their names, velocities as <name>_t, "
                                "momenta as p_<name>, energy, reaction_<constraint>, integral(..) over time, "
                                "t and the parameters of the model."),
                      place + "/expression",
                      QObject::tr("event %1").arg(number),
                      {}});
    fields.push_back({choiceField("direction", "direction", format::directions, "Which way it passes zero."),
                      place + "/direction",
                      QObject::tr("direction %1").arg(number),
                      {}});
    fields.push_back(
        {choiceField("action", "action", format::actions,
                     "write: with time and state into a file, and as marks; count: how often; stop: the run "
                     "ends there; reflect: the motion bounces off it, from the side that the direction says; "
                     "switch: a parameter of the model has another value from there on."),
         place + "/action", QObject::tr("action %1").arg(number),
         [=](const Value& action) { return actionEdits(event, parameters, place, action); }});
    if (event.action == EventSpec::Action::change) {
        fields.push_back(switchedParameter(parameters, place, QObject::tr("parameter %1").arg(number)));
        fields.push_back({numberField("value", "value", "", 0, "What the parameter is from the event on."),
                          place + "/value",
                          QObject::tr("value %1").arg(number),
                          {}});
    }
    if (event.action == EventSpec::Action::reflect)
        fields.push_back({numberField("restitution", "restitution", "", 1,
                                      "The part of the speed that is left after the impact, 0 to 1."),
                          place + "/restitution",
                          QObject::tr("restitution %1").arg(number),
                          {}});
}

const cartesian::ElementKind* kindOf(const std::string& model, const FieldInfo& info, const Value* elements) {
    const bool hasSome = elements && elements->isObject() && !elements->asObject().empty();
    return hasSome && info.type == FieldType::json ? spatial::findKind(model, info.key) : nullptr;
}

/// One value of an element; of a place one row for each of its numbers.
void addElementField(const FieldInfo& info, const Value& value, const std::string& place,
                     const QString& label, std::vector<FormField>& fields) {
    const bool isPlace = info.type == FieldType::numbers && value.isArray();
    const std::size_t count = isPlace ? value.asArray().size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        FieldInfo row = numberField(info.key, info.title, info.unit, 0, info.description);
        const QString which = count == info.components.size() ? QString::fromStdString(info.components[i])
                                                              : QString::number(i + 1);
        fields.push_back({std::move(row), childPointer(place, i), label + ' ' + which, {}});
    }
    if (!isPlace) fields.push_back({info, place, label, {}});
}

}  // namespace

std::vector<FormField> eventFields(const Scene& scene) {
    const std::vector<ModelParameter> parameters = parametersOf(scene);
    std::vector<FormField> fields;
    for (std::size_t i = 0; i < scene.events.size(); ++i)
        addEventFields(scene.events[i], parameters, childPointer("/events", i), QString::number(i + 1),
                       fields);
    return fields;
}

std::string shapeOfEvents(const Scene& scene) {
    std::string shape;
    for (const EventSpec& event : scene.events)
        shape += format::actions[static_cast<std::size_t>(event.action)] + ' ' +
                 format::directions[static_cast<std::size_t>(event.direction)] + ';';
    for (const ModelParameter& each : parametersOf(scene)) shape += each.name + ' ';
    return scene.events.empty() ? std::string() : shape;
}

bool addElementFields(const std::string& model, const FieldInfo& info, const Value* elements,
                      const std::string& place, std::vector<FormField>& fields) {
    const cartesian::ElementKind* const kind = kindOf(model, info, elements);
    if (!kind) return false;
    for (const auto& [name, element] : elements->asObject()) {
        const std::string own = childPointer(place, name);
        const QString title = QString::fromStdString(name).toHtmlEscaped();
        for (const FieldInfo& each : kind->fields)
            if (const Value* const value = element.find(each.key))
                addElementField(each, *value, childPointer(own, each.key),
                                title + ": " + QString::fromStdString(each.key), fields);
    }
    return true;
}

std::string shapeOfElements(const std::string& model, const FieldInfo& info, const Value* elements) {
    if (!kindOf(model, info, elements)) return {};
    std::string shape = ' ' + info.key;
    for (const auto& [name, element] : elements->asObject()) {
        shape += ' ' + name;
        if (element.isObject())
            for (const Value::Member& member : element.asObject()) shape += '.' + member.first;
    }
    return shape;
}

}  // namespace extremal
