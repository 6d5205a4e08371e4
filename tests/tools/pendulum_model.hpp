// SPDX-License-Identifier: GPL-3.0-or-later
/// The mathematical pendulum in units of its length and mass, for steps in any scalar.
#pragma once

#include <array>

#include "engine/core/algebra/jet.hpp"

namespace extremal {

struct PendulumModel {
    static constexpr int dimension = 1;
    template <class T>
    std::array<T, 1> masses() const {
        return {T(1)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 1>& q) const {
        return -cos(q[0]);
    }
};

}  // namespace extremal
