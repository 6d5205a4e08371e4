// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/typed_parts.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/parts/part_formulas.hpp"

namespace extremal::typed {
namespace {

/// Whether a coordinate or its velocity occurs in a formula.
bool moves(const Formula& own, int coordinate) {
    const ResolvedFormula resolved = resolve(own);
    return std::any_of(resolved.symbol.begin(), resolved.symbol.end(), [&](int symbol) {
        return symbol == coordinate || symbol == own.dimension() + coordinate;
    });
}

}  // namespace

bool isUntouched(const Settings& settings, const Formula& formula, int coordinate) {
    const std::string& name = formula.coordinates[placeOf(coordinate)];
    const Value* const dissipation = settings.find("dissipation");
    std::vector<std::pair<std::string, bool>> texts;  // and whether a place in it is all that matters
    for (const auto& [key, text] : formulasUnder(settings, "constraints"))
        texts.push_back({text.asString(), true});
    for (const auto& [key, text] : formulasUnder(settings, "rolling")) {
        const Formula own = withTime(formula, text.asString());
        if (moves(own, coordinate)) return false;
    }
    if (const Value* const walls = settings.find("walls"); walls && walls->isObject())
        for (const auto& [key, wall] : walls->asObject())
            if (const Value* const gap = gapOf(wall)) texts.push_back({gap->asString(), true});
    if (dissipation && dissipation->isString()) texts.push_back({dissipation->asString(), false});
    for (const auto& [key, text] : formulasUnder(settings, "forces"))
        if (key == name) return false;
    for (const auto& [text, isOfPlaces] : texts) {
        if (text.empty()) continue;
        // Short texts in many names: nothing to resolve where it does not occur.
        if (isOfPlaces && occurs(name, text)) return false;
        if (!occurs(name, text) && !occurs(name + "_t", text)) continue;
        const Formula own = withTime(formula, text);
        const ResolvedFormula resolved = resolve(own);
        const int symbol = isOfPlaces ? coordinate : own.dimension() + coordinate;
        if (std::find(resolved.symbol.begin(), resolved.symbol.end(), symbol) != resolved.symbol.end())
            return false;
    }
    return true;
}

}  // namespace extremal::typed
