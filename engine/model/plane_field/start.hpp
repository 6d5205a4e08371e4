// SPDX-License-Identifier: GPL-3.0-or-later
/// Initial data of a field over a rectangle: expressions or values at the nodes for each component, and
/// profiles by name, which add up with them and with each other.
///
///     plane-wave {wave_vector, amplitude, phase}     amplitude exp(i (k.x - w t + phase)), k_i = 2 pi
///                                                    wave_vector_i/L_i, w^2 = c^2 k^2 + W'(A)/A, of two
///                                                    components that turn into each other; of one component
///                                                    of a linear field its real part
///     q-ball {omega, centre, velocity, phase}        f(r) exp(i (omega t + phase)), moved by the Lorentz
///                                                    transformation (q_ball.hpp)
///     random {amplitude, correlation, seed}          a random field of variance amplitude^2 in each
///                                                    component
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/plane_field/problem.hpp"

namespace extremal {

/// The keys of /initial: of each component `u` and `u_t`, and `profile`.
std::vector<FieldInfo> planeFieldStartFields(const std::vector<std::string>& names);

/// The profiles that have names, with their keys.
std::vector<CatalogItem> planeFieldProfiles();

/// The state at time t. Throws InvalidScene with pointers relative to /initial.
std::vector<double> planeFieldStart(const PlaneFieldProblem& problem, const Settings& initial, double t);

/// The exact solution that one profile alone starts: a plane wave, or a Q-ball at rest; else empty.
ExactSolution planeFieldExact(const std::shared_ptr<const PlaneFieldProblem>& problem,
                              const Settings& initial);

}  // namespace extremal
