// SPDX-License-Identifier: GPL-3.0-or-later
/// What a tent space and a tensor product of rules mean: degrees, the rule of each direction, and how a step
/// is made. Internal to engine/family/field.
#pragma once

#include <memory>
#include <string>

#include "engine/core/algebra/dense.hpp"
#include "engine/family/discretization.hpp"
#include "engine/family/time_table.hpp"
#include "engine/model/field/spatial_form.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal {

struct TentDegrees {
    int space = 1, time = 1;
};
/// Of the space's key `degree`: one number for both directions, or one for each; 0 for what is not a whole
/// number.
TentDegrees tentDegrees(const Settings& space);

/// Whether the elements have functions of their own in place of linear ones: "cell-problem" or "snapshots".
bool hasOwnFunctions(const Settings& space);

/// The settings of a rule in "space" or "time"; one rule is that of both.
Settings ruleSettingsIn(const Settings& quadrature, const char* direction);
/// The rule itself; `exact` is Gauss with degree + 1 nodes, exact for the quadratic part of the action.
Rule<double> ruleIn(const Settings& quadrature, const char* direction, int degree);

/// The integrals over space of a discretization, on the mesh of the problem.
std::shared_ptr<const SpatialForm> spatialForm(const Discretization& d,
                                               std::shared_ptr<const FieldProblem> problem);
TimeTable timeTable(const Discretization& d);

/// M and K of an element of length 1 in Lobatto's functions, by one rule.
struct ElementMatrices {
    dense::Matrix<double> mass, stiffness;
};
ElementMatrices elementMatrices(int degree, const Rule<double>& rule);

/// 1 - 4 sum_a w_a xi_a (1 - xi_a) of linear functions, and its like: the smallest eigenvalue of the mass of
/// an element, relative to the largest. 0: the rule does not see the mass of a wave.
double leastMass(int degree, const Rule<double>& rule);

/// Whether the mesh carries a wave that the rule in space gives no mass, such as the wave that alternates
/// from node to node with the midpoint rule, on an even number of cells around a circle or between free ends.
/// Its velocity does not follow from its momentum, which is 0.
bool hasMasslessWave(const FieldProblem& problem, const Rule<double>& rule);

}  // namespace extremal
