// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lagrangian of one linear element whose ends move: u and the places of the nodes are both unknowns
/// (Leok 2004, sec. 6). With h = X_R - X_L, s = (y_R - y_L) / h, and u_t at both ends, seen from inside the
/// element, w_L = y'_L - s X'_L, w_R = y'_R - s X'_R:
///
///     l = h (w_L^2 + w_L w_R + w_R^2) / 6 - c^2 (y_R - y_L)^2 / (2 h) - h sum_q omega_q W(u_q),
///     u_q = (1 - xi_q) y_L + xi_q y_R.
/// It is the action density of the field on the image of a reference element. The integrand transforms with
/// the inverse of the map's derivative, u_x = u_xi / X_xi and u_t = u' - u_x X', and with its determinant
/// X_xi; "L |D phi|" in the source omits the former.
///
/// z = (y_L, X_L, y_R, X_R), v = its rate; derivatives by both.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/model/field/potential.hpp"

namespace extremal {

/// Integrals of the potential over an element of length 1, linear between its ends: W, W' with the two hat
/// functions, W'' with their products.
struct PotentialMoments {
    double W = 0, left = 0, right = 0, leftLeft = 0, leftRight = 0, rightRight = 0;
};

/// Those of all elements between neighbouring values, with four Gauss points each.
class PotentialMomentsOf {
public:
    PotentialMomentsOf(const FieldPotential& potential, std::size_t elements);

    /// y: elements + 1 values.
    void evaluate(const double* y, bool withCurvature);
    const PotentialMoments& operator[](std::size_t e) const { return moments_[e]; }
    /// Calls of W that one evaluation costs.
    long long evaluations() const { return static_cast<long long>(4 * moments_.size()); }

private:
    FieldPotential potential_;
    std::vector<PotentialMoments> moments_;
    std::vector<double> u_, W_, slope_, curvature_;
};

/// Kinetic energy of the element, and potential energy with that of the slope.
struct ElementEnergy {
    double kinetic, potential;
};
ElementEnergy elementEnergy(const double* z, const double* v, double c2, double W);

/// First and second derivatives of l: z-z, z-v and v-v at [i][j].
struct ElementDerivatives {
    using Matrix = std::array<std::array<double, 4>, 4>;
    std::array<double, 4> z, v;
    Matrix zz, zv, vv;
};

void elementGradient(const double* z, const double* v, double c2, const PotentialMoments& W,
                     ElementDerivatives& to);
/// Both.
void elementDerivatives(const double* z, const double* v, double c2, const PotentialMoments& W,
                        ElementDerivatives& to);
/// v-v alone: the mass of the element, which depends on z only.
void elementMass(const double* z, ElementDerivatives::Matrix& mass);

}  // namespace extremal
