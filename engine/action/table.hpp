// SPDX-License-Identifier: GPL-3.0-or-later
/// Space x quadrature = one table: all a step needs to know of the two choices that make an integrator.
///
/// With nodes i = 0..n-1 and unknowns a = 0..m-1 (Y_a in R^d), on a step of length h from q_0:
///     q(c_i)    = lift q_0 + sum_a value(i, a) Y_a,
///     q'(c_i) h = sum_a derivative(i, a) Y_a,
///     q_1       = lift q_0 + Y_{m-1}.
/// The basis of the space is changed once, before the run, so that the two trace conditions of the KKT system
///     dS/dz + (Ds-)^T p_0 - (Ds+)^T p_1 = 0,   s-(z) = q_0,   q_1 = s+(z)
/// become trivial (the null-space method): Y_0..Y_{m-2} multiply functions that vanish at both ends, Y_{m-1}
/// one that is 0 at the start and 1 at the end, and constants carry q_0 (lift = 1), so that the unknowns are
/// small increments and the momentum equation sums to p_1 = p_0 + h sum_i b_i L_q. Nodal and modal bases of
/// one space therefore give the same table up to a change of the interior unknowns, and the same step to
/// round-off. Test functions: value(., a) for a < m-1, and for the last row `test` = lift - value(., m-1),
/// whose start trace is 1 and end trace 0: it pairs with p_0 alone, so that the system has only the unknowns
/// Y.
///
/// The interior functions are orthonormal in int phi_a' phi_b', and the table of a space that can be
/// evaluated in quadruple precision is computed there and rounded: the basis of the space leaves no trace in
/// the conditioning.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <span>
#include <vector>

#include "engine/quadrature/rule.hpp"
#include "engine/space/space.hpp"

namespace extremal {

template <class T>
struct Table {
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;

    Vector node;            ///< c_i
    Vector weight;          ///< b_i
    Matrix value;           ///< (i, a): phi_a(c_i)
    Matrix derivative;      ///< (i, a): phi_a'(c_i)
    Matrix testValue;       ///< (i, a): test functions at the nodes; the last column is the start function
    Matrix testDerivative;  ///< (i, a)
    Matrix extrapolation;  ///< (a, b): coefficients of the curve extrapolated into the next step, relative to
                           ///< its start; empty: the space ends with the step
    Matrix smoothExtrapolation;  ///< of its smoothest part alone, which varies less there; empty: none
    Matrix change;               ///< (function of the space, a): z = liftCoefficients q_0 + change Y
    Vector lift;                 ///< coefficients of the function 1 in the space
    /// Smallest k with D(k) > 1e-9 (consistencyDefects), at most degree + 1: the rule is then not exact for
    /// some (P_k phi_a)', P_k of degree k and phi_a interior. As D(k) enters squared, 1e-9 is below
    /// round-off. Stationarity is then met to h^k only, which costs the action h^(2k); at k = 0 the rule does
    /// not integrate the slopes of the space, and not even a free particle keeps its speed.
    int consistency = 0;
    Space<T> space;
    Rule<T> rule;        ///< empty where the nodes are those of a Filon grid
    T frequency = T(0);  ///< step * frequency of an oscillatory space; 0: no function oscillates
    /// Where terms of the Lagrangian have rules of their own: the part of the Lagrangian that node i is for,
    /// and the weights of the nodes of the part with the velocities, 0 elsewhere. Empty: all nodes are for
    /// all.
    std::vector<int> part = {};
    Vector kineticWeight = {};
    bool dependsOnStep = false;  ///< the functions change with the length of the step
    /// share[i] for weightsUpTo, where the rule is not one of panels; else empty.
    std::function<void(const T& tau, std::span<T> share)> upTo = {};

    int nodes() const { return static_cast<int>(node.size()); }
    int unknowns() const { return static_cast<int>(value.cols()); }
};

/// Builds the table. Throws InvalidScene for an unsupported discretization: constants are not in the space,
/// its traces do not determine the end points, or the rule has too few nodes to see all of its functions
/// (singular for every step). Defined for double and quadruple precision.
template <class T>
Table<T> makeTable(const Space<T>& space, const Rule<T>& rule);

/// Whether the slopes of the functions, at the nodes that have a weight, are independent. Where they are not,
/// some motions inside a step cost no action, and the step is singular for every step size.
template <class T>
bool tellsFunctionsApart(const Table<T>& table);

/// D(k), k = 0..most-1: largest error of the rule for the derivatives of P_k phi_a, P_k Legendre's
/// polynomials and phi_a the interior functions, whose integrals vanish.
template <class T>
std::vector<double> consistencyDefects(const Table<T>& table, int most);

/// Eigenvalues of K_ab = sum_i b_i phi_a'(c_i) phi_b'(c_i), ascending: what the rule makes of the unit matrix
/// that the kinetic energy of the unknowns is. At 0 the step is singular for every step size; negative, the
/// action has no minimum however short the step is.
template <class T>
Eigen::VectorXd kineticValues(const Table<T>& table);

/// Weights b_i(tau) of the integral from 0 to tau of the polynomials through values at the nodes of each
/// panel, or of what a Filon grid takes the integrand for: those of the rule itself at tau = 1.
template <class T>
std::vector<T> weightsUpTo(const Table<T>& table, const T& tau);

}  // namespace extremal
