// SPDX-License-Identifier: GPL-3.0-or-later
/// The lines of a sweep in the log of a study:
///
///     {"extremal": 1, "study": "convergence", "options": {..}, "scene": "<fingerprint>"}
///     point,<index>,<status>,<cause>,<failed_at>,<error>,<steps>,<iterations>,<evaluations>,<linear solves>,
///           <rejected>,<cpu_seconds>,<cpu_spread>,<predicted>,<step>,<tolerance>,
///           <degree>,<nodes>,<work without reduction>,<times the cheapest>,<excess>,<floor>,
///           <confirmed at>,<floor of>,<reason>,<errors of joint wishes, with blanks between them>,
///           <scheme of a ladder>
///     reference,<type>,<estimated_error>,<size of what the metric measures>
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "engine/core/value.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

/// What the points of a study depend on, but for the scene: as JSON, and back. Shard and threads are not in
/// it.
Value optionsValue(const SweepOptions& options);
SweepOptions optionsOf(const Value& value);

/// The head of the log.
std::string headOf(const std::string& study, const Sweep& sweep);
/// Takes a line over into the sweep; the index of its point, none of other lines. Throws InvalidScene where
/// the point is known already, and differs in anything but its times.
std::optional<std::size_t> takeLine(const std::string& line, Sweep& sweep);
/// Runs it, with a line for everything that becomes known.
void runLines(Sweep& sweep, const std::function<void(const std::string&)>& onLine,
              const std::stop_token& stop);

}  // namespace extremal
