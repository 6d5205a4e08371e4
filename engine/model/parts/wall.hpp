// SPDX-License-Identifier: GPL-3.0-or-later
/// Walls: gap(t, q) >= 0 at all times, as a part of a mechanical system (x = (q, p)).
///
/// Where a gap closes with the speed r = gap_q v + gap_t < 0, an impulse along gap_q changes it to -e r, e
/// the restitution: 1 for an elastic wall, 0 for one that a body does not leave. Index roles: wall k =
/// 0..count-1, coordinate i = 0..d-1; matrices row by row. Units are those of the user's formulas.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

struct Wall {
    static constexpr PartInfo part{"wall", "a wall"};

    std::vector<std::string> names;     ///< "floor": one for each wall
    std::vector<double> restitution;    ///< of each, within [0, 1]
    std::shared_ptr<const void> model;  ///< first argument of the call
    bool isTimeDependent = false;

    int count() const { return static_cast<int>(names.size()); }
    bool isElastic() const {
        return std::all_of(restitution.begin(), restitution.end(), [](double e) { return e == 1; });
    }

    /// A gap above -rounding * terms() is one of a body that touches the wall.
    static constexpr double rounding = 1e-12;
    /// sum_i |gap_qi q_i|: the size of the numbers that a gap is the sum of.
    static double terms(const double* normal, const double* q, int dimension) {
        double sum = 0;
        for (int i = 0; i < dimension; ++i) sum += std::abs(normal[i] * q[i]);
        return sum;
    }

    /// gap (count), gap_q (count x d) and gap_t (count).
    void (*first)(const void*, double t, const double* q, double* gap, double* byPlace,
                  double* byTime) = nullptr;
};

}  // namespace extremal
