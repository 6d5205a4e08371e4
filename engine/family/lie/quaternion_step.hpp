// SPDX-License-Identifier: GPL-3.0-or-later
/// Free rotating bodies as one spin: polynomials of degree s in the quaternion, with Gauss(s).
///
/// The momentum pi in space is constant, and that in the body is the spin of a spinor: with q in place of z
/// in C^2, mu = vec(q^* pi q), and L = 2 Re(i z^+ z') - H(mu) of first order on S^3 (the Hopf form, as for
/// spins), H = mu . I^-1 mu / 2, stationarity is
///     q' = q (0, I^-1 mu) / 2.
/// Continuous polynomials of degree s with test functions of degree s - 1 and Gauss(s) are Gauss collocation.
/// Quadratic invariants of it are exact, so that |q| = 1; the phase of z is a symmetry, so that the map of
/// (g, mu) is symplectic; pi is kept because it is no unknown. Order 2s. Four numbers a stage and no
/// functions but products (quaternion_kernel.hpp): the motion of the momentum and that of the attitude are
/// one. A rotation about a fixed axis is not exact here, as it is in the algebra.
/// Source: Leok 2004, sec. 3; the first-order form of the body is not in it.
#pragma once

#include <memory>

#include "engine/family/discretization.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Of a free body on SO(3), or a group given as data that is one. Throws InvalidScene.
std::unique_ptr<Integrator> makeQuaternionIntegrator(const System& system, const Discretization& d,
                                                     double step);

/// Why the system is not one; empty where it is.
std::string quaternionProblem(const System& system);

}  // namespace extremal
