// SPDX-License-Identifier: GPL-3.0-or-later
/// Derivatives by the entries that are not always 0, of systems with many coordinates of which few are
/// coupled: then the work of a step need not grow with their square.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

/// An entry of a matrix.
struct MatrixEntry {
    int row, column;
};

/// Of a Lagrangian, beside its Mechanics. The Hessian in (q, v) by its lower triangle, row >= column.
struct LagrangianEntries {
    static constexpr PartInfo part{"lagrangian-entries", "derivatives by entries", false};

    std::vector<MatrixEntry> hessian;
    std::shared_ptr<const void> model;  ///< first argument of the call
    /// The gradient (2d) and the entries of the Hessian.
    void (*jet)(const void*, double t, const double* q, const double* v, double* gradient,
                double* hessian) = nullptr;
};

}  // namespace extremal
