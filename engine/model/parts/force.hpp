// SPDX-License-Identifier: GPL-3.0-or-later
/// A force F(t, q, v) on the coordinates that no Lagrangian has, as a part of a mechanical system.
///
/// It acts in the variation and not in the action (d'Alembert's principle):
///     delta int L dt + int F . delta q dt = 0.
/// Dissipation by Rayleigh's function D(t, q, v) is the force -dD/dv. Index roles: coordinate i = 0..d-1.
#pragma once

#include <memory>

#include "engine/model/parts.hpp"

namespace extremal {

struct Force {
    static constexpr PartInfo part{"force", "a force"};

    std::shared_ptr<const void> model;  ///< first argument of the calls
    bool isTimeDependent = false;

    /// F (d).
    void (*value)(const void*, double t, const double* q, const double* v, double* force) = nullptr;
    /// F, and its derivatives by q and v: d x 2d, row by row.
    void (*first)(const void*, double t, const double* q, const double* v, double* force,
                  double* derivatives) = nullptr;
};

}  // namespace extremal
