// SPDX-License-Identifier: GPL-3.0-or-later
/// A Lagrangian on a matrix group, left trivialised: L(g, eta), eta = g^-1 g' in coordinates of the algebra.
///
/// With the basis E_a of the algebra (group/matrix_group.hpp), arrays of d entries, or matrices in the
/// layout of the couplings of factors (group/couplings.hpp; of one factor d x d, column after column):
///     m_a = dL/deta_a,   f_a = dL/dg . (g E_a)  (the part of a kinetic energy that depends on g included),
///     M_ab = d2L/deta_a deta_b,   N_ab: the derivative of m_a along g exp(eps E_b),   S_ab: that of f_a.
/// S is not symmetric: its antisymmetric part is the bracket with f. The state of a run is the entries of g,
/// row by row; mu = dL/deta, the momentum in the body; and J = Ad_{g^-1}^T mu, that in space, which the
/// integrators carry on: where L is left invariant nothing ever touches it.
#pragma once

#include <memory>
#include <vector>

#include "engine/group/couplings.hpp"
#include "engine/group/group_invariants.hpp"
#include "engine/group/matrix_group.hpp"

namespace extremal {

struct GroupMechanics {
    std::shared_ptr<const MatrixGroup> group;
    std::shared_ptr<const GroupInvariants> invariants;  ///< of the group
    std::shared_ptr<const Couplings> couplings;         ///< of the factors in L: where M, N and S are not 0
    std::shared_ptr<const void> model;                  ///< first argument of the calls below
    bool isInvariant = true;         ///< g does not occur in L: f, N and S are 0, and g may be null
    bool isMixed = false;            ///< N is not 0 everywhere
    bool hasConstantMasses = false;  ///< M depends on nothing
    /// Coordinates along which the group moves nothing that L sees, on a space on which it acts: L does not
    /// depend on these velocities, which are held at 0, nor do momenta have these components.
    std::vector<int> isotropy = {};

    /// L, m and f; f may be null.
    void (*gradient)(const void*, const double* g, const double* eta, double* value, double* m,
                     double* f) = nullptr;
    /// The same and the second derivatives; f, N and S may be null together.
    void (*jet)(const void*, const double* g, const double* eta, double* value, double* m, double* f,
                double* M, double* N, double* S) = nullptr;
    /// eta with dL/deta = mu; false where it is not found.
    bool (*velocity)(const void*, const double* g, const double* mu, double* eta) = nullptr;

    int dimension() const { return group->dimension(); }
    int stateSize() const { return group->entries() + 2 * group->dimension(); }
};

}  // namespace extremal
