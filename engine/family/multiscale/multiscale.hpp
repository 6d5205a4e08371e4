// SPDX-License-Identifier: GPL-3.0-or-later
/// The oscillatory discretizations that have names, from the smallest space to the largest.
#pragma once

#include <vector>

#include "engine/family/scheme.hpp"

namespace extremal {

/// Slow coordinates of degree `slow`, those the system calls fast of degree `fast`, both with the same
/// harmonics; the frequency is the system's own, the rule automatic.
inline Discretization multiscalePair(int slow, int fast, const std::vector<int>& harmonics) {
    Value::Array degrees;
    for (const int m : harmonics) degrees.emplace_back(static_cast<double>(m));
    Value ofFast(Value::Object{{"degree", static_cast<double>(fast)}});
    Discretization discretization;
    discretization.space = {
        "oscillatory",
        {{"omega", "model"}, {"degree", static_cast<double>(slow)}, {"harmonics", degrees}, {"fast", ofFast}},
        {}};
    discretization.quadrature = {"auto", {}, {}};
    return discretization;
}

}  // namespace extremal
