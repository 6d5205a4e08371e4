// SPDX-License-Identifier: GPL-3.0-or-later
/// A step as a partitioned Runge-Kutta method, in quadruple precision.
///
/// Of q' = v(q, p), p' = f(q, p), with velocities V_j and forces F_i at stages of their own:
///     Q_i = q_0 + h sum_j A_ij V_j,        q_1 = q_0 + h sum_j b_j V_j,
///     P_j = p_0 + h sum_i Ahat_ji F_i,     p_1 = p_0 + h sum_i bHat_i F_i.
/// A method for every Hamiltonian has as many stages of either kind, at which both Q and P are known;
/// products of kicks and drifts need not, as they ask for V at P and for F at Q alone.
///
/// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration (2006), II.2, III.2 and VI.4.
#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

#include "engine/action/quadruple_table.hpp"

namespace extremal {

/// The systems for which a tableau says what the step is.
enum class TableauScope {
    any,               ///< every Hamiltonian
    separable,         ///< H = T(p) + V(q)
    quadraticKinetic,  ///< H = p . M^-1 p / 2 + V(q), M constant
};

struct Tableau {
    using Matrix = Eigen::Matrix<Quad, Eigen::Dynamic, Eigen::Dynamic>;
    using Vector = Eigen::Matrix<Quad, Eigen::Dynamic, 1>;
    Matrix A;        ///< (stage of F, stage of V)
    Matrix Ahat;     ///< (stage of V, stage of F)
    Vector b, bHat;  ///< of V; of F
    Vector c, cHat;  ///< times of V; of F
    TableauScope scope = TableauScope::any;
    double known = 1e-30;  ///< to how much the entries are known; what is below is taken for zero

    int velocities() const { return static_cast<int>(b.size()); }
    int forces() const { return static_cast<int>(bHat.size()); }
    /// q and p are treated alike: a plain Runge-Kutta method.
    bool isPlain() const;
    /// Each stage needs only those before it. Of kicks and drifts: in some order of all.
    bool isExplicit() const;
};

/// Stages in the order in which they can be taken, those of forces first: (is of V, number). Of implicit
/// methods all of F, then all of V.
std::vector<std::pair<bool, Eigen::Index>> stageOrder(const Tableau& tableau);

/// Of one set of coefficients for q and p; the nodes are the sums of the rows unless they are given.
Tableau plainTableau(const Tableau::Matrix& A, const Tableau::Vector& b, Tableau::Vector c = {});
/// With A for q and Ahat for p, both square.
Tableau partitionedTableau(const Tableau::Matrix& A, const Tableau::Matrix& Ahat, const Tableau::Vector& b,
                           const Tableau::Vector& bHat, TableauScope scope);

/// Of a product of flows, kicks of p and drifts of q over fractions of the step, as they are applied;
/// neighbours of one kind are one flow.
struct TableauFlow {
    bool isKick;
    Quad fraction;
};
Tableau splittingTableau(const std::vector<TableauFlow>& flows);

/// Of the Galerkin step of a table. With D the slopes and Phi the values of its functions at the nodes, W the
/// weights and K = D^T W D,
///     A = Phi K^-1 D^T W,    Ahat = 1 b^T - D K^-1 Phi^T W:
/// stationarity is D^T W P = e (p_0 + h b^T F) - h Phi^T W F, e the last unit vector, and P lies in the span
/// of D, as M V does. With as many nodes as unknowns V is free, A = Phi D^-1, and L may be any; else kinetic
/// energy is quadratic with a constant mass. Throws InvalidScene where the rule does not integrate the slopes
/// (K is singular, or a free particle does not keep its speed), as the step is then no Runge-Kutta method.
Tableau galerkinTableau(const Table<Quad>& table);

/// The method over parts g_i of the step, one after the other.
Tableau composed(const Tableau& tableau, const std::vector<Quad>& parts);

/// Largest |bHat_i A_ij + b_j Ahat_ji - bHat_i b_j|, and for every Hamiltonian |b_i - bHat_i|: 0 where the
/// method is symplectic (VI, Theorems 4.3 and 4.6).
Quad symplecticityDefect(const Tableau& tableau);
/// Largest |A_ij + A_{s+1-i, s+1-j} - b_j|, likewise of Ahat, b and bHat: 0 where it is its own adjoint (V,
/// Theorem 2.3). Stages are taken as they are listed, or in the order of their times.
Quad symmetryDefect(const Tableau& tableau);

/// The highest k for which sum b c^(m-1) = 1/m (B), sum_j a_ij c_j^(m-1) = c_i^m / m (C), and
/// sum_i b_i c_i^(m-1) a_ij = b_j (1 - c_j^m) / m (D) hold for m = 1..k; A and b for C, Ahat and bHat for D.
struct SimplifyingAssumptions {
    int B = 0, C = 0, D = 0;
};
SimplifyingAssumptions simplifyingAssumptions(const Tableau& tableau);

/// det(I + x M) as coefficients of x^0, x^1, ..; those at the end that are round-off are left out.
std::vector<Quad> expandedDeterminant(const Tableau::Matrix& M);

/// A quotient of polynomials, coefficients of x^0, x^1, ..
struct RationalFunction {
    std::vector<Quad> numerator, denominator;
    Quad operator()(const Quad& x) const;
};
/// R(z) of a plain method on x' = z x.
RationalFunction stabilityFunction(const Tableau& tableau);
/// Half the trace of the step on q' = p, p' = -z^2 q, h = 1, as a function of z^2.
RationalFunction oscillatorTrace(const Tableau& tableau);

/// "1/12", "-5/36", "1"; else `digits` decimals, below 1e-6 behind the first digit of the number. Fractions
/// have denominators below 10^6.
std::string numberText(const Quad& x, int digits, double known = 1e-30);
/// The fraction, or empty.
std::string fractionText(const Quad& x, double known = 1e-30);

}  // namespace extremal
