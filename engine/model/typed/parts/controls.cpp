// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/controls.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "engine/core/algebra/interpolant.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::typed {
namespace {

/// A formula in t and parameters.
Expression formulaControl(const std::string& text, const Formula& formula, const std::string& pointer) {
    try {
        Formula own = formula;
        own.coordinates.clear();
        own.terms.clear();
        own.controls.clear();
        own.text = text;
        return resolve(own).expression;
    } catch (const ExpressionError& e) {
        throw invalidText(pointer, text, e, {}, "a control is a function of t and of parameters");
    }
}

/// Looks up t in a table.
Expression tableControl(const Value& control, const std::string& pointer) {
    const Value* const table = control.find("table");
    const Value* const interpolation = control.find("interpolation");
    for (const auto& [key, value] : control.asObject())
        if (key != "table" && key != "interpolation")
            throw InvalidScene(pointer + "/" + key, "unknown key \"" + key + "\"",
                               suggestName(key, {"table", "interpolation"}));
    const bool isCubic = interpolation && *interpolation == Value("cubic");
    if (interpolation && !isCubic && *interpolation != Value("linear"))
        throw InvalidScene(pointer + "/interpolation", "must be one of linear and cubic");
    if (!table || !table->isArray() || table->asArray().size() < 2)
        throw InvalidScene(pointer + "/table", "needs at least two rows [t, value]", "[[0, 1], [1, 0]]");
    std::vector<double> t, u;
    for (const Value& row : table->asArray()) {
        const std::string place = pointer + "/table/" + std::to_string(t.size());
        if (!row.isArray() || row.asArray().size() != 2 || !row.asArray()[0].isNumber() ||
            !row.asArray()[1].isNumber())
            throw InvalidScene(place, "must be a row of two numbers, [t, value]");
        t.push_back(row.asArray()[0].asNumber());
        u.push_back(row.asArray()[1].asNumber());
        if (!std::isfinite(t.back()) || !std::isfinite(u.back())) throw InvalidScene(place, "is not finite");
        if (t.size() > 1 && !(t.back() > t[t.size() - 2]))
            throw InvalidScene(place, "has a time that is not after the one before");
    }
    Expression made;
    made.text = "t";
    Expression::Node time, call;
    time.kind = Operator::name;
    time.name = "t";
    call.kind = Operator::call;
    const auto kind = isCubic ? Interpolant::Kind::cubic : Interpolant::Kind::linear;
    call.name = Interpolant::functionName(kind);
    call.left = 0;
    call.table = std::make_shared<const Interpolant>(kind, std::move(t), u);
    made.nodes = {time, call};
    return made;
}

}  // namespace

std::vector<std::pair<std::string, Expression>> controlsOf(const Settings& settings, const Formula& formula) {
    std::vector<std::pair<std::string, Expression>> all;
    const Value* const typed = settings.find("controls");
    if (!typed || typed->isNull()) return all;
    if (!typed->isObject())
        throw InvalidScene("/controls", "needs a name for each control", "{\"u\": \"sin(t)\"}");
    for (const auto& [name, control] : typed->asObject()) {
        const std::string pointer = "/controls/" + name;
        if (const std::string problem = nameProblem(name); !problem.empty())
            throw InvalidScene(pointer, "the name \"" + name + "\" " + problem);
        const auto isTaken = [&](const auto& names, auto nameOf) {
            return std::any_of(names.begin(), names.end(), [&](const auto& n) { return nameOf(n) == name; });
        };
        if (isTaken(formula.coordinates, [](const auto& n) { return n; }) ||
            isTaken(formula.parameters, [](const auto& n) { return n.first; }))
            throw InvalidScene(pointer, "the name \"" + name + "\" is that of a coordinate or parameter",
                               "every name has one meaning");
        if (control.isString())
            all.emplace_back(name, formulaControl(control.asString(), formula, pointer));
        else if (control.isObject())
            all.emplace_back(name, tableControl(control, pointer));
        else
            throw InvalidScene(pointer, "must be a formula in t, or a table",
                               R"({"table": [[0, 1], [1, 0]], "interpolation": "linear"})");
    }
    return all;
}

Expression withControls(Expression expression,
                        const std::vector<std::pair<std::string, Expression>>& controls) {
    if (controls.empty()) return expression;
    Expression made;
    made.text = std::move(expression.text);
    std::vector<int> place(expression.nodes.size());
    const auto moved = [](int of, const auto& to) { return of < 0 ? -1 : to(of); };
    for (std::size_t n = 0; n < expression.nodes.size(); ++n) {
        Expression::Node& node = expression.nodes[n];
        const auto control = node.kind == Operator::name
                                 ? std::find_if(controls.begin(), controls.end(),
                                                [&](const auto& c) { return c.first == node.name; })
                                 : controls.end();
        if (control == controls.end()) {
            const auto here = [&](int of) { return place[static_cast<std::size_t>(of)]; };
            node.left = moved(node.left, here);
            node.right = moved(node.right, here);
            node.third = moved(node.third, here);
            made.nodes.push_back(std::move(node));
        } else {
            const int first = static_cast<int>(made.nodes.size());
            const auto there = [first](int of) { return first + of; };
            for (Expression::Node each : control->second.nodes) {
                each.left = moved(each.left, there);
                each.right = moved(each.right, there);
                each.third = moved(each.third, there);
                each.position = node.position;
                made.nodes.push_back(std::move(each));
            }
        }
        place[n] = static_cast<int>(made.nodes.size()) - 1;
    }
    return made;
}

}  // namespace extremal::typed
