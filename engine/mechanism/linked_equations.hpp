// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a step by the entries that are not always 0, solved in blocks (linkage.hpp): work and
/// room that grow with the number of bodies of a chain or a tree, and not with its cube.
///
/// With the test functions chi_a = phi_a (a < m - 1) and chi_{m-1} = 1 - phi_{m-1},
///     R_a(i) = [a = m-1] p_i + sum_k b_k [h chi_a L_q + chi_a' L_v + h chi_a F]_i + sum_{j<m} chi_a(e_j)
///              [g_q(q(e_j))^T Lambda_j]_i,
/// so that each entry of L'', F', g_q and g'' adds to the m x m numbers of one pair of coordinates or
/// constraints. Equal to dense_equations.hpp up to round-off.
#pragma once

#include <memory>

#include "engine/mechanism/linkage.hpp"
#include "engine/mechanism/mechanism_equations.hpp"

namespace extremal {

std::unique_ptr<MechanismEquations> linkedEquations(const LinkedParts& parts, const MechanismCurve& curve);

}  // namespace extremal
