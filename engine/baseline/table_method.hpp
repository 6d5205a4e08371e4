// SPDX-License-Identifier: GPL-3.0-or-later
/// A Runge-Kutta method of a table on Hamilton's equations:
///     Q_i = q_0 + h sum_j a_ij V_j,    P_i = p_0 + h sum_j ahat_ij F_j,    (V_i, F_i) = X_H(t + c_i h, Q_i,
///     P_i).
/// Explicit ones stage by stage; else by fixed-point iteration, and where that does not contract by Newton's
/// method on all stages together. The tangent map is that of the stages: (I - h J a) K' = J W.
#pragma once

#include "engine/step/flow_method.hpp"
#include "engine/tableau/tableau.hpp"

namespace extremal {

/// The tableau is plain or partitioned, with as many stages for q as for p.
std::unique_ptr<Integrator> makeTableMethod(const Mechanics<double>& mechanics, double step,
                                            const Tableau& tableau);

}  // namespace extremal
