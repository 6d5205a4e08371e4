// SPDX-License-Identifier: GPL-3.0-or-later
/// A figure as a few lines of text, for tests: titles, ranges, and per series its length, extremes and a
/// hash.
///
/// Values are rounded to 9 digits relative to the largest of their series, so that the text does not change
/// with the last bits of another machine.
#pragma once

#include <string>

#include "engine/figure/figure.hpp"

namespace extremal {

std::string digest(const Figure& figure);

}  // namespace extremal
