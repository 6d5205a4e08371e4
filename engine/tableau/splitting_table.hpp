// SPDX-License-Identifier: GPL-3.0-or-later
/// Splitting methods for x' = A(x) + B(x) as tables: products of the two flows, exp(h (A + B)) up to order r,
///     exp(b_1 h B) exp(a_1 h A) exp(b_2 h B) ... exp(b_{n+1} h B)     kick first ("BAB"), or
///     exp(a_1 h A) exp(b_1 h B) exp(a_2 h A) ... exp(a_{n+1} h A)     drift first ("ABA"),
/// to be read from left to right as they are applied. All are palindromes, hence symmetric.
///
/// For mechanical systems A moves q (drift, the kinetic energy T(p)) and B moves p (kick, -grad V(q)); for
/// the Schroedinger equation A is the kinetic and B the potential part. Those marked Nystrom have their order
/// only where [B, [B, [B, A]]] = 0: T quadratic in p with constant masses, V a function of q (and t) alone;
/// Schroedinger included.
///
/// Source: S. Blanes and P. C. Moan, Practical symplectic partitioned Runge-Kutta and Runge-Kutta-Nystrom
/// methods, J. Comput. Appl. Math. 142 (2002) 313-330, tables 2 and 3. The coefficients are printed to 15
/// digits; those that follow from consistency (sums equal to 1) are computed. Those of order 8 are A19 and
/// B19 of S. Blanes, F. Casas and A. Escorihuela-Tomas, Runge-Kutta-Nystrom symplectic splitting methods of
/// order 8, Appl. Numer. Math. 182 (2022) 14-27, arXiv 2202.01541, tables 4 and 5, printed to 30.
/// tests/engine/tableau checks the order conditions.
#pragma once

#include <memory>
#include <vector>

namespace extremal {

struct Tableau;

struct SplittingStage {
    bool isKick;      ///< a flow of B, else of A
    double fraction;  ///< of the step
    bool operator==(const SplittingStage&) const = default;
};

struct Splitting {
    int order = 0;
    bool isNystrom = false;              ///< needs [B, [B, [B, A]]] = 0
    std::vector<SplittingStage> stages;  ///< in the order in which they are applied
};

Splitting strang();  ///< order 2, kick first, 1 kick
/// Strang steps over these parts of a step, which sum to 1, of an order that follows from them.
Splitting strangSteps(int order, const std::vector<double>& parts);
Splitting suzuki4();        ///< order 4: five Strang steps, g = 1/(4 - 4^(1/3)), g, 1 - 4g, g, g; 5 kicks
Splitting blanesMoanS6();   ///< order 4, any A and B, 6 kicks per step (the last is the first of the next)
Splitting blanesMoanS10();  ///< order 6, any A and B, 10 kicks
Splitting srkn6b();         ///< order 4, Nystrom, 6 kicks
Splitting srkn11b();        ///< order 6, Nystrom, 11 kicks
Splitting srkn14a();        ///< order 6, Nystrom, 14 kicks, drift first
Splitting srkn19a();        ///< order 8, Nystrom, 19 kicks, drift first
Splitting srkn19b();        ///< order 8, Nystrom, 19 kicks

// For H = A + e B with a small e, of which B alone is to be sampled well. The errors are sums of e h^p, e^2
// h^q, ...; the order is the least of these. Drift first but for lobattoKicks.
//
// Sources: Laskar and Robutel, Celest. Mech. Dyn. Astron. 80 (2001) 39-62; Blanes, Casas, Farres, Laskar,
// Makazaga and Murua, Appl. Numer. Math. 68 (2013) 58-72, tables 2 and 3.
Splitting gaussKicks(int n);    ///< order 2, at the nodes of Gauss: e h^(2n) + e^2 h^2
Splitting lobattoKicks(int n);  ///< order 2, at those of Lobatto, n >= 2: e h^(2n-2) + e^2 h^2; kick first
Splitting aba104();             ///< order 4, 7 kicks: e h^10 + e^2 h^4
Splitting aba864();             ///< order 4, 7 kicks: e h^8 + e^2 h^6 + e^3 h^4
Splitting aba1064();            ///< order 4, 8 kicks: e h^10 + e^2 h^6 + e^3 h^4

/// The same as a partitioned Runge-Kutta method; `known`: to how much the fractions are.
std::shared_ptr<const Tableau> tableauOf(const std::vector<SplittingStage>& stages, double known);

/// Half the trace of the product on the harmonic oscillator, with z = step * frequency.
double halfTrace(const std::vector<SplittingStage>& stages, double z);

}  // namespace extremal
