// SPDX-License-Identifier: GPL-3.0-or-later
/// What to try after a failure, in one or two sentences for the scheme's row.
#pragma once

#include <optional>
#include <string>

#include "engine/core/outcome.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// `step`: signed, as the run takes it. `initial` is the start of the run, `state` the last node that was
/// reached. `undefinedAt`: of a run that is lost since its energy, or another value of the state, is not a
/// number after the next step, the time of that. A step that is advised has been tried: some steps of that
/// length go on from there.
std::string adviceFor(Outcome outcome, const ResolvedScheme& scheme, double step, const System& system,
                      const State& initial, const State& state, std::optional<double> undefinedAt = {});

}  // namespace extremal
