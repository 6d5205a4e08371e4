// SPDX-License-Identifier: GPL-3.0-or-later
/// How a state that is more than coordinates is moved by hand, on the stage: attitudes, elements of groups,
/// points on spheres. A part that does not bind the motion.
///
/// The state is displaced by a few numbers, none of which is large: rotation vectors, coordinates in an
/// algebra, ways. What makes them so that a body follows the pointer is the stage's.
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <string_view>

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

/// Numbers that are set by hand, of which so many digits of the largest are kept.
Value handNumbers(const double* x, std::size_t count, int digits = 9);
/// One of them, where the largest is that.
double handNumber(double value, double largest, int digits);

/// Takes keys away from an object.
void dropKeys(Value& object, std::initializer_list<std::string_view> keys);

}  // namespace extremal
