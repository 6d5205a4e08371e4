// SPDX-License-Identifier: GPL-3.0-or-later
/// Asynchronous variational integrators of bars and membranes: every element has its own step (Lew, Marsden,
/// Ortiz, West 2003). They follow from the framework of Leok 2004, sec. 2.1, with a mesh of time for each
/// element:
///
///     S = sum_a sum_i m_a/2 (t_a^{i+1} - t_a^i) |du_a / dt_a|^2 - sum_K sum_j h_K V_K(u_K(t_K^j)).
/// A node moves in straight lines between the times of its elements; element K kicks its nodes by -h_K
/// dV_K/du at its times, which are in the middles of its steps, (j + 1/2) h_K, so that no half kick is needed
/// at the start. Every event touches one element and its nodes.
///
/// With dyadic levels h_K = h_0 2^l all elements have just finished a step at multiples of the largest one:
/// between these times the scheme is a symmetric one-step method, without any memory. In units of h_0/2 the
/// elements of level l kick at the odd multiples of 2^l: at time tau those of the level that is the number of
/// trailing zeros of tau. With all elements on the lowest level this is leapfrog with the smallest step.
///
/// With real steps, C times the critical step of each element, elements are hardly ever at the same time. The
/// state at t is then what follows when all nodes go on to t and every element gives, or takes back, the part
/// of its last kick that belongs to the times up to t. The scheme carries its unsynchronised nodes and clocks
/// as memory.
#pragma once

#include <memory>

#include "engine/family/asynchronous/elements.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/mesh/levels.hpp"

namespace extremal {

/// `step`: of the highest level. Of bars and membranes.
template <class Elements>
std::unique_ptr<Integrator> makeDyadicSteps(Elements elements, const Levels& levels, double step);

/// Elements by a queue of their times; `step` is the time between states.
template <class Elements>
std::unique_ptr<Integrator> makeRealSteps(Elements elements, double courant, double step);

}  // namespace extremal
