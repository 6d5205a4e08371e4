// SPDX-License-Identifier: GPL-3.0-or-later
/// Which momenta a discretization keeps to round-off, by a rule and without a run.
///
/// A symmetry with F = 0 that does not move time leaves the integrand at every node as it is, if the varied
/// curve is in the space: the coordinates that A mixes have one space, and there are constants (and, for
/// boosts, t) in it. Its momentum is then kept by every quadrature rule, even one of no order. With F != 0
/// the sum over the nodes of dF/dt must be F at the end minus F at the start: the rule integrates polynomials
/// of degree k s + l - 1 exactly, for terms of degree k in q and l in t and a space of degree s.
#pragma once

#include "engine/family/discretization.hpp"
#include "engine/symmetry/symmetry.hpp"

namespace extremal {

///
/// Where terms have rules of their own, the integrand at a node is a part of the Lagrangian, and every part
/// must have the symmetry.
bool keeps(const Discretization& discretization, const Symmetry& symmetry, const System& system);

}  // namespace extremal
