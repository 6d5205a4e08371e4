// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions of the elements of a field that are not polynomials: for media a(x/epsilon) that elements are
/// too large to resolve (Leok 2004, sec. 7).
///
/// An element has two functions, phi and 1 - phi, where phi goes from 0 to 1:
///
///     cell problem   (a phi')' = 0: the flux a phi' is constant in an element;
///     snapshots      of a short resolved run of a standing wave: phi(1) = 1 times the leading left singular
///     vector of
///                    the increments u(x, t_k) - u(left end, t_k) over all elements and snapshots (proper
///                    orthogonal decomposition).
/// Both are known at the ends of equal parts of each element and linear between them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"

namespace extremal {

struct ElementFunctions {
    int parts = 1;                    ///< of an element
    std::vector<double> phi;          ///< at the end k of part k - 1 of element e: e (parts + 1) + k
    std::vector<double> coefficient;  ///< harmonic mean of a over part k of element e: e parts + k

    double at(int e, int k) const { return phi[static_cast<std::size_t>(e * (parts + 1) + k)]; }
    /// At xi in [0, 1] of element e.
    double value(int e, double xi) const;
};

using MediumCoefficient = std::function<double(double x)>;

ElementFunctions cellFunctions(const Mesh& mesh, const MediumCoefficient& a, int parts);
/// Of a wave equation with speed c sqrt(a); the same function on all elements.
ElementFunctions snapshotFunctions(const Mesh& mesh, const MediumCoefficient& a, double speed, int parts);

}  // namespace extremal
