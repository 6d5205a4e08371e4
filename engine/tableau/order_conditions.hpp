// SPDX-License-Identifier: GPL-3.0-or-later
/// Order conditions of a partitioned Runge-Kutta method, by rooted trees.
///
/// The expansions of the solution and of the step agree up to h^p iff for all trees t with at most p nodes
///     sum_i b_i phi_i(t) = 1 / gamma(t),
/// phi_i(t) = prod over the children of sum_j a_ij phi_j(child), gamma(t) = |t| prod gamma(children). Nodes
/// have two colours: f, a velocity q' with weights b, and g, a force p' with bHat. What the systems are
/// decides which trees there are: of plain methods those of one colour; of H = T(p) + V(q) colours alternate;
/// where T is quadratic besides, f has one child at most (Nystrom); for every Hamiltonian all.
///
/// Trees are written as what they stand for: f''(g, g'(f)).
/// Source: Hairer, Lubich, Wanner (2006), III.1.1, III.2.1 and III.2.3.
#pragma once

#include <string>
#include <vector>

#include "engine/tableau/tableau.hpp"

namespace extremal {

enum class TreeKind { plain, all, separable, quadraticKinetic };

struct OrderCondition {
    std::string tree;  ///< "f''(f, f)"
    int order = 0;     ///< nodes
    int gamma = 1;     ///< the sum is to be 1 / gamma
    Quad residual = 0;
};

/// By order, up to `most`.
std::vector<OrderCondition> orderConditions(const Tableau& tableau, TreeKind kind, int most);

/// The conditions that decide for the systems of the tableau.
TreeKind treesFor(const Tableau& tableau);

/// The highest order up to which all conditions hold, at most that of the last.
int orderOf(const std::vector<OrderCondition>& conditions, double known);

}  // namespace extremal
