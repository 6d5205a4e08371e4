// SPDX-License-Identifier: GPL-3.0-or-later
/// The events of a run as a file, as numbers of its summary, and in words.
#pragma once

#include <string>

#include "engine/core/value.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

/// event,direction,t and the state; one row per event, in the order of the motion. Those that are counted
/// alone are not in it.
std::string eventsCsv(const FoundEvents& found);

/// [{"event", "action", "count", "first", "last"}]
Value eventsValue(const FoundEvents& found);

/// "theta: 12; stopped by r at t = 3.21"; empty where the scene has none.
std::string eventsText(const SchemeResult& result);

}  // namespace extremal
