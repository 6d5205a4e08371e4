// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion in a time tau in which equal steps are those of a monitor g(q, p): dt = g dtau.
///
/// The motions of energy H_0 in the time t are those of
///     K(t, q; p_t, p) = g(q, p) (H(q, p) + p_t),    p_t = -H_0,
/// in the time tau, on K = 0: q' = g H_p + (H - H_0) g_p, p' = -g H_q - (H - H_0) g_q, t' = g, and p_t is
/// constant. K has no explicit time and needs no solver of its own: every scheme for a Hamiltonian takes it
/// with equal steps dtau, stays symplectic, in (t, q; -E, p), and keeps its order. Where g does not depend on
/// p and a Lagrangian L moves the system, this is the motion of g (L(q, q'/g) + H_0), and Gauss rules with as
/// many nodes as the degree make the same steps of both.
///
/// The monitor `logarithmic` has another K with the same motions, of which kicks and drifts in turn are
/// explicit (logarithmic.hpp).
///
/// Of times that are typed into H this is not so, and they are refused. Source: Hairer 1997; Reich 1999.
#pragma once

#include <memory>

#include "engine/core/settings.hpp"
#include "engine/core/state.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/system.hpp"
#include "engine/phase/monitor.hpp"

namespace extremal {

/// The Hamiltonian of a system that a Lagrangian or a Hamiltonian alone moves: by its Legendre transform, or
/// as it is. Throws std::logic_error for others.
PhaseMechanics hamiltonianFrom(const System& system);
/// Whether a system is of this kind.
bool hasHamiltonian(const System& system);

struct MonitoredProblem {
    System system;  ///< of K: coordinates t, then those of the system it is made from
    State start;    ///< of K
    PhaseMechanics energy;
    std::shared_ptr<const Monitor> monitor;  ///< with its bound
};

/// What schemes of K must take, without K: its number of coordinates and its part.
System monitoredKind(const System& system, const Settings& monitor);

/// For a run from `start` whose first step is `first` (negative: backwards). Throws InvalidScene, with
/// pointers below "/monitor", where g is not positive and finite at the start. A
/// start without x is one that is not known yet.
MonitoredProblem monitoredProblem(const System& system, const Settings& monitor, const State& start,
                                  double first);

/// Whether g(q, -p) = g(q, p) near a state, so that motions that turn back follow the same steps.
bool isEven(const Monitor& monitor, const State& at);

}  // namespace extremal
