// SPDX-License-Identifier: GPL-3.0-or-later
/// Kepler's problem in quadruple precision, with its solution from Kepler's equation.
#pragma once

#include <boost/multiprecision/float128.hpp>

#include <array>
#include <vector>

#include "engine/core/algebra/jet.hpp"

namespace extremal {

using Quad = boost::multiprecision::float128;

struct KeplerModel {
    static constexpr int dimension = 2;
    template <class T>
    std::array<T, 2> masses() const {
        return {T(1), T(1)};
    }
    template <class T, class S>
    S potential(const T&, const std::array<S, 2>& q) const {
        return T(-1) / sqrt(square(q[0]) + square(q[1]));
    }
};

/// Orbit with a = 1, e = 3/5 from its perihelion (2/5, 0) with speed 2.
inline std::vector<Quad> exactKepler(const Quad& t) {
    const Quad e = Quad(3) / 5, b = Quad(4) / 5;
    Quad E = static_cast<Quad>(static_cast<double>(t)), last = 1;
    for (int i = 0; i < 60 && last != 0; ++i) {
        const Quad step = (E - e * sin(E) - t) / (1 - e * cos(E));
        E -= step;
        if (abs(step) < Quad(1e-33) || (i > 20 && abs(step) >= abs(last))) break;
        last = step;
    }
    const Quad rate = 1 / (1 - e * cos(E));
    return {cos(E) - e, b * sin(E), -sin(E) * rate, b * cos(E) * rate};
}

}  // namespace extremal
