// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/plane_field/settings.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/plane_field/joint_potential.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostComponents = JointPotential::mostComponents;

/// What is wrong with a name; empty: nothing.
std::string faultOf(const std::string& name) {
    const auto isPart = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    if (name.empty() || !std::isalpha(static_cast<unsigned char>(name.front())) ||
        !std::all_of(name.begin(), name.end(), isPart))
        return "must be a name of letters, digits and _, got \"" + name + "\"";
    for (const char* taken : {"x", "y", "t", "r", "phi", "pi", "e", "mass", "profile", "exact", "values"})
        if (name == taken) return "cannot be " + name + ", which is taken";
    if (name.ends_with("_t")) return "cannot end in _t, which are the velocities";
    return {};
}

}  // namespace

FieldInfo componentNamesField() {
    FieldInfo names =
        namesField("components", {"u"}, "Names of the components, which meet in the potential.");
    names.fallback = Value::Array{"u"};
    names.example = nullptr;  // a new scene has one
    return names;
}

FieldInfo waveSpeedsField() {
    return optionalJsonField("wave_speeds", "wave speeds",
                             "One number for each component, in place of wave_speed.");
}

std::vector<std::string> componentNames(const Settings& settings) {
    std::vector<std::string> names;
    const Value* const given = settings.find("components");
    if (!given || !given->isArray() || given->asArray().empty()) return {"u"};
    if (given->asArray().size() > mostComponents)
        throw InvalidScene("/components", "must be at most " + std::to_string(mostComponents) +
                                              " names, got " + std::to_string(given->asArray().size()));
    for (const Value& each : given->asArray()) {
        const std::string place = "/components/" + std::to_string(names.size()), &name = each.asString();
        if (const std::string fault = faultOf(name); !fault.empty())
            throw InvalidScene(place, fault, "u, v or w");
        if (std::find(names.begin(), names.end(), name) != names.end())
            throw InvalidScene(place, "has the name " + name + " once more", "another name");
        names.push_back(name);
    }
    return names;
}

PlaneFieldProblem planeFieldOf(const Settings& settings, const wave::Grid& grid) {
    const std::vector<std::string> names = componentNames(settings);
    std::vector<double> speeds(names.size(), settings.number("wave_speed"));
    if (const Value* const given = settings.find("wave_speeds"); given && !given->isNull()) {
        speeds = numbersIn(*given, "/wave_speeds", static_cast<int>(names.size()), {},
                           "one number for each component, " + joinNames(names));
        for (std::size_t c = 0; c < speeds.size(); ++c)
            if (!(speeds[c] > 0))
                throw InvalidScene("/wave_speeds/" + std::to_string(c),
                                   "must be positive, got " + formatNumber(speeds[c]), "1");
    }
    std::vector<FieldComponent> components;
    for (std::size_t c = 0; c < names.size(); ++c) components.push_back({names[c], speeds[c]});
    return {grid, std::move(components),
            JointPotential(*settings.find("potential"), settings.number("mass"), names, "/potential")};
}

}  // namespace extremal
