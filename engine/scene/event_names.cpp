// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/event_names.hpp"

#include <algorithm>
#include <utility>

namespace extremal {

std::vector<StateName> stateNames(const System& system, const std::vector<std::string>& parameters) {
    std::vector<StateName> names{{"t", -1}};
    const std::vector<Quantity> columns = stateColumns(system);
    const auto isFree = [&](const std::string& name) {
        return std::none_of(names.begin(), names.end(), [&](const StateName& n) { return n.name == name; });
    };
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::string name = columns[i].name;
        std::replace(name.begin(), name.end(), '.', '_');
        names.push_back({name, static_cast<int>(i)});
    }
    for (std::size_t i = 0; i < system.coordinates.size(); ++i) {
        std::string name = system.coordinates[i].name;
        std::replace(name.begin(), name.end(), '.', '_');
        const bool isParameter = std::find(parameters.begin(), parameters.end(), name) != parameters.end();
        if (nameProblem(name).empty() && !isParameter && isFree(name))
            names.push_back({name, static_cast<int>(i)});
    }
    return names;
}

EventFunction::EventFunction(const EventSpec& event, const System& system)
    : expression_(parseExpression(event.expression)) {
    std::vector<std::string> parameters;
    for (const auto& each : event.values) parameters.push_back(each.first);
    const std::vector<StateName> known = stateNames(system, parameters);
    for (const Expression::Node& node : expression_.nodes) {
        Place place;
        const auto same = [&](const auto& each) { return each.name == node.name; };
        const auto parameter = std::find_if(event.values.begin(), event.values.end(),
                                            [&](const auto& each) { return each.first == node.name; });
        if (node.kind == Operator::number) {
            place = {number, node.number};
        } else if (node.kind == Operator::name && parameter != event.values.end()) {
            place = {number, parameter->second};
        } else if (node.kind == Operator::name) {
            const auto found = std::find_if(known.begin(), known.end(), same);
            if (found == known.end())
                throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position);
            place.column = found->column < 0 ? time : found->column;
        }
        places_.push_back(place);
    }
    values_.resize(places_.size());
    measureTruth(static_cast<int>(places_.size()) - 1);
}

void EventFunction::measureTruth(int node) {
    Expression::Node& here = expression_.nodes[static_cast<std::size_t>(node)];
    if (here.kind != Operator::call) return;
    if (here.name == "<" || here.name == "<=" || here.name == "==" || here.name == "!=") {
        here.kind = Operator::subtract;
        if (here.name.front() == '<') std::swap(here.left, here.right);
    } else if (here.name == "and" || here.name == "or") {
        here.function = findFunction(here.name == "and" ? "min" : "max");
        measureTruth(here.left);
        measureTruth(here.right);
    }
}

double EventFunction::operator()(double t, const double* x) const {
    const auto operand = [&](int n) { return n < 0 ? 0.0 : values_[static_cast<std::size_t>(n)]; };
    for (std::size_t n = 0; n < places_.size(); ++n) {
        const Place& place = places_[n];
        const Expression::Node& node = expression_.nodes[n];
        values_[n] = place.column >= 0      ? x[place.column]
                     : place.column == time ? t
                     : place.column == number
                         ? place.value
                         : applyNode(node, operand(node.left), operand(node.right), operand(node.third));
    }
    return values_.back();
}

}  // namespace extremal
