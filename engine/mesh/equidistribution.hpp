// SPDX-License-Identifier: GPL-3.0-or-later
/// Nodes that give every element the same share of a density, and second differences on any mesh: what
/// adaptive meshes are placed by.
#pragma once

#include <cstddef>
#include <vector>

namespace extremal {

/// The nodes that give every element the same integral of a piecewise constant density M[e] on the mesh x
/// (de Boor): the ends stay. As many nodes as `nodes` has room for.
void equidistribute(const std::vector<double>& x, const std::vector<double>& M, std::vector<double>& nodes);

/// Three passes of (1 2 1)/4 over the elements, with the end elements repeated: neighbours then differ
/// little.
void smoothDensity(std::vector<double>& M);

/// Second differences of the values u over x, at all nodes; at the ends those of their neighbours.
void curvatures(const double* x, const double* u, std::size_t n, std::vector<double>& u_xx);

}  // namespace extremal
