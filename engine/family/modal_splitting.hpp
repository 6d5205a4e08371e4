// SPDX-License-Identifier: GPL-3.0-or-later
/// Periodic fields in Fourier modes that move freely between kicks of the rest of the potential.
///
///     S = sum_j S_0(u_{j-1}, u_j; a_j h) + h sum_j b_j sum_m w_m (w u^2/2 - W(u))(x_m) at knot j
/// S_0 is the action of the free motion of every mode, of the frequency sqrt(c^2 k^2 + w) (modal_march.hpp),
/// from one knot to the next; w decides which splitting it is, and how large its errors are. A kick costs two real transforms, and as many as one less for a step that
/// begins with the kick that the last one ended with. The modes (-1)^j of even numbers of nodes are
/// oscillators of their own.
#pragma once

#include <memory>

#include "engine/family/modal_step.hpp"
#include "engine/tableau/splitting_table.hpp"

namespace extremal {

std::unique_ptr<Integrator> makeModalSplitting(const SpectralDomain& domain, const Splitting& splitting,
                                               double step);

}  // namespace extremal
