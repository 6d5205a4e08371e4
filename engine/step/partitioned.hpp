// SPDX-License-Identifier: GPL-3.0-or-later
/// Symplectic Euler, Störmer-Verlet and other splittings as products of four half-maps, for any Hamiltonian.
///
///     kickImplicit(s):  p <- p + s pdot(q, p_new)      kickExplicit(s):  p <- p + s pdot(q, p)
///     driftImplicit(s): q <- q + s qdot(q_new, p)      driftExplicit(s): q <- q + s qdot(q, p)
/// For sums H = A(t, p) + B(t, q) all are explicit and the implicit ones are the explicit ones. Else the
/// implicit ones are solved by fixed-point iteration to round-off (Hairer, Lubich, Wanner 2006, VI.3, (3.3)
/// and (3.4)).
#pragma once

#include <memory>
#include <vector>

#include "engine/integrator/integrator.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/tableau/splitting_table.hpp"

namespace extremal {

enum class HalfMap { kickImplicit, kickExplicit, driftImplicit, driftExplicit };

struct PartitionedStage {
    HalfMap map;
    double fraction;  ///< of the step
    bool isKick() const { return map == HalfMap::kickImplicit || map == HalfMap::kickExplicit; }
};

/// A method that applies these stages in turn, each step.
std::unique_ptr<Integrator> makePartitioned(const Mechanics<double>& mechanics, double step,
                                            const std::vector<PartitionedStage>& stages);

/// The stages of a splitting. Where kicks and drifts are not explicit, symplectic Euler (kick first) with
/// fraction c_1, its adjoint with c_2, Euler with c_3, ...: b_1 = c_1, a_1 = c_1 + c_2, b_2 = c_2 + c_3, ...
/// has the same order for any Hamiltonian (McLachlan, SIAM J. Sci. Comput. 16 (1995) 151-168). That is for
/// splittings which start with a kick.
std::vector<PartitionedStage> partitionedStages(const Splitting& splitting, bool isSum);

}  // namespace extremal
