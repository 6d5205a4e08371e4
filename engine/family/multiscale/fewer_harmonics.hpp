// SPDX-License-Identifier: GPL-3.0-or-later
/// What an oscillatory space can leave out: harmonics, degrees of their amplitudes, degrees of the slow part.
#pragma once

#include <string>
#include <vector>

#include "engine/family/parts/smaller_spaces.hpp"

namespace extremal {

/// With the last harmonics left out down to one, their amplitudes as they are or one degree lower, and slow
/// parts up to two degrees lower, from the most functions down. Empty of spaces without harmonics, and of
/// those whose harmonics are combinations of two frequencies.
std::vector<SmallerSpace> fewerHarmonics(const Settings& space, const Settings& model);
/// "degree 5, 2 on the fast coordinates, harmonics of degrees 2, 1".
std::string textOfHarmonics(const Settings& space);

}  // namespace extremal
