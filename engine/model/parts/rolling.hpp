// SPDX-License-Identifier: GPL-3.0-or-later
/// Conditions on velocities, r(t, q, v) = a(t, q) v - b(t, q) = 0, as a part of a mechanical system: blades,
/// wheels, rolling without slipping.
///
/// With multipliers mu the motion is d/dt L_v = L_q + a^T mu, r = 0 (d'Alembert's principle): the conditions
/// restrict the virtual displacements, and are not put into the action. Index roles: condition k =
/// 0..count-1, coordinate i = 0..d-1; matrices row by row. Units are those of the user's formulas.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

struct Rolling {
    static constexpr PartInfo part{"rolling", "a rolling condition"};

    std::vector<std::string> names;     ///< "blade": one for each condition
    std::shared_ptr<const void> model;  ///< first argument of the calls
    bool isDriven = false;              ///< b is not 0: it does work

    int count() const { return static_cast<int>(names.size()); }

    /// r (count), its derivatives by q and v (count x 2d), of which those by v are a, and r_t (count).
    void (*first)(const void*, double t, const double* q, const double* v, double* r, double* byState,
                  double* byTime) = nullptr;
    /// Adds sum_k mu_k d a_ki / d q_j to a d x d matrix, row i, column j: not symmetric.
    void (*addCurvature)(const void*, double t, const double* q, const double* mu, double* matrix) = nullptr;
};

}  // namespace extremal
