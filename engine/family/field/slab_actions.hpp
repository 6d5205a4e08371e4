// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete Lagrangian of a slab of a field, and the exact one of the same field on the same mesh:
///
///     L_d(u_0, u_1, h) = stationary value, over the levels between, of
///                        S = h sum_q b_q (v_q^T M v_q / 2 - U(P_q)),   P_q = sum_l psi_l(c_q) U_l,
///     L_d^exact(u_0, u_1, h) = integral of v^T M v / 2 - U(u) along the motion from u_0 to u_1,
/// with M and U of the spatial form: space is integrated in the same way in both, so that their distance is
/// that of the scheme in time. The motion is that of the spatial form with degree 4 and Gauss in time, and
/// the integral a Gauss sum over states of it, both refined until they agree. The levels between are found by
/// Newton's method with a sparse LU; of degree 1 there are none.
#pragma once

#include <memory>

#include "engine/family/time_table.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/model/field/spatial_form.hpp"

namespace extremal {

/// An action and the size of what it is a difference of: integrals of v^T M v / 2 and of |U|.
struct FieldAction {
    double value = 0, size = 0;
};

/// The levels U_0 .. U_s of the stationary slab between given ends, one after the other. None where they are
/// not found.
std::optional<std::vector<double>> slabLevels(const SpatialForm& form, const TimeTable& time, double step,
                                              const double* u0, const double* u1);
/// L_d between the values u_0 and u_1 of all nodes. None where the levels between are not found.
std::optional<FieldAction> slabAction(const SpatialForm& form, const TimeTable& time, double step,
                                      const double* u0, const double* u1);

/// Pairs of both actions from a state on.
ActionPairs slabActions(std::shared_ptr<const SpatialForm> form, const TimeTable& time, const State& start);

}  // namespace extremal
