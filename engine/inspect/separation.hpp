// SPDX-License-Identifier: GPL-3.0-or-later
/// Two copies of a motion that start a little apart, by the same scheme, and how their distance grows: evenly
/// on regular motions, exponentially on chaotic ones.
#pragma once

#include <stop_token>

#include "engine/figure/figure.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

struct Separation {
    Comparison pair;  ///< the motion, and the one that was moved, as two schemes
    Figure distance;  ///< max |x - x'| against time, logarithmic
    double rate = 0;  ///< of its growth, by a line through its logarithm until it is as large as the motion
};

/// Of a scheme of the scene with a fixed step; the copy starts with its first coordinate moved by `shift`.
/// Throws InvalidScene where the model has no coordinates, or steps are not the same for both.
Separation separationOf(const Scene& scene, std::size_t scheme, double shift);

}  // namespace extremal
