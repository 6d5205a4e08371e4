// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanism in space as a typed Lagrangian with constraints.
///
/// A body has 12 coordinates, its centre of mass x and the columns d_1, d_2, d_3 of its attitude R, and a
/// kinetic energy whose mass matrix is constant: with E = tr(I)/2 - I (sum rho X X^T over the body, X in body
/// axes), I the inertia about the centre of mass,
///     T = m/2 |x'|^2 + 1/2 sum_jk E_jk d_j' . d_k'  =  m/2 |x'|^2 + 1/2 omega . I omega   on   R in SO(3),
/// which it is kept on by six constraints on the entries of the group, d_j . d_k = delta_jk (orthonormal
/// columns; the sign of the determinant cannot change on a curve). A flat body has E_jj = 0 along its normal:
/// that column is left out, 9 coordinates and 3 constraints, d_j = d_k x d_l.
///
/// Joints are constraints on the entries as well, P the place of the joint on either side, a the axis on the
/// one and e_1, e_2, normal to it, on the other:
///     ball       P - P' = 0                                  universal  P - P' = 0, a . s = 0
///     hinge      P - P' = 0, a . e_i = 0                     weld       P - P' = 0, a . e_i = 0, b . e_1 = 0
///     cylinder   (P - P') . e_i = 0, a . e_i = 0             slider     that, and b . e_1 = 0   (b = e_2 at
///     first)
///
/// So the step is that of mechanisms (mechanism/mechanism_step.hpp), and variational: the motion is
/// stationary for the discrete action among curves in R^12 whose values at the Lobatto nodes are on the
/// constraints, which is where a curve in the group has its values, and p at the ends of a step is projected
/// to the cotangent space of the group. Its limit is the motion of the Lie form (stationary among curves in
/// SE(3)^N that the joints allow), as on the constraints L is the same function; the discrete motions of the
/// two differ in their errors, of order 2s both. Rotations and displacements of space act linearly on (x,
/// d_j) and leave L and the constraints of joints among bodies alone: their momenta are kept to round-off. A
/// body's unknowns and constraints, with the joint that it hangs on, are one block (mechanism/linkage.hpp):
/// in chains and trees they are eliminated body by body.
///
/// Forces: gravity in -z; springs, rods and dampers between points as in the plane; a torque T about an axis
/// a as f_j = T a x d_j / 2, whose work over a turn theta is T a . theta (sum_j (a x d_j) . (theta x d_j) =
/// 2 a . theta); damping of a turn D = c/2 |omega|^2, |omega|^2 = sum_j |d_j'|^2 / 2, between two bodies
/// sum_jk ((d_j . d'_k)')^2 / 2. Numbers become parameters named after the element: m_B, I1_B, k_SPRING, g.
#pragma once

#include "engine/model/parts/written_form.hpp"
#include "engine/model/spatial/assembly.hpp"

namespace extremal::spatial {

WrittenForm writtenAssembly(const Assembly& assembly);

}  // namespace extremal::spatial
