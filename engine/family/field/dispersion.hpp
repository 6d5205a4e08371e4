// SPDX-License-Identifier: GPL-3.0-or-later
/// How fast waves run in a scheme: its frequency W(K) for waves of wave number K on a uniform mesh.
///
/// In space the waves exp(i K x) of a periodic mesh make an eigenvalue problem of r unknowns, K_h phi =
/// Lambda M_h phi; of its branches the one near K^2 belongs to the wave. In time the map of one step on the
/// oscillator of frequency sqrt(Lambda) has the half trace cos(W h).
#pragma once

#include <limits>
#include <vector>

#include "engine/family/field/discretization.hpp"
#include "engine/family/parts/dispersion.hpp"
#include "engine/integrator/oscillator_step.hpp"

namespace extremal {

/// Lambda of the wave number k dx in [0, pi r] on elements of length 1, with wave speed 1 and no potential.
double spatialEigenvalue(int degree, const Rule<double>& rule, double kdx);

/// The largest of them: that of one element, which a wave that goes on from element to element with the
/// factor 1 or -1 attains.
double largestSpatialEigenvalue(int degree, const Rule<double>& rule);

/// Half the trace of one step's map on the oscillator of frequency z / h.
double halfTrace(const TimeTable& time, double z);

/// Intervals of z = step * frequency for which the map is unstable; degree 1 has the one edge
/// 2 / sqrt(1 - 4 theta), theta = sum_b v_b tau_b (1 - tau_b), if theta < 1/4.
std::vector<UnstableInterval> timeIntervals(const TimeTable& time);

/// Largest z up to which nothing grows by more than e in so many steps. Infinity: no such z. A mesh has waves
/// of all frequencies up to its highest, so that an interval that matters is a limit. Without a number of
/// steps every interval matters.
double timeLimit(const TimeTable& time, double steps = std::numeric_limits<double>::infinity());

/// W(K) up to r pi waves in an element of degree r, with the rule of the elements in space.
DispersionCurve dispersionCurve(const FieldProblem& problem, const Rule<double>& rule, const TimeTable& time,
                                double step);

}  // namespace extremal
