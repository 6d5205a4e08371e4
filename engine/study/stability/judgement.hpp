// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run is worth for somebody who wishes that errors stay below given values: one of seven words.
///
///     right        done, and every value is at most what is wished
///     coarse       done, a value is larger, but below 0.2 of the size of what it measures
///     wrong        done, with an error as large as the motion
///     lost         the run left the motion, and found it out by itself
///     diverged     a step had no solution, or its numbers were not finite
///     refused      it cannot be run, and says so before its first step
///     not judged   the error is below the floor of what the reference can tell, and so is the wish; or there
///                  is nothing to compare with
#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "engine/core/outcome.hpp"
#include "engine/run/comparison.hpp"

namespace extremal {

enum class Judgement { unknown, right, coarse, wrong, lost, diverged, refused, notJudged };
/// "right", "coarse", ..., "not judged"; empty for unknown.
std::string_view name(Judgement judgement);
/// By its name; unknown for anything else.
Judgement judgementOf(std::string_view name);

/// The largest value of a metric in a run.
struct JudgedValue {
    double value = std::numeric_limits<double>::quiet_NaN();
    double wish = 0;
    double size = std::numeric_limits<double>::infinity();  ///< of what it is an error of
    double floor = 0;                                       ///< below it nothing is known
};

/// Unknown of a run that was stopped.
Judgement judge(RunStatus status, Outcome cause, std::span<const JudgedValue> values);

}  // namespace extremal
