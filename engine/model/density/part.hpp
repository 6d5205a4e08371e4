// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of a system that a typed Lagrangian density is (model/density/problem.hpp).
#pragma once

#include <memory>

#include "engine/model/parts.hpp"

namespace extremal {

struct DensityProblem;

/// What moves a field whose density is not of the usual kind.
struct DensityField {
    static constexpr PartInfo part{"density-field", "a field with a density of its own"};
    std::shared_ptr<const DensityProblem> problem;
};

/// Of a field whose density is of the usual kind, and which has the same nodes: the density as it was typed.
struct TypedDensity {
    static constexpr PartInfo part{"typed-density", "a density that is typed", false};
    std::shared_ptr<const DensityProblem> problem;
};

}  // namespace extremal
