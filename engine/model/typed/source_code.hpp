// SPDX-License-Identifier: GPL-3.0-or-later
/// A typed Lagrangian as lines of a program: its gradient and Hessian by symbolic differentiation, common
/// parts once.
#pragma once

#include <string>
#include <vector>

#include "engine/model/typed/formula.hpp"

namespace extremal::typed {

enum class Language { cpp, python };

/// The body of a function of t, q[i] and v[i] that fills g[i] = dL/dq_i, g[d + i] = dL/dv_i and the lower
/// triangle H[i][j], j <= i (H[i, j] in Python), in the same order. Parameters are named k_NAME, in the order
/// of the formula. Throws ExpressionError.
std::vector<std::string> derivativeLines(const Formula& formula, Language language);

/// The same for derivatives of these by parameters, which may be none: B[i * u + k] (B[i, k] in Python) is
/// dg_i/dk of the u parameters that are named.
std::vector<std::string> parameterLines(const Formula& formula, const std::vector<std::string>& parameters,
                                        Language language);

}  // namespace extremal::typed
