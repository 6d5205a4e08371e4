// SPDX-License-Identifier: GPL-3.0-or-later
/// Splines of degree s on a step divided into cells: a polynomial of degree s in each, s - 1 times
/// continuously differentiable where cells meet, free at the ends of the step.
///
/// Basis: the s + cells B-splines N_a over the knots 0 (s + 1 times), 1/cells, 2/cells, ... or given ones, 1
/// (s + 1 times), by the recurrence of Cox and de Boor; they are not negative and sum to 1, only the first is
/// nonzero at the start and only the last nonzero at the end. Outside [0, 1] the polynomials of the outer
/// cells are extrapolated. With one cell: the polynomials. Source: de Boor, A practical guide to splines, ch.
/// IX and X.
#pragma once

#include <vector>

#include "engine/space/space.hpp"

namespace extremal {

/// degree >= 1, cells >= 1.
template <class T>
Space<T> splineSpace(int degree, int cells);
/// Cells of any length: their ends, 0 to 1, ascending.
Space<double> splineSpace(int degree, const std::vector<double>& cells);

}  // namespace extremal
