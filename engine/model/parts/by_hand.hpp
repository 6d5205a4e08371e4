// SPDX-License-Identifier: GPL-3.0-or-later
/// How a state that is more than coordinates is moved by hand, on the stage: attitudes, elements of groups,
/// points on spheres. A part that does not bind the motion.
///
/// The state is displaced by a few numbers, none of which is large: rotation vectors, coordinates in an
/// algebra, ways. What makes them so that a body follows the pointer is the stage's.
#pragma once

#include <cmath>
#include <functional>

#include "engine/core/value.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct ByHand {
    static constexpr PartInfo part{"by-hand", "a way to be moved by hand", false};

    int freedoms = 0;  ///< numbers of a displacement
    /// Displaces the state x, with the momentum that it has as seen from what is moved.
    std::function<void(double* x, const double* by)> move;
    /// The velocities of x, as displacements per unit of time; false where it has none.
    std::function<bool(const double* x, double* by)> velocity;
    /// Changes them.
    std::function<void(double* x, const double* by)> push;
    /// The keys of /initial with the state x. `keepsMotion`: momenta and velocities stay as they are written,
    /// where x has them still.
    std::function<Value(Value initial, const double* x, bool keepsMotion)> written;
};

/// A number that is set by hand, to a digit of which there are `perUnit` in 1.
inline double handNumber(double value, double perUnit = 1e8) {
    const double rounded = std::round(value * perUnit) / perUnit;
    return std::isfinite(rounded) ? rounded + 0.0 : value;  // no -0
}

}  // namespace extremal
