// SPDX-License-Identifier: GPL-3.0-or-later
/// Controls: functions of time by name, that a user types beside a Lagrangian and uses in its formulas.
///
///     "controls": {"u": "sin(t)"}    or    {"u": {"table": [[0, 1], [1, 0]], "interpolation": "linear"}}
///
/// A table has rows (t, u) with ascending t; `interpolation` is linear or cubic (a natural spline), and
/// outside the rows the function goes on as `table` and `spline` do in formulas. Errors: InvalidScene with
/// pointers below /model.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::typed {

/// Those of a model; `formula` has its names.
std::vector<std::pair<std::string, Expression>> controlsOf(const Settings& settings, const Formula& formula);

/// The expression with the controls in place of their names, at the places where these stand.
Expression withControls(Expression expression,
                        const std::vector<std::pair<std::string, Expression>>& controls);

}  // namespace extremal::typed
