// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of a typed model with sums and names by index (core/text/indexed.hpp) written out:
///     "coordinates": ["x[1..n]", "y[1..n]"],  "lagrangian": "sum(i, 1..n, m/2*(x[i]_t^2 + y[i]_t^2))",
///     "constraints": {"rod[i=2..n]": "(x[i]-x[i-1])^2 + (y[i]-y[i-1])^2 - l^2"}
/// stand for 2 n coordinates and n - 1 constraints; forces, rolling conditions and walls by index likewise.
#pragma once

#include "engine/core/settings.hpp"

namespace extremal::typed {

/// Whether a key has an index in it.
bool hasIndices(const Settings& settings);
/// Those without are returned as they are. Throws InvalidScene with pointers below /model.
Settings writtenOut(const Settings& settings);

}  // namespace extremal::typed
