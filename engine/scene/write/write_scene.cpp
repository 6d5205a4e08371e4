// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/read/reader.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {
namespace {

Value numbersValue(const std::vector<Number>& numbers) {
    Value::Array values;
    for (const Number& n : numbers) values.push_back(numberValue(n));
    return values;
}

Value initialValue(const Initial& initial) {
    Value value{Value::Object{}};
    const Value given = settingsValue(initial.given);
    for (const auto& [key, member] : given.asObject())
        if (key != "type") value.set(key, member);
    if (!initial.given.keys.empty()) return value;
    if (!initial.q.empty()) value.set("q", numbersValue(initial.q));
    if (initial.second == Initial::Second::momentum) value.set("p", numbersValue(initial.pOrV));
    if (initial.second == Initial::Second::velocity) value.set("v", numbersValue(initial.pOrV));
    if (initial.second == Initial::Second::position) value.set("q1", numbersValue(initial.pOrV));
    if (initial.at) value.set("at", numberValue(*initial.at));
    if (initial.isProjected) value.set("project", true);
    return value;
}

Value referenceValue(const ReferenceSpec& reference) {
    Value value(Value::Object{{"type", format::referenceKinds[static_cast<std::size_t>(reference.kind)]}});
    for (const SchemeSpec& scheme : reference.scheme) value.set("scheme", schemeValue(scheme));
    if (reference.kind == ReferenceSpec::Kind::file) value.set("path", reference.path);
    return value;
}

Value rangeValue(const ViewRange& range) {
    return Value::Array{numberValue(range.low), numberValue(range.high)};
}

Value viewValue(const View& view) {
    Value value(Value::Object{{"view", view.id}});
    if (!view.x.empty()) value.set("x", view.x);
    if (!view.y.empty()) value.set("y", view.y);
    if (!view.at.empty()) value.set("at", view.at);
    if (!view.scheme.empty()) value.set("scheme", view.scheme);
    if (view.node) value.set("node", numberValue(*view.node));
    Value range{Value::Object{}};
    if (view.xRange) range.set("x", rangeValue(*view.xRange));
    if (view.yRange) range.set("y", rangeValue(*view.yRange));
    if (!range.asObject().empty()) value.set("range", range);
    if (view.isLog) value.set("log", *view.isLog);
    if (!view.curve.expression.empty()) value.set("curve", view.curve.expression);
    Value::Array starts;
    for (const auto& [x, y] : view.starts.points)
        starts.push_back(Value::Array{numberValue(x), numberValue(y)});
    if (!starts.empty()) value.set("starts", starts);
    if (view.starts.spread > 0) value.set("spread", view.starts.spread);
    Value size{Value::Object{}};
    if (view.size.width > 0) size.set("width", view.size.width);
    if (view.size.height > 0) size.set("height", view.size.height);
    if (!size.asObject().empty()) value.set("size", size);
    const Value keys = settingsValue(view.keys);
    for (const auto& [key, member] : keys.asObject())
        if (key != "type") value.set(key, member);
    return value.asObject().size() == 1 ? Value(view.id) : value;
}

Value shownValue(const Shown& shown) {
    Value value{Value::Object{}};
    if (shown.time) value.set("time", numberValue(*shown.time));
    if (shown.pinned) value.set("pinned", numberValue(*shown.pinned));
    if (shown.layout) value.set("layout", format::layouts[static_cast<std::size_t>(*shown.layout)]);
    return value;
}

Value eventValue(const EventSpec& event) {
    Value value(Value::Object{{"expression", event.expression}});
    if (!event.label.empty()) value.set("label", event.label);
    value.set("direction", format::directions[static_cast<std::size_t>(event.direction)]);
    value.set("action", format::actions[static_cast<std::size_t>(event.action)]);
    if (event.action == EventSpec::Action::reflect) value.set("restitution", event.restitution);
    if (event.action == EventSpec::Action::change) {
        value.set("parameter", event.parameter);
        value.set("value", numberValue(event.value));
    }
    return value;
}

template <class Items, class ToValue>
Value listOf(const Items& items, ToValue toValueOf) {
    Value::Array values;
    for (const auto& item : items) values.push_back(toValueOf(item));
    return values;
}

}  // namespace

Value schemeValue(const SchemeSpec& scheme) {
    Value value{Value::Object{}};
    value.set("label", scheme.label);
    value.set("enabled", scheme.isEnabled);
    if (scheme.style) value.set("style", *scheme.style + 1);
    if (scheme.tolerance)
        value.set("tolerance", *scheme.tolerance);
    else
        value.set("step", numberValue(scheme.step));
    switch (scheme.kind) {
        case SchemeSpec::Kind::discretization:
            value.set("space", settingsValue(scheme.space));
            value.set("quadrature", ruleValue(scheme.quadrature));
            break;
        case SchemeSpec::Kind::baseline:
            value.set("baseline", scheme.baseline.keys.empty() ? Value(scheme.baseline.type)
                                                               : settingsValue(scheme.baseline));
            break;
        case SchemeSpec::Kind::named:
            value.set("scheme", scheme.named);
            break;
    }
    if (!scheme.composition.type.empty()) value.set("composition", settingsValue(scheme.composition));
    if (isEnergyAlone(scheme.keep))
        value.set("keep", scheme.keep.front().text);
    else if (!scheme.keep.empty())
        value.set("keep", listOf(scheme.keep, [](const KeptQuantity& each) { return Value(each.text); }));
    if (scheme.impact != ImpactLaw::energy)
        value.set("impact", format::impactLaws[static_cast<std::size_t>(scheme.impact)]);
    if (!scheme.monitor.type.empty()) value.set("monitor", settingsValue(scheme.monitor));
    value.set("solver", settingsValue(scheme.solver, "method"));
    value.set("allow_unstable", scheme.allowsUnstable);
    return value;
}

Value toValue(const Scene& scene) {
    Value value{Value::Object{}};
    value.set("extremal", 1);
    for (const auto& [key, text] : {std::pair{"title", &scene.title},
                                    {"source", &scene.source},
                                    {"lesson", &scene.lesson},
                                    {"notes", &scene.notes}})
        if (!text->empty()) value.set(key, *text);
    value.set("model", settingsValue(scene.model));
    value.set("initial", initialValue(scene.initial));
    value.set("time",
              Value(Value::Object{{"start", numberValue(scene.start)}, {"end", numberValue(scene.end)}}));
    value.set("schemes", listOf(scene.schemes, schemeValue));
    value.set("reference", referenceValue(scene.reference));
    value.set("observe", listOf(scene.observe, [](const std::string& name) { return Value(name); }));
    if (!scene.sensitivity.empty())
        value.set("sensitivity",
                  listOf(scene.sensitivity, [](const std::string& pointer) { return Value(pointer); }));
    if (!scene.events.empty()) value.set("events", listOf(scene.events, eventValue));
    if (scene.every)
        value.set("output",
                  Value(Value::Object{{"every", numberValue(*scene.every)}, {"dense", scene.isDense}}));
    value.set("views", listOf(scene.views, viewValue));
    if (!(scene.shown == Shown())) value.set("show", shownValue(scene.shown));
    value.set("limits", Value(Value::Object{{"steps", scene.maxSteps}}));
    return value;
}

std::string writeScene(const Scene& scene) { return writeJson(toValue(scene)); }

}  // namespace extremal
