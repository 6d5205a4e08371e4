// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/sketch/mechanism_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/cartesian/element_kinds.hpp"

namespace extremal {
namespace {

using Place = MechanismDrawing::Place;

double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

double distanceToLine(const Place& p, const Place& a, const Place& b) {
    const Place along{b[0] - a[0], b[1] - a[1]};
    const double square = along[0] * along[0] + along[1] * along[1];
    const double part =
        square > 0 ? std::clamp(((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / square, 0.0, 1.0) : 0;
    return distance(p, {a[0] + part * along[0], a[1] + part * along[1]});
}

/// To 12 digits: sums and products leave some that were not drawn. A zero has no sign.
double rounded(double x) { return parseNumber(formatNumber(x, 12)).value_or(x) + 0.0; }
Value pairValue(const Place& p) { return Value::Array{rounded(p[0]), rounded(p[1])}; }

bool isIn(const Value& element, const char* key, const std::string& name) {
    const Value* const value = element.find(key);
    return value && *value == Value(name);
}

/// Whether an element has a key that names this one.
bool hangsOn(const Value& element, const MechanismDrawing::Element& on) {
    if (on.kind == "points")
        return isIn(element, "from", on.name) || isIn(element, "to", on.name) ||
               isIn(element, "point", on.name);
    if (on.kind == "rods") return isIn(element, "rod", on.name);
    return on.kind == "bodies" && isIn(element, "body", on.name);
}

void eraseKey(Value& object, const std::string& key) {
    std::erase_if(object.asObject(), [&](const Value::Member& m) { return m.first == key; });
}

}  // namespace

MechanismDrawing::MechanismDrawing(const Value& model) {
    const Value* const type = model.find("type");
    if (type && *type == Value("mechanism"))
        states_.push_back(model);
    else
        states_.emplace_back(
            Value::Object{{"type", "mechanism"}, {"parameters", Value::Object{}}, {"gravity", 9.81}});
}

const Value* MechanismDrawing::elementsOf(const char* kind) const {
    const Value* const value = model().find(kind);
    return value && value->isObject() ? value : nullptr;
}

bool MechanismDrawing::isEmpty() const { return points().empty(); }

const Value* MechanismDrawing::find(const Element& element) const {
    const Value* const all = elementsOf(element.kind.c_str());
    return all ? all->find(element.name) : nullptr;
}

double MechanismDrawing::number(const Value* value, double otherwise) const {
    if (!value) return otherwise;
    if (value->isNumber()) return value->asNumber();
    if (!value->isString()) return otherwise;
    try {
        const Value* const parameters = model().find("parameters");
        return evaluate(
            parseExpression(value->asString()), [&](std::string_view name) -> std::optional<double> {
                const Value* const found = parameters ? parameters->find(name) : nullptr;
                return found && found->isNumber() ? std::optional(found->asNumber()) : std::nullopt;
            });
    } catch (const ExpressionError&) {
        return otherwise;  // what is wrong with it is said by the scene
    }
}

Place MechanismDrawing::pair(const Value* value) const {
    if (!value || !value->isArray() || value->asArray().size() != 2) return {};
    return {number(&value->asArray()[0], 0), number(&value->asArray()[1], 0)};
}

std::optional<Place> MechanismDrawing::placeOf(const Element& element) const {
    const Value* const found = find(element);
    if (!found || (element.kind != "points" && element.kind != "bodies")) return {};
    const Place own = pair(found->find("at"));
    const Value* const name = found->find("body");
    if (!name || !name->isString()) return own;
    const Value* const body = find({"bodies", name->asString()});
    if (!body) return own;
    const Place centre = pair(body->find("at"));
    const double angle = number(body->find("angle"), 0), c = std::cos(angle), s = std::sin(angle);
    return Place{centre[0] + own[0] * c - own[1] * s, centre[1] + own[0] * s + own[1] * c};
}

std::vector<MechanismDrawing::Line> MechanismDrawing::points() const {
    std::vector<Line> all;
    for (const char* kind : {"points", "bodies"})
        if (const Value* const elements = elementsOf(kind))
            for (const auto& [name, value] : elements->asObject())
                if (const auto place = placeOf({kind, name})) all.push_back({{kind, name}, *place, *place});
    return all;
}

double MechanismDrawing::size() const {
    double size = 1;
    const std::vector<Line> all = points();
    for (const Line& a : all)
        for (const Line& b : all) size = std::max(size, distance(a.a, b.a));
    return size;
}

std::vector<MechanismDrawing::Line> MechanismDrawing::lines() const {
    std::vector<Line> all;
    const auto point = [&](const Value& element, const char* key) -> std::optional<Place> {
        const Value* const name = element.find(key);
        return name && name->isString() ? placeOf({"points", name->asString()}) : std::nullopt;
    };
    for (const cartesian::ElementKind& kind : cartesian::elementKinds()) {
        const Value* const elements = elementsOf(kind.key.c_str());
        if (!elements || kind.key == "points" || kind.key == "bodies") continue;
        for (const auto& [name, value] : elements->asObject()) {
            const Element element{kind.key, name};
            if (kind.key == "walls") {
                const Place normal = pair(value.find("normal")), through = pair(value.find("through"));
                const double length = std::hypot(normal[0], normal[1]), reach = 0.8 * size();
                if (!(length > 0)) continue;
                const Place along{-normal[1] / length * reach, normal[0] / length * reach};
                all.push_back({element,
                               {through[0] - along[0], through[1] - along[1]},
                               {through[0] + along[0], through[1] + along[1]}});
            } else if (kind.key == "sliders") {
                const Place direction = pair(value.find("direction"));
                const double length = std::hypot(direction[0], direction[1]), reach = 0.4 * size();
                const auto at = point(value, "point");
                if (!at || !(length > 0)) continue;
                const Place along{direction[0] / length * reach, direction[1] / length * reach};
                all.push_back({element,
                               {(*at)[0] - along[0], (*at)[1] - along[1]},
                               {(*at)[0] + along[0], (*at)[1] + along[1]}});
            } else if (kind.key == "motors") {
                const Value* const rod = value.find("rod");
                const Value* const body = value.find("body");
                std::optional<Place> axis, end;
                if (rod && rod->isString())
                    if (const Value* const turned = find({"rods", rod->asString()})) {
                        axis = point(*turned, "from");
                        end = point(*turned, "to");
                        const Value* const first = turned->find("from");
                        if (first && first->isString() && !isFixed(first->asString())) std::swap(axis, end);
                    }
                if (body && body->isString()) axis = end = placeOf({"bodies", body->asString()});
                if (axis && end) all.push_back({element, *axis, *end});
            } else if (const auto from = point(value, "from")) {
                all.push_back({element, *from, point(value, "to").value_or(*from)});
            }
        }
    }
    return all;
}

bool MechanismDrawing::isFixed(const std::string& point) const {
    const Value* const found = find({"points", point});
    const Value* const fixed = found ? found->find("fixed") : nullptr;
    return fixed && *fixed == Value(true);
}

std::optional<MechanismDrawing::Element> MechanismDrawing::pointAt(const Place& place, double reach) const {
    std::optional<Element> nearest;
    for (const Line& p : points()) {
        if (p.element.kind != "points" || distance(p.a, place) > reach) continue;
        reach = distance(p.a, place);
        nearest = p.element;
    }
    return nearest;
}

std::optional<MechanismDrawing::Element> MechanismDrawing::elementAt(const Place& place, double reach) const {
    if (auto point = pointAt(place, reach)) return point;
    std::optional<Element> nearest;
    double least = reach;
    const auto look = [&](const Line& line) {
        // A motor is seen around its axis.
        const double away = line.element.kind == "motors" ? std::abs(distance(place, line.a) - 0.07 * size())
                                                          : distanceToLine(place, line.a, line.b);
        if (away > least) return;
        least = away;
        nearest = line.element;
    };
    for (const Line& body : points())
        if (body.element.kind == "bodies") look(body);
    for (const Line& line : lines()) look(line);
    return nearest;
}

void MechanismDrawing::push(Value model) {
    if (model == this->model()) return;
    states_.resize(state_ + 1);
    states_.push_back(std::move(model));
    ++state_;
}

Value& MechanismDrawing::add(Value& model, const std::string& kind, const std::string& name, Value element) {
    Value* all = model.find(kind);
    if (!all || !all->isObject()) all = &model.set(kind, Value(Value::Object{}));
    return all->set(name, std::move(element));
}

std::string MechanismDrawing::freeName(const Value& model, const std::string& stem) const {
    const auto isTaken = [&](const std::string& name) {
        if (const Value* const parameters = model.find("parameters"); parameters && parameters->find(name))
            return true;
        return std::any_of(cartesian::elementKinds().begin(), cartesian::elementKinds().end(),
                           [&](const cartesian::ElementKind& kind) {
                               const Value* const all = model.find(kind.key);
                               return all && all->find(name);
                           });
    };
    if (stem.empty())
        for (char letter = 'A'; letter <= 'Z'; ++letter)
            if (!isTaken(std::string(1, letter))) return std::string(1, letter);
    for (int number = 1;; ++number)
        if (std::string name = (stem.empty() ? "P" : stem) + std::to_string(number); !isTaken(name))
            return name;
}

std::string MechanismDrawing::pointFor(Value& model, const Place& place, double reach) const {
    if (const auto there = MechanismDrawing(model).pointAt(place, reach)) return there->name;
    std::string name = freeName(model, "");
    add(model, "points", name, Value(Value::Object{{"mass", 1}, {"at", pairValue(place)}}));
    return name;
}

MechanismDrawing::Element MechanismDrawing::addPoint(const Place& place, bool isFixed) {
    Value model = this->model();
    const std::string name = freeName(model, "");
    add(model, "points", name,
        isFixed ? Value(Value::Object{{"at", pairValue(place)}, {"fixed", true}})
                : Value(Value::Object{{"mass", 1}, {"at", pairValue(place)}}));
    push(std::move(model));
    return {"points", name};
}

MechanismDrawing::Element MechanismDrawing::addLink(const std::string& kind, const Place& from,
                                                    const Place& to, double reach) {
    Value model = this->model();
    const std::string a = pointFor(model, from, reach), b = pointFor(model, to, reach);
    const std::string name = freeName(model, kind.substr(0, kind.size() - 1));
    Value link(Value::Object{{"from", a}, {"to", b}});
    if (kind == "springs") link.set("stiffness", 20);
    if (kind == "dampers") link.set("damping", 1);
    add(model, kind, name, std::move(link));
    push(std::move(model));
    return {kind, name};
}

MechanismDrawing::Element MechanismDrawing::addGroundDamper(const std::string& point) {
    Value model = this->model();
    const std::string name = freeName(model, "damper");
    add(model, "dampers", name, Value(Value::Object{{"from", point}, {"damping", 1}}));
    push(std::move(model));
    return {"dampers", name};
}

MechanismDrawing::Element MechanismDrawing::addBody(const Place& from, const Place& to, double reach) {
    Value model = this->model();
    const double length = distance(from, to);
    const std::string name = freeName(model, "body");
    Value body(Value::Object{{"mass", 1}, {"inertia", rounded(length * length / 12)}});
    body.set("at", pairValue({(from[0] + to[0]) / 2, (from[1] + to[1]) / 2}));
    body.set("angle", std::atan2(to[1] - from[1], to[0] - from[0]));
    const std::array<std::optional<Element>, 2> there{pointAt(from, reach), pointAt(to, reach)};
    add(model, "bodies", name, std::move(body));
    for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
        const std::string point = freeName(model, "");
        const double along = end == 0 ? -length / 2 : length / 2;
        add(model, "points", point, Value(Value::Object{{"body", name}, {"at", Value::Array{along, 0}}}));
        if (there[end])
            add(model, "pins", freeName(model, "pin"),
                Value(Value::Object{{"from", point}, {"to", there[end]->name}}));
    }
    push(std::move(model));
    return {"bodies", name};
}

std::optional<MechanismDrawing::Element> MechanismDrawing::addMotor(const Element& rodOrBody) {
    if (rodOrBody.kind != "rods" && rodOrBody.kind != "bodies") return {};
    Value model = this->model();
    const std::string name = freeName(model, "motor");
    add(model, "motors", name,
        Value(Value::Object{{rodOrBody.kind == "rods" ? "rod" : "body", rodOrBody.name}, {"torque", 10}}));
    push(std::move(model));
    return Element{"motors", name};
}

MechanismDrawing::Element MechanismDrawing::addWall(const Place& from, const Place& to) {
    Value model = this->model();
    const std::string name = freeName(model, "wall");
    const double length = distance(from, to);
    Place normal{(from[1] - to[1]) / length, (to[0] - from[0]) / length};
    int open = 0;
    for (const Line& p : points())
        if (!isFixed(p.element.name))
            open += normal[0] * (p.a[0] - from[0]) + normal[1] * (p.a[1] - from[1]) >= 0 ? 1 : -1;
    if (open < 0) normal = {-normal[0], -normal[1]};
    add(model, "walls", name,
        Value(Value::Object{{"through", pairValue({(from[0] + to[0]) / 2, (from[1] + to[1]) / 2})},
                            {"normal", pairValue(normal)},
                            {"restitution", 1}}));
    push(std::move(model));
    return {"walls", name};
}

MechanismDrawing::Element MechanismDrawing::addSlider(const std::string& point, const Place& towards) {
    Value model = this->model();
    const std::string name = freeName(model, "slider");
    const Place at = placeOf({"points", point}).value_or(Place{});
    add(model, "sliders", name,
        Value(Value::Object{{"point", point},
                            {"through", pairValue(at)},
                            {"direction", pairValue({towards[0] - at[0], towards[1] - at[1]})}}));
    push(std::move(model));
    return {"sliders", name};
}

void MechanismDrawing::toggleFixed(const std::string& point) {
    Value model = this->model();
    Value* const all = model.find("points");
    Value* const found = all ? all->find(point) : nullptr;
    if (!found || found->find("body")) return;
    const bool wasFixed = isFixed(point);
    for (const char* key : {"fixed", "mass", "velocity"}) eraseKey(*found, key);
    wasFixed ? found->set("mass", 1) : found->set("fixed", true);
    push(std::move(model));
}

void MechanismDrawing::move(const Element& element, const Place& to) {
    Value model = this->model();
    Value* const all = model.find(element.kind);
    Value* const found = all ? all->find(element.name) : nullptr;
    if (!found) return;
    Place own = to;
    if (const Value* const name = found->find("body"); name && name->isString()) {
        const Value* const body = find({"bodies", name->asString()});
        if (!body) return;
        const Place centre = pair(body->find("at"));
        const double angle = number(body->find("angle"), 0), c = std::cos(angle), s = std::sin(angle);
        own = {(to[0] - centre[0]) * c + (to[1] - centre[1]) * s,
               (to[1] - centre[1]) * c - (to[0] - centre[0]) * s};
    }
    found->set("at", pairValue(own));
    push(std::move(model));
}

void MechanismDrawing::remove(const Element& element) {
    Value model = this->model();
    std::vector<Element> gone{element};
    for (std::size_t k = 0; k < gone.size(); ++k)
        for (const cartesian::ElementKind& kind : cartesian::elementKinds()) {
            Value* const all = model.find(kind.key);
            if (!all || !all->isObject()) continue;
            for (auto& [name, value] : all->asObject()) {
                if (value.isObject() && hangsOn(value, gone[k])) gone.push_back({kind.key, name});
                Value* const stopped = value.find("points");
                if (gone[k].kind != "points" || !stopped || !stopped->isArray()) continue;
                std::erase(stopped->asArray(), Value(gone[k].name));
                if (stopped->asArray().empty()) gone.push_back({kind.key, name});
            }
        }
    for (const Element& each : gone) {
        Value* const all = model.find(each.kind);
        if (!all) continue;
        eraseKey(*all, each.name);
        if (all->asObject().empty()) eraseKey(model, each.kind);
    }
    push(std::move(model));
}

bool MechanismDrawing::rename(const Element& element, const std::string& name) {
    if (name == element.name) return true;
    Value model = this->model();
    if (!nameProblem(name).empty() || !find(element)) return false;
    for (const cartesian::ElementKind& kind : cartesian::elementKinds()) {
        Value* const all = model.find(kind.key);
        if (!all || !all->isObject()) continue;
        for (auto& [own, value] : all->asObject()) {
            if (own == name) return false;
            if (value.isObject())
                for (auto& [key, named] : value.asObject()) {
                    const bool isReference =
                        (element.kind == "points" && (key == "from" || key == "to" || key == "point")) ||
                        (element.kind == "rods" && key == "rod") ||
                        (element.kind == "bodies" && key == "body");
                    if (isReference && named == Value(element.name)) named = name;
                    if (element.kind == "points" && key == "points" && named.isArray())
                        std::replace(named.asArray().begin(), named.asArray().end(), Value(element.name),
                                     Value(name));
                }
            if (kind.key == element.kind && own == element.name) own = name;
        }
    }
    push(std::move(model));
    return true;
}

void MechanismDrawing::setKey(const Element& element, const std::string& key, const Value& value) {
    Value model = this->model();
    Value* const all = model.find(element.kind);
    Value* const found = all ? all->find(element.name) : nullptr;
    if (!found) return;
    if (value.isNull())
        eraseKey(*found, key);
    else
        found->set(key, value);
    push(std::move(model));
}

void MechanismDrawing::replace(const Value& model) { push(model); }

}  // namespace extremal
