// SPDX-License-Identifier: GPL-3.0-or-later
/// A number that has a name, for files and plots.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace extremal {

struct Quantity {
    std::string name;    ///< in files: "attitude.w"
    std::string title;   ///< "attitude w"; may be empty
    std::string symbol;  ///< in plots
    std::string unit;    ///< empty if dimensionless
};

/// Where the quantity of a name is among others.
inline std::optional<std::size_t> indexOf(std::span<const Quantity> quantities, std::string_view name) {
    for (std::size_t i = 0; i < quantities.size(); ++i)
        if (quantities[i].name == name) return i;
    return std::nullopt;
}

}  // namespace extremal
