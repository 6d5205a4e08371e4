// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/knobs.hpp"

#include <algorithm>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/smaller_spaces.hpp"
#include "engine/family/parts/steps.hpp"

namespace extremal {
namespace {

/// Keys of spaces that steps are proportional to, each once.
std::vector<std::string> factorKeys() {
    std::vector<std::string> keys;
    for (const Family& family : families())
        if (const auto* const own = family.parts.find<StepOfSpace>(); own && own->factor)
            if (std::find(keys.begin(), keys.end(), own->factor) == keys.end())
                keys.emplace_back(own->factor);
    return keys;
}

/// What spaces may leave out besides, each once.
std::vector<std::string> smallerNames() {
    std::vector<std::string> names;
    for (const Family& family : families())
        if (const auto* const smaller = family.parts.find<SmallerSpaces>())
            if (std::find(names.begin(), names.end(), smaller->knob) == names.end())
                names.emplace_back(smaller->knob);
    return names;
}

}  // namespace

SearchKnobs parseKnobs(const std::string& text) {
    if (text.empty()) return {};
    SearchKnobs knobs{false, false, false, false, false};
    const std::vector<std::string> factors = factorKeys(), smaller = smallerNames();
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const std::string name = text.substr(from, comma - from);
        if (name == "degree")
            knobs.isDegree = true;
        else if (name == "cells")
            knobs.isCells = true;
        else if (std::find(factors.begin(), factors.end(), name) != factors.end())
            knobs.isStepFactor = true;
        else if (std::find(smaller.begin(), smaller.end(), name) != smaller.end())
            knobs.isSmaller = true;
        else if (name == "tolerance")
            knobs.isTolerance = true;
        else if (name != "step")
            throw InvalidScene(
                "--knobs", "there is no knob \"" + name + "\"",
                "step, degree, cells, " + joinNames(smaller) + ", " + joinNames(factors) + ", tolerance");
        from = comma + 1;
    }
    return knobs;
}

std::string textOf(const SearchKnobs& knobs) {
    std::string factors, smaller;
    for (const std::string& key : factorKeys()) factors += "," + key;
    for (const std::string& name : smallerNames()) smaller += "," + name;
    return std::string("step") + (knobs.isDegree ? ",degree" : "") + (knobs.isCells ? ",cells" : "") +
           (knobs.isSmaller ? smaller : "") + (knobs.isStepFactor ? factors : "") +
           (knobs.isTolerance ? ",tolerance" : "");
}

}  // namespace extremal
