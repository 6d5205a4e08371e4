// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of fields as they stand in scenes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

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

}  // namespace extremal
