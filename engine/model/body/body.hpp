// SPDX-License-Identifier: GPL-3.0-or-later
/// A rigid body as the group integrators see it: a Lagrangian on TG, left trivialised,
///     L(g, eta) = 1/2 eta . M eta - U(g),   eta = g^{-1} g' in the body,   M diagonal.
///
/// G is SO(3) (dimension 3: g = R, eta the body's angular velocity) or SE(3) (dimension 6: g = (R, x), eta
/// the angular velocity and then the velocity of the centre of mass, both in body axes). R takes body vectors
/// to space; R + 3 j is body axis j in space. Without a potential L is invariant: nothing needs g at all. The
/// state of a run is (w, x, y, z), the attitude as a quaternion; the angular momentum in body axes; the
/// angular momentum in space axes, both about the centre of mass; for SE(3) then position and linear momentum
/// in space axes. The space momentum is the one that integrators carry on; the body's is it, turned.
#pragma once

#include <array>
#include <memory>

#include "engine/model/parts.hpp"

namespace extremal {

template <class T>
struct BodyMechanics {
    static constexpr PartInfo part{"body", "a rigid body"};

    int dimension = 0;                  ///< of the group; 0: there is no body
    std::array<T, 6> inertia{};         ///< diagonal of M: moments of inertia, then three times the mass
    std::shared_ptr<const void> model;  ///< first argument of the call below

    /// Unless null: U at (R, x) (x: null on SO(3)); the force f, with dU(g zeta) = -f . zeta for every twist
    /// zeta; its slope along g exp(eps zeta), f + eps slope zeta, column after column. Empty: no potential.
    void (*potential)(const void*, const T* R, const T* x, T* value, T* force, T* slope) = nullptr;

    bool isFree() const { return potential == nullptr; }
    int stateSize() const { return dimension == 3 ? 10 : 16; }
};

}  // namespace extremal
