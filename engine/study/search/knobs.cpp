// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/knobs.hpp"

#include <algorithm>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {

SearchKnobs parseKnobs(const std::string& text) {
    if (text.empty()) return {};
    SearchKnobs knobs{false, false, false, false};
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        const std::string name = text.substr(from, comma - from);
        if (name == "degree")
            knobs.isDegree = true;
        else if (name == "cells")
            knobs.isCells = true;
        else if (name == "courant")
            knobs.isCourant = true;
        else if (name == "tolerance")
            knobs.isTolerance = true;
        else if (name != "step")
            throw InvalidScene("--knobs", "there is no knob \"" + name + "\"",
                               "step, degree, cells, courant, tolerance");
        from = comma + 1;
    }
    return knobs;
}

std::string textOf(const SearchKnobs& knobs) {
    return std::string("step") + (knobs.isDegree ? ",degree" : "") + (knobs.isCells ? ",cells" : "") +
           (knobs.isCourant ? ",courant" : "") + (knobs.isTolerance ? ",tolerance" : "");
}

}  // namespace extremal
