// SPDX-License-Identifier: GPL-3.0-or-later
/// Fully spectral in space and time: each step in equal slabs, on each of which the curve is a polynomial of
/// high degree. `legendre`: tested with polynomials of one degree less, which is Gauss collocation, from the
/// action; `chebyshev`: collocation at the Chebyshev roots. Both have symmetric nodes and keep the norm.
/// Trial and test spaces differ by a degree: an action with both ends given would be a boundary-value
/// problem.
#pragma once

#include <memory>

#include "engine/quadrature/rule.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {

/// Steps of as many of `slab`'s steps, which are step/slabs.
std::unique_ptr<Integrator> makeSlabs(std::unique_ptr<Integrator> slab, int slabs, double step);

/// n Chebyshev roots in [0, 1], as a rule whose nodes alone count.
Rule<double> chebyshevRoots(int n);

}  // namespace extremal
