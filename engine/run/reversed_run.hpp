// SPDX-License-Identifier: GPL-3.0-or-later
/// The way back: a run of the same scheme from its end with the opposite step, which ends at the start to
/// round-off where the scheme is symmetric.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "engine/integrator/integrator.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

/// Whether an observable needs it.
bool wantsWayBack(const std::vector<std::string>& observe);

/// Fills the column "reversibility" at the rows that are nodes, |x_back - x| of the whole state, and its
/// extreme in the summary. `back`: the scheme with the opposite step; `end`: the last node of the run. Rows
/// that the way back does not reach, because a step of it fails, stay unknown.
void addWayBack(SchemeResult& result, Integrator& back, const State& end, const std::stop_token& stop);

/// Of a run backwards: whoever shows it goes from row to row as time goes.
void turnToForwards(SchemeResult& result);

}  // namespace extremal
