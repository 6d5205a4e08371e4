// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose schemes measure something of themselves that rows do not hold.
#pragma once

#include <optional>
#include <string_view>

#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// What schemes measure of themselves at nodes, for the observable of that id; nothing where they do not know
/// it. Without it such an observable stays unknown.
struct OwnMeasures {
    static constexpr PartInfo part{"own-measures", "measures of its schemes", false};
    std::optional<Measure> (*of)(std::string_view observable, const System&, const Discretization&,
                                 double step) = nullptr;
};

}  // namespace extremal
