// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of fields as they stand in scenes.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/value.hpp"

namespace extremal {

/// {"u": [..], "u_t": [..]}: component after component, each at so many places.
inline Value componentValues(const std::vector<std::string>& names, std::span<const double> values,
                             std::size_t places) {
    Value all{Value::Object{}};
    for (std::size_t c = 0; c < names.size(); ++c) {
        const auto own = values.subspan(c * places, places);
        all.set(names[c], Value::Array(own.begin(), own.end()));
    }
    return all;
}

/// The other way: one of these lists, at so many places. Throws InvalidScene at `pointer`.
inline std::vector<double> valuesAtNodes(const Value& list, const std::string& pointer, std::size_t places,
                                         const std::string& hint = {}) {
    const Value::Array& all = list.asArray();
    if (all.size() != places)
        throw InvalidScene(pointer,
                           "must have " + std::to_string(places) + " numbers, one per node, got " +
                               std::to_string(all.size()),
                           hint);
    std::vector<double> values;
    values.reserve(places);
    for (const Value& number : all) {
        if (!number.isNumber() || !std::isfinite(number.asNumber()))
            throw InvalidScene(pointer + "/" + std::to_string(values.size()), "must be a finite number", "0");
        values.push_back(number.asNumber());
    }
    return values;
}

}  // namespace extremal
