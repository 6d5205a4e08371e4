// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields by modes in space and polynomials of degree s in time: one step for every space whose linear part
/// is diagonal in a basis that there are ways to and from.
///
///     S_d = sum_i b_i h [ |u_t|^2 / 2 - c^2 |grad u|^2 / 2 - sum_m w_m W(u(x_m)) ] at t + c_i h
/// Modes are implicit one by one in the linear part (stage_tables.hpp), and the rest is a fixed point:
///     u'' = -(c^2 k^2 + w) u + G,   G = w u - W'(u),   w: the mean of W'' over |u| <= 1, which changes the
///                                                       equations in nothing, and makes the rest small.
/// Of several components each has its own modes, c and w, and they meet in the gradient of W. It starts from
/// G of the last step, extrapolated. Nothing is factorised in a step.
///
/// Trigonometric polynomials of |k| < N/2 over an interval or a rectangle, with the sum of M >= N nodes along
/// each axis for the integral of W and Gauss's rule of s nodes in time: order 2 s, stable for every step,
/// spectral in space. The sum is exact for W of degree p where M >= p N/2; then S_d does not change under any
/// translation, and momentum is conserved to round-off. 2 s real transforms per iteration.
///
/// Tensor elements of one size along each axis (model/field/element_grid.hpp), with any rule in time, and any
/// in space that sees the mass of every function. Four products of matrices per node in time and iteration.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "engine/integrator/integrator.hpp"
#include "engine/model/plane_field/joint_potential.hpp"
#include "engine/model/system.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

/// A periodic field over an interval (ny = 1, lengthY = 1) or a rectangle.
struct SpectralDomain {
    int nx = 0, ny = 1;
    double lengthX = 0, lengthY = 1;
    std::vector<double> stiffness;  ///< c^2 of each component
    JointPotential potential;
    std::optional<double> mass = {};  ///< w of all components, where it is not the mean of W''
};
SpectralDomain spectralDomainOf(const System& system);

/// How the stages of a step are found.
struct StageSolver {
    double tolerance = 0;  ///< relative; 0: to round-off
    int maxIterations = 0;
};

struct SpectralScheme {
    int degree = 2;
    int nodes = 0;   ///< M, of a rectangle along x
    int nodesY = 1;  ///< along y
    StageSolver solver;
};
std::unique_ptr<Integrator> makeSpectralField(const SpectralDomain& domain, const SpectralScheme& scheme,
                                              double step);

/// Elements of degree r along each axis, whose number of nodes is a multiple of it.
struct ElementScheme {
    int degree = 1;
    Rule<double> alongX, alongY;  ///< each sees the mass of every function
    int degreeInTime = 1;
    Rule<double> inTime;
    StageSolver solver;
};
std::unique_ptr<Integrator> makeElementField(const SpectralDomain& domain, const ElementScheme& scheme,
                                             double step);

}  // namespace extremal
