// SPDX-License-Identifier: GPL-3.0-or-later
/// Dual<T, 1> as a scalar of Eigen's matrices: a + e b with e^2 = 0.
///
/// Rigid motions are rotations over these numbers (the principle of transference): what so3.hpp computes for
/// xi + e rho holds for the screw (xi, rho) of SE(3). See se3.hpp.
#pragma once

#include <Eigen/Core>

#include "engine/core/algebra/jet.hpp"

template <class T>
struct Eigen::NumTraits<extremal::Dual<T, 1>> : Eigen::GenericNumTraits<extremal::Dual<T, 1>> {
    using Real = extremal::Dual<T, 1>;
    using NonInteger = extremal::Dual<T, 1>;
    using Nested = extremal::Dual<T, 1>;
    using Literal = T;
    static constexpr int IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1;
    static constexpr int ReadCost = 2, AddCost = 2, MulCost = 5;
};
