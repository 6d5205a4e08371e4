// SPDX-License-Identifier: GPL-3.0-or-later
/// An observer of a march, with where its values go in the table of rows and in the summary.
#pragma once

#include <cmath>
#include <cstddef>

#include "engine/observe/catalog.hpp"
#include "engine/run/comparison.hpp"
#include "engine/run/march/state_values.hpp"

namespace extremal {

/// A running extreme: the largest absolute value so far of those that are finite.
inline void growTo(double& extreme, double value) {
    if (!(std::abs(value) <= extreme) && std::isfinite(value)) extreme = std::abs(value);
}

struct BoundObserver {
    static constexpr auto none = static_cast<std::size_t>(-1);

    Observer observer;
    std::size_t firstColumn;
    std::size_t extreme;   ///< index in Summary::extremes; none if the observable declares none
    double Summary::*own;  ///< the same number under a name of its own; or null
    StateValues state;     ///< which of its values must be numbers
    /// Nodes at which its extreme is not a number, and the time of the first of them.
    long long unknownNodes = 0;
    double unknownFrom = 0;
    std::string id = {};  ///< of the observable
};

}  // namespace extremal
