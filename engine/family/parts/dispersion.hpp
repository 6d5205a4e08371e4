// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families with waves on a mesh.
#pragma once

#include <vector>

#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Frequencies of plane waves on the mesh of a scheme, and of the field equation; NaN where they grow.
struct DispersionCurve {
    std::vector<double> waveNumber, frequency, exact;
};

/// How fast waves run in a scheme. Without it a scheme is left out of the view of that.
struct Dispersion {
    static constexpr PartInfo part{"dispersion", "the frequencies of waves", false};
    DispersionCurve (*of)(const System&, const Discretization&, double step) = nullptr;
};

}  // namespace extremal
