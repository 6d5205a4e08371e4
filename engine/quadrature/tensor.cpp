// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/quadrature/tensor.hpp"

namespace extremal {

bool isTensorRule(const Settings& quadrature) { return quadrature.type == "product"; }

namespace {

Settings partOf(const Settings& quadrature, std::string_view name) {
    const Value* const part = quadrature.find(name);
    return part && part->isObject() ? settingsOf(*part) : Settings{};
}

}  // namespace

bool isTermRule(const Settings& quadrature) { return quadrature.type == "terms"; }

Settings termPart(const Settings& quadrature, std::string_view term) {
    return isTermRule(quadrature) ? partOf(quadrature, term) : Settings{};
}

std::vector<const char*> tensorPartsOf(const Settings& quadrature) {
    std::vector<const char*> parts;
    for (const char* direction : {tensorParts[0], acrossPart, tensorParts[1]})
        if (isTensorRule(quadrature) && quadrature.find(direction)) parts.push_back(direction);
    return parts;
}

Settings tensorPart(const Settings& quadrature, std::string_view direction) {
    return isTensorRule(quadrature) ? partOf(quadrature, direction) : Settings{};
}

}  // namespace extremal
