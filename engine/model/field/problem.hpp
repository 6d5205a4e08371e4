// SPDX-License-Identifier: GPL-3.0-or-later
/// A field u(x, t) over an interval:
///
///     L = integral of u_t^2 / 2 - a(x) phi(u_x) - W(u) dx,    u_tt = (a phi'(u_x))_x - W'(u).
///
/// The state of a field is x = (u_0 .. u_{n-1}, v_0 .. v_{n-1}): u and u_t at the nodes of its mesh. At a
/// Dirichlet boundary the values stay as they are and v is 0.
#pragma once

#include <cmath>
#include <memory>

#include "engine/mesh/mesh.hpp"
#include "engine/model/field/element_functions.hpp"
#include "engine/model/field/elasticity.hpp"
#include "engine/model/field/nodes.hpp"
#include "engine/model/field/potential.hpp"

namespace extremal {

struct FieldProblem {
    Mesh mesh;
    FieldNodes nodes;
    Elasticity elastic;
    FieldPotential potential;
    MediumCoefficient coefficient;  ///< a(x); empty: 1
    /// Of the elements, in place of linear functions; null: polynomials.
    std::shared_ptr<const ElementFunctions> functions;

    /// The nodes are unknowns: x = (y, y', X, X') of all of them, y' along the path of the node, and `mesh`
    /// says where they are before a scheme places them (moving_field.hpp).
    bool hasMovingNodes = false;
    /// u is the trigonometric polynomial through its values (trigonometric_form.hpp).
    bool isTrigonometric = false;
    bool isBody = false;  ///< u displaces the points of a body: elements have a strain of their own

    int size() const { return nodes.size(); }
    double speed() const { return std::sqrt(elastic.k); }
    /// Whether the value at a node stays as it is.
    bool isFixed(int node) const {
        return mesh.boundary == Boundary::dirichlet && (node == 0 || node == size() - 1);
    }
    /// The field equation is linear.
    bool isLinear() const { return elastic.isLinear() && potential.isLinear(); }
};

}  // namespace extremal
