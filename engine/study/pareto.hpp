/// Which points of a sweep are worth their cost: no other has a smaller error for no more CPU time, or the
/// same for less.
#pragma once

#include <vector>

#include "engine/study/sweep.hpp"

namespace extremal {

/// One flag per row; false where error or time is not known.
std::vector<bool> paretoFront(const std::vector<SweepRow>& rows);

}  // namespace extremal
