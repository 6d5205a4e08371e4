// SPDX-License-Identifier: GPL-3.0-or-later
/// A potential over an interval and the energies of the stationary states in it.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

struct PotentialLevels {
    static constexpr PartInfo part{"potential-levels", "a potential with levels", false};
    std::shared_ptr<const std::vector<double>> x, V;  ///< at the nodes; at t = 0 where it depends on time
    double end = 0;                                   ///< of the interval, behind the last node
    bool isPeriodic = false;                          ///< V there is that of the first node
    std::string problem;                              ///< why there are no levels to show; empty: there are
    /// The lowest energies in ascending order, where there is no problem.
    std::function<std::vector<double>()> lowest;
};

}  // namespace extremal
