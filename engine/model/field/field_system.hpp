// SPDX-License-Identifier: GPL-3.0-or-later
/// What models of fields share: the System of a field problem.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/model/field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// A key of the settings of such a model that no scene has: the degree of the elements, where a scheme has
/// its own (Family::model).
inline constexpr const char* elementDegreeKey = "element_degree";
/// The same of functions of the elements: "cell-problem" or "snapshots", and in how many parts; 0: by itself.
inline constexpr const char* elementFunctionsKey = "element_functions";
inline constexpr const char* elementPartsKey = "element_parts";

/// Another one: the elements are the equal distances between the nodes of a trigonometric polynomial.
inline constexpr const char* trigonometricKey = "trigonometric";

/// Another one: the number of nodes between the ends, where they move.
inline constexpr const char* movingNodesKey = "moving_nodes";

/// Energy, momenta, error, sampling, drawing, start and exact solution of a field. Energy is that of the
/// values at the nodes, by the Lobatto rule of the nodes of each element (in a medium by a finer one): the
/// same for all schemes. `amplitude`: a usual size of u, which the drawing is scaled by.
System makeFieldSystem(std::shared_ptr<const FieldProblem> problem, double amplitude);

/// The column of the error of a field over the nodes.
std::vector<Quantity> fieldErrorColumns();
/// Columns of the momentum of translation and its change.
std::vector<Quantity> translationColumns();

/// u at the nodes x as a curtain above 0; `unit`: how high 1 stands.
void drawField(const FieldProblem& problem, std::span<const double> x, double unit, const double* u,
               Drawing& drawing);

/// sum_i dx_i e_i^2 uses the whole dx at every node of a uniform mesh, ends included, else half of both
/// neighbouring distances.
std::vector<double> errorWeights(const FieldProblem& problem);

/// -integral of u_t u_x: the momentum of translation, by the Lobatto rule of the nodes of each element. Kept
/// by the field equation of a periodic field, and nearly so by schemes.
double translationMomentum(const FieldProblem& problem, const double* x);

}  // namespace extremal
