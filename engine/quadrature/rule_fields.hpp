// SPDX-License-Identifier: GPL-3.0-or-later
/// Keys that several rules have. Internal to engine/quadrature.
#pragma once

#include "engine/core/field.hpp"

namespace extremal::ruleFields {

inline FieldInfo count(std::string key, double min, std::string description) {
    return integerField(key, key, min, 1000, nullptr, std::move(description));
}

/// "the degree of the space", "... plus one": where the key is left out.
inline FieldInfo nodes(double min, const std::string& fallback) {
    return count("nodes", min, "Number of nodes; default: " + fallback + ".");
}
inline FieldInfo panels() {
    return count("panels", 1, "The rule is repeated in equal panels; default: the cells of the space.");
}
inline FieldInfo filonNodes(double min) {
    return count("nodes", min, "Number of slow nodes; default: the highest degree in the space plus two.");
}
inline FieldInfo phases() {
    return count("phases", 1,
                 "Number of phases at each node; default: 4 H + 4, H the highest harmonic in the space.");
}

}  // namespace extremal::ruleFields
