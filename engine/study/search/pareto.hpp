// SPDX-License-Identifier: GPL-3.0-or-later
/// Which points of a sweep are worth their cost: no other has a smaller error for no more CPU time, or the
/// same for less.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/study/sweep.hpp"

namespace extremal {

/// Which of points (CPU seconds, error) are worth their cost, from the cheapest to the most accurate; none
/// with a number that is not finite.
std::vector<std::size_t> paretoFront(const std::vector<std::pair<double, double>>& points);

/// One flag per row; false where error or time is not known.
std::vector<bool> paretoFront(const std::vector<SweepRow>& rows);
/// False as well where the error says nothing of the scheme (Sweep::isJudged).
std::vector<bool> paretoFront(const Sweep& sweep);

}  // namespace extremal
