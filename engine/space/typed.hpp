// SPDX-License-Identifier: GPL-3.0-or-later
/// Spaces of typed functions: any formulas of tau that span one, made well conditioned.
///
/// The functions f_1..f_n are scaled and made orthonormal in f(0) g(0) + int f' g', in quadruple precision,
/// and with a hundred digits where the least pivot sigma is below 1e-17: the table of a space is good to
/// eps / sigma. Then the basis is turned so that its functions are
///     1,    those that vanish at both ends, orthonormal in int f' g',    one that goes from 0 to 1,
/// the last orthogonal to the others: the basis of the table (action/table.hpp) already. In double precision
/// they are evaluated as Chebyshev series on panels where the functions are smooth (smooth_panels.hpp), so
/// that the conditioning of what was typed leaves no trace in the dense output.
///
/// Errors are InvalidScene with pointers below /space: functions that are not finite, jump or have corners
/// without a knot, follow from the others, do not contain the constants, or are all equal at both ends.
/// Nothing is evaluated outside [0, 1]; polynomials on the last cell are extrapolated as such.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/text/formulas.hpp"
#include "engine/space/space.hpp"

namespace extremal {

struct TypedSpace {
    Space<double> space;
    double sigma = 1;  ///< least pivot
    /// j: H1 distance of tau^j from the space, relative to its norm, j = 0..n; below 1e-20 it is in it.
    std::vector<double> distance;
    bool usesHundredDigits = false;
};

/// The formulas of a scene's keys: functions, let, and "h" where the step is known (withStep). Keys are
/// checked; throws InvalidScene where a text is wrong all the same.
Formulas formulasOf(const Settings& space);
/// Cells of a space: 0, its knots, 1; only 0 and 1 where it has none. Throws InvalidScene where they are not
/// ascending inside (0, 1).
std::vector<double> cellsOf(const Settings& space);

/// Whether the functions of a space change with the step (they name h).
bool dependsOnStep(const Settings& space);
/// The keys with the step in them, for a space that depends on it; else as they are.
Settings withStep(const Settings& space, double step);

/// Keys checked and complete, and with the step where they depend on it.
TypedSpace typedSpace(const Settings& space);

}  // namespace extremal
