/// Which points of a sweep are worth their cost: no other has a smaller error for no more CPU time, or the
/// same for less.
#pragma once

#include <utility>
#include <vector>

#include "engine/study/sweep.hpp"

namespace extremal {

/// One flag per row; false where error or time is not known.
std::vector<bool> paretoFront(const std::vector<SweepRow>& rows);

/// Those of points (CPU seconds, error) that are worth their cost, from the cheapest to the most accurate.
std::vector<std::pair<double, double>> paretoFront(std::vector<std::pair<double, double>> points);

}  // namespace extremal
