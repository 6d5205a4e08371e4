// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/elements_reading.hpp"

#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::cartesian {

void checkPoint(const ElementReader& r, bool isOfBody, bool isFixed) {
    if (isOfBody && isFixed) r.error("fixed", "belongs to the body " + r.text("body"), "leave out one");
    if (isOfBody && r.has("mass"))
        r.error("mass", "the mass is that of the body " + r.text("body"), "leave it out");
    const bool isFree = !isOfBody && !isFixed;
    if (isFree && !r.has("mass"))
        r.error("mass", "is required: the point moves", "or \"fixed\": true, or the body that it belongs to");
    if (!isFree && r.has("velocity"))
        r.error("velocity", isFixed ? "the point is fixed" : "it follows from the body", "leave it out");
}

ElementsReading::ElementsReading(const Settings& settings, const std::vector<ElementKind>& kinds)
    : settings_(settings), kinds_(kinds) {
    std::map<std::string, std::string> taken;
    for (const auto& [name, value] : of("parameters")) {
        parameters_.emplace_back(name, value.asNumber());
        if (const std::string problem = nameProblem(name); !problem.empty())
            problems_.push_back({"/parameters/" + name, "the name \"" + name + "\" " + problem, {}});
    }
    for (const ElementKind& kind : kinds_) {
        const Value* const value = settings.find(kind.key);
        if (value && !value->isNull() && !value->isObject())
            problems_.push_back(
                {"/" + kind.key, "needs a name for each " + kind.title, "{\"" + kind.title + "1\": {..}}"});
        for (const auto& [name, given] : of(kind.key)) {
            const std::string pointer = "/" + kind.key + "/" + name;
            if (const std::string problem = nameProblem(name); !problem.empty())
                problems_.push_back({pointer, "the name \"" + name + "\" " + problem,
                                     "a letter, then letters, digits and _"});
            const auto [there, isNew] = taken.emplace(name, kind.title);
            if (!isNew)
                problems_.push_back({pointer,
                                     "the name \"" + name + "\" is that of a " + there->second + " as well",
                                     "every element has a name of its own"});
            names_[kind.key].push_back(name);
        }
    }
}

const Value::Object& ElementsReading::of(const std::string& key) const {
    static const Value::Object empty;
    const Value* const value = settings_.find(key);
    return value && value->isObject() ? value->asObject() : empty;
}

std::size_t ElementsReading::placeOf(const char* kind, const std::string& name, const std::string& pointer) {
    const std::vector<std::string>& names = names_[kind];
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) return i;
    std::string title;
    for (const ElementKind& each : kinds_)
        if (each.key == kind) title = each.title;
    if (!name.empty())
        problems_.push_back({pointer, "there is no " + title + " \"" + name + "\"",
                             names.empty() ? "add a " + title : suggestName(name, names)});
    return 0;
}

std::size_t ElementsReading::place(const char* kind, const ElementReader& r, const char* key) {
    return placeOf(kind, r.text(key), r.pointer(key));
}

std::optional<std::size_t> ElementsReading::placeIfGiven(const char* kind, const ElementReader& r,
                                                         const char* key) {
    if (!r.has(key)) return {};
    return place(kind, r, key);
}

Link ElementsReading::link(const ElementReader& r) {
    return {r.name(), place("points", r, "from"), place("points", r, "to")};
}

RodElement ElementsReading::rod(const ElementReader& r) { return {link(r), r.numberIfGiven("length")}; }

SpringElement ElementsReading::spring(const ElementReader& r) {
    return {link(r), r.number("stiffness"), r.number("damping"), r.numberIfGiven("length")};
}

DamperElement ElementsReading::damper(const ElementReader& r) {
    DamperElement made{r.name(), {}, {}, placeIfGiven("bodies", r, "body"), r.number("damping")};
    made.from = placeIfGiven("points", r, "from");
    made.to = placeIfGiven("points", r, "to");
    if (made.body.has_value() == made.from.has_value())
        r.error({}, "needs the point that it begins at, or a body", "\"from\": \"A\", or \"body\": \"B\"");
    if (made.to && !made.from) r.error("from", "is required: a damper has two ends", "or the body alone");
    return made;
}

}  // namespace extremal::cartesian
