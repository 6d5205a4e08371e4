/// How fast waves run in a scheme: its frequency W(K) for waves of wave number K on a uniform mesh.
///
/// In space the waves exp(i K x) of a periodic mesh make an eigenvalue problem of r unknowns, K_h phi =
/// Lambda M_h phi; of its branches the one near K^2 belongs to the wave. In time the map of one step on the
/// oscillator of frequency sqrt(Lambda) has the half trace cos(W h).
#pragma once

#include "engine/family/field/discretization.hpp"

namespace extremal {

/// Lambda of the wave number k dx in [0, pi r] on elements of length 1, with wave speed 1 and no potential.
double spatialEigenvalue(int degree, const Rule<double>& rule, double kdx);

/// Half the trace of one step's map on the oscillator of frequency z / h.
double halfTrace(const TimeTable& time, double z);

/// Largest z = step * frequency for which the map is stable: 2 / sqrt(1 - 4 theta) of degree 1, theta = sum_b
/// v_b tau_b (1 - tau_b). Infinity: all.
double timeLimit(const TimeTable& time);

}  // namespace extremal
