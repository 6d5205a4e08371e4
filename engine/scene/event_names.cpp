#include "engine/scene/event_names.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

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
    for (const auto& [name, value] : event.values) names_.push_back({name, -2, value});
    std::vector<std::string> parameters;
    for (const auto& each : names_) parameters.push_back(each.name);
    for (const StateName& each : stateNames(system, parameters))
        names_.push_back({each.name, each.column, 0});
    const std::vector<std::string> used = expression_.names();
    std::erase_if(names_,
                  [&](const Name& n) { return std::find(used.begin(), used.end(), n.name) == used.end(); });
}

double EventFunction::operator()(double t, const double* x) const {
    return evaluate(expression_, [&](std::string_view name) -> std::optional<double> {
        for (const Name& each : names_)
            if (each.name == name)
                return each.column == -2 ? each.value : each.column == -1 ? t : x[each.column];
        return {};
    });
}

}  // namespace extremal
