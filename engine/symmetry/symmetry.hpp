// SPDX-License-Identifier: GPL-3.0-or-later
/// Affine symmetries of a Lagrangian and the momenta of Noether's theorem, found by linear algebra.
///
/// q -> q + e xi, t -> t + e tau with
///     xi = A q + b + c t,   tau = tau0 + tau1 t
/// changes L by a total derivative dF/dt if
///     L_q.xi + L_v.(A v + c - tau1 v) + L_t tau + L tau1 - F_t - F_q.v = 0      for all (t, q, v),
/// and then J = p.xi - tau H - F is constant along the motion. F is a polynomial: of degree 2 in q (3 where
/// there are at most 3 coordinates), of degree 1 in t with it and 3 without. The condition is linear in (A,
/// b, c, tau0, tau1, F): the symmetries are the null space of a matrix with one row per random state. Found
/// in milliseconds for up to 8 coordinates; of more, translations, rotations and boosts of all bodies
/// together are tried by name.
/// States near the places where a typed formula changes are among them, and the energy of a formula with t in
/// it is not conserved, whatever the states say. What moves a jump of a typed formula (sign(x - 50)) is not a
/// symmetry (jumps.hpp). Not found: symmetries that are not affine in these
/// coordinates (a translation in polar coordinates), and hidden ones (Runge-Lenz).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/symmetry/sample.hpp"

namespace extremal {

/// coefficient * q_i q_j q_k t^power; -1 in place of an index: no factor.
struct GaugeTerm {
    int i = -1, j = -1, k = -1;
    int power = 0;
    double coefficient = 0;

    /// The degree in q.
    int degree() const { return (i >= 0) + (j >= 0) + (k >= 0); }
    double value(double t, const double* q) const;
    /// Its derivative along `direction`, at fixed t.
    double rateAlong(double t, const double* q, const double* direction) const;
    /// Its partial derivative by t.
    double rateInTime(double t, const double* q) const;
};

enum class SymmetryKind { translation, rotation, boost, linear, scaling, time };

struct Symmetry {
    SymmetryKind kind = SymmetryKind::linear;
    int dimension = 0;
    std::vector<double> A;  ///< d x d, row after row
    std::vector<double> b, c;
    double tau0 = 0, tau1 = 0;
    std::vector<GaugeTerm> F;

    /// 0: to round-off. Else L is only nearly invariant: the largest |sum| / sum |terms| of the condition.
    double defect = 0;
    /// Its momentum is a function of those of the symmetries before it.
    bool isDependent = false;
    std::string name;       ///< of its column, without "momentum."; "rotation.x-y"
    std::string title;      ///< "rotation in the plane x-y about (5, -3)"
    std::string generator;  ///< "x: -y - 3, y: x - 5; F = y/2"

    double& a(int i, int j) { return A[static_cast<std::size_t>(i * dimension + j)]; }
    double a(int i, int j) const { return A[static_cast<std::size_t>(i * dimension + j)]; }
    bool isExact() const { return defect == 0; }
    bool movesTime() const { return tau0 != 0 || tau1 != 0; }
    /// xi, and F, at (t, q).
    void displacement(double t, const double* q, double* xi) const;
    double gauge(double t, const double* q) const;
    /// |sum| / sum |terms| of the condition at a state; 0 where all terms vanish, and not a number where one
    /// is not finite.
    double violation(const SampledState& state) const;
    /// J = p.xi - tau H - F.
    double momentum(const Mechanical& mechanics, double t, const double* q, const double* p) const;
};

/// Whether any entry of A, b or c is not 0.
bool hasNonzero(const std::vector<double>& entries);

/// All of them, exact ones first. Remembered for the last few systems.
std::shared_ptr<const std::vector<Symmetry>> symmetriesOf(const System& system);

/// Those of the Lagrangian that leave constraints as they are (and the gaps of walls, where these are kept),
/// whatever forces there are: what changes their momenta is sum J . xi over the impulses J of forces and
/// walls. Empty where there are rolling conditions, whose reactions change momenta as well.
std::shared_ptr<const std::vector<Symmetry>> symmetriesBesideForces(const System& system, bool areWallsKept);

/// "rotation in the plane x-y, energy", "none found".
std::string symmetryText(const System& system);

}  // namespace extremal
