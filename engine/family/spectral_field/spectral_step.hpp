// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields by Fourier modes in space and polynomials of degree s in time with Gauss's rule of s nodes: order
/// 2 s in time, symplectic, stable for every step, spectral in space.
///
///     S_d = sum_i b_i h [ |u_t|^2 / 2 - c^2 |u_x|^2 / 2 - sum_m (L/M) W(u(x_m)) ] at t + c_i h,
/// over trigonometric polynomials of |k| < N/2, with the sum of M >= N nodes for the integral of W. It is
/// exact for W of degree p where M >= p N/2; then S_d does not change under any translation, and momentum is
/// conserved to round-off.
///
/// Stages by a fixed point, mode by mode implicit in the linear part (stage_tables.hpp):
///     u'' = -(c^2 k^2 + w) u + G,   G = w u - W'(u),   w: the mean of W'' over |u| <= 1, which changes the
///                                                       equations in nothing, and makes the rest small.
/// Over a rectangle |u_x|^2 + |u_y|^2, M nodes along each axis, and p N/2 of them make the sum exact as well.
/// Of several components each has its own modes, c and w, and they meet in the gradient of W.
/// It starts from G of the last step, extrapolated. With 2 s real transforms per iteration nothing is
/// factorised in a step.
#pragma once

#include <memory>
#include <vector>

#include "engine/integrator/integrator.hpp"
#include "engine/model/plane_field/joint_potential.hpp"
#include "engine/model/system.hpp"

namespace extremal {

struct SpectralScheme {
    int degree = 2;
    int nodes = 0;         ///< M, of a rectangle along x
    int nodesY = 1;        ///< along y
    double tolerance = 0;  ///< of the stages, relative; 0: to round-off
    int maxIterations = 0;
};

/// A periodic field over an interval (ny = 1, lengthY = 1) or a rectangle.
struct SpectralDomain {
    int nx = 0, ny = 1;
    double lengthX = 0, lengthY = 1;
    std::vector<double> stiffness;  ///< c^2 of each component
    JointPotential potential;
};
SpectralDomain spectralDomainOf(const System& system);

std::unique_ptr<Integrator> makeSpectralField(const SpectralDomain& domain, const SpectralScheme& scheme,
                                              double step);

}  // namespace extremal
