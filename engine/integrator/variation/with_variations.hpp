// SPDX-License-Identifier: GPL-3.0-or-later
/// An integrator that carries variations of the state along with it, by the tangent maps M_k of its steps
/// (Integrator::applyTangent), and says what they show:
///
///     symplecticity              max |M^T Om_1 M - Om_0|, Om the symplectic form
///     symplecticity_accumulated  max |P^T Om_n P - Om_0| / max |P|^2,   P = M_n ... M_1
///     volume                     det M - 1
///     floquet_trace              trace P: the sum of the multipliers after one period; floquet_trace.x that
///                                of the block of x and its momentum, where the motion leaves x alone
///     lyapunov                   sum ln r_k / t,   r_k = |M_k w|, w normalised after each step
///     megno                      the mean over time of Y = (2/t) sum t_k ln r_k: 2 on regular motions, 0 on
///                                isochronous ones, lambda t / 2 on chaotic ones (Cincotta and Simo 2000)
/// with times from the start. Where times are unknowns M is large, and symplecticity is relative to
/// max |M|^2. P is kept as 2^e Q, so that it does not overflow. A state with more than
/// `mostColumns` variations is represented by a few of them, which begin at random places: symplecticity is
/// then that of their pairs, of length 1, and there is neither volume nor trace; of wave functions the inner
/// products are compared as well, U^* U = 1.
///
/// On a manifold of states (constraints) M, P and w act on variations along it, in an orthonormal basis B of
/// them at each node: symplecticity is max |(M B)^T Om_1 M B - B^T Om_0 B|, the volume that of Om, the root
/// of det (M B)^T Om_1 M B / det B^T Om_0 B, and there is no trace.
///
/// Variations and sums are in the memory of the state, behind that of the scheme. Where a step has no tangent
/// map, or did more than go on (StepReport::event), everything that follows is unknown. What this costs is
/// part of the cost of the run: a scene that observes none of it is integrated without.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"
#include "engine/model/tangent_basis.hpp"

namespace extremal {

/// Which of them are wanted.
struct VariationPlan {
    bool map = false;         ///< those of M and P
    bool vector = false;      ///< lyapunov and megno
    bool errors = false;      ///< those of integrator/variation/with_local_errors.hpp
    bool frame = false;       ///< all exponents: integrator/variation/with_exponents.hpp
    bool parameters = false;  ///< derivatives by numbers: integrator/variation/with_sensitivities.hpp
    bool isEmpty() const { return !map && !vector && !errors && !frame && !parameters; }
};

/// The same integrator where nothing is wanted, or it has no tangent map. `free`: how many variations
/// `basis` has, where there is one.
std::unique_ptr<Integrator> withVariations(std::unique_ptr<Integrator> scheme, const System& system,
                                           const VariationPlan& plan, TangentBasis basis = {}, int free = 0);

}  // namespace extremal
