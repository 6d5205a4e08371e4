// SPDX-License-Identifier: GPL-3.0-or-later
/// Holonomic constraints g(t, q) = 0, as a part of a mechanical system (x = (q, p)).
///
/// With multipliers lambda the motion is d/dt L_v = L_q + g_q^T lambda, g = 0, and so g_q v + g_t = 0 as
/// well. Index roles: constraint k = 0..count-1, coordinate i = 0..d-1; matrices row by row. Units are those
/// of the user's formulas: lambda_k has that of L over that of g_k.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/model/parts.hpp"
#include "engine/model/parts/entries.hpp"

namespace extremal {

struct Constraint {
    static constexpr PartInfo part{"constraint", "a constraint"};

    std::vector<std::string> names;     ///< "rod": one for each constraint
    std::shared_ptr<const void> model;  ///< first argument of the calls
    bool isTimeDependent = false;

    int count() const { return static_cast<int>(names.size()); }

    /// g (count), g_q (count x d) and g_t (count).
    void (*first)(const void*, double t, const double* q, double* g, double* byPlace,
                  double* byTime) = nullptr;
    /// Where the system offers it (null else): (g, g_q) at many nodes together, count (1 + d) entries, entry
    /// k of node i at k * nodes + i, likewise q; `nodes` is a multiple of 8.
    void (*firsts)(const void*, const double* t, int nodes, const double* q, double* firsts) = nullptr;
    /// What there is at many nodes by their times and places: entry k of node i at k * nodes + i, likewise q;
    /// `nodes` is a multiple of 8.
    struct AtNodes {
        std::shared_ptr<const void> model;
        void (*call)(const void*, const double* t, int nodes, const double* q, double* to) = nullptr;
    };
    /// How count coordinates depend on the f = d - count others, where the system offers it (null else). The
    /// order has the constraints, the coordinate that each of these gives, and the others: with the columns
    /// G_D and G_F of g_q, N = -G_D^-1 G_F (count x f) and -G_D^-1 g (count), eliminated in that order. Not a
    /// number where a pivot is 0.
    AtNodes (*dependence)(const void*, std::span<const int> order) = nullptr;
    /// Adds sum_k lambda_k d2 g_k / dq dq to a d x d matrix.
    void (*addCurvature)(const void*, double t, const double* q, const double* lambda,
                         double* matrix) = nullptr;
    /// v^T g_qq v + 2 g_qt v + g_tt (count): what g_q a has to cancel.
    void (*rates)(const void*, double t, const double* q, const double* v, double* rates) = nullptr;

    /// The same by the entries that are not always 0, where the system offers it; null else.
    struct Entries {
        std::vector<MatrixEntry> byPlace;  ///< (constraint, coordinate)
        struct Second {
            int constraint, row, column;  ///< column <= row, of d2 g / dq dq
        };
        std::vector<Second> curvature;
        /// g, the entries of g_q, and g_t.
        void (*first)(const void*, double t, const double* q, double* g, double* byPlace,
                      double* byTime) = nullptr;
        void (*second)(const void*, double t, const double* q, double* curvature) = nullptr;
    };
    std::shared_ptr<const Entries> entries = {};
};

}  // namespace extremal
