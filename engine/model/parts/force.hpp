// SPDX-License-Identifier: GPL-3.0-or-later
/// A force F(t, q, v) on the coordinates that no Lagrangian has, as a part of a mechanical system.
///
/// It acts in the variation and not in the action (d'Alembert's principle):
///     delta int L dt + int F . delta q dt = 0.
/// Dissipation by Rayleigh's function D(t, q, v) is the force -dD/dv. Index roles: coordinate i = 0..d-1.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/parts.hpp"
#include "engine/model/parts/entries.hpp"

namespace extremal {

struct Force {
    static constexpr PartInfo part{"force", "a force"};

    std::shared_ptr<const void> model;  ///< first argument of the calls
    bool isTimeDependent = false;
    /// Times at which it bends, ascending: those of linear tables in it.
    std::vector<double> kinks = {};

    /// F (d).
    void (*value)(const void*, double t, const double* q, const double* v, double* force) = nullptr;
    /// F, and its derivatives by q and v: d x 2d, row by row.
    void (*first)(const void*, double t, const double* q, const double* v, double* force,
                  double* derivatives) = nullptr;
    /// Where the system offers it (null else): F, or its derivatives alone, at many nodes together, entry k
    /// of node i at k * nodes + i, likewise q and v; `nodes` is a multiple of 8.
    void (*values)(const void*, const double* t, int nodes, const double* q, const double* v,
                   double* forces) = nullptr;
    void (*derivatives)(const void*, const double* t, int nodes, const double* q, const double* v,
                        double* derivatives) = nullptr;

    /// L' and L'' as in model/mechanics.hpp at many nodes, with F added to L_q and its derivatives to those
    /// of L_q, where the system offers it; null else. In a step they are one term, and formulas of both have
    /// much in common.
    struct WithLagrangian {
        const void* lagrangian;  ///< Mechanics::model of this L, which no other has
        void (*gradients)(const void*, const double* t, int nodes, const double* q, const double* v,
                          double* gradients) = nullptr;
        void (*hessians)(const void*, const double* t, int nodes, const double* q, const double* v,
                         double* hessians) = nullptr;
        /// The gradients with the masses L_vv (d x d), which have most in common with L_v.
        void (*gradientsAndMasses)(const void*, const double* t, int nodes, const double* q, const double* v,
                                   double* gradients, double* masses) = nullptr;
    };
    std::shared_ptr<const WithLagrangian> withLagrangian = {};

    /// F and its derivatives by the entries that are not always 0, where the system offers it; null else.
    struct Entries {
        std::vector<MatrixEntry> first;  ///< (i, j): F_i by q_j, or by v_(j - d)
        void (*values)(const void*, double t, const double* q, const double* v, double* force,
                       double* first) = nullptr;
    };
    std::shared_ptr<const Entries> entries = {};
};

}  // namespace extremal
