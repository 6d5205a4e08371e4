// SPDX-License-Identifier: GPL-3.0-or-later
/// What all rigid bodies have in common as systems: their state's columns, initial data, energy, error, rate
/// and picture. Included by the .cpp files of the bodies in model/systems.
#pragma once

#include <array>
#include <vector>

#include "engine/model/system.hpp"

namespace extremal {

/// Makes the system that of a body (state: model/body/body.hpp) and fills in what follows from it. The error
/// is the angle of R_ref^T R in rad; error.p the norm of the difference of the momenta in the body; on SE(3)
/// error.position. Its measure "orthogonality" is how far the attitude is from a rotation: |R^T R - 1|
/// (Frobenius) of the matrix that the quaternion gives as it stands, which is the square of its length times
/// a rotation.
void describeBody(System& system, const Body& body);

/// Adds the measure "casimir": the Casimir of the body's bracket, kept by every exact solution; schemes that
/// rotate the momentum keep it too.
void addCasimir(System& system, EnergyFunction casimir);

/// Keys of /initial: attitude, and exactly one of momentum and omega, in body axes; on SE(3) position, and at
/// most one of velocity and linear_momentum, in space axes.
std::vector<FieldInfo> bodyInitialFields(bool movesInSpace);

/// The key "inertia": three principal moments.
FieldInfo inertiaField(std::array<double, 3> fallback);

/// U of the body at a state; 0 where it is free.
double bodyPotential(const BodyMechanics<double>& body, const double* x);

/// A space vector as the stage shows it: z up, x to the right, y away from the viewer.
inline Point onStage(double x, double y, double z) { return {x, z, -y}; }

/// Adds space's axes with their names as scenery.
void drawSpaceAxes(double length, Drawing& drawing);

/// The polhode of a free body as the stage's inset: its momentum in body axes on the sphere, with the energy
/// curves and the body's axes. Axis 3 is up.
void addPolhode(System& system);

}  // namespace extremal
