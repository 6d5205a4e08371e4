// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of a typed model with sums and names by index (core/text/indexed.hpp) written out:
///     "coordinates": ["x[1..n]", "y[1..n]"],  "lagrangian": "sum(i, 1..n, m/2*(x[i]_t^2 + y[i]_t^2))",
///     "constraints": {"rod[i=2..n]": "(x[i]-x[i-1])^2 + (y[i]-y[i-1])^2 - l^2"}
/// stand for 2 n coordinates and n - 1 constraints; forces, rolling conditions, walls, factors of a product
/// of groups and spheres by index likewise.
#pragma once

#include "engine/core/settings.hpp"
#include "engine/core/text/indexed.hpp"

namespace extremal::typed {

/// Whether a key has an index in it.
bool hasIndices(const Settings& settings);
/// Those without are returned as they are. Throws InvalidScene with pointers below /model.
Settings writtenOut(const Settings& settings);
/// The same of initial data by name: {"g": {"body[i=1..n]": {"exp": ["0.1*i", 0, 0]}}}. Pointers below
/// /initial.
Settings startWrittenOut(const Settings& initial, const NamedNumbers& parameters);

}  // namespace extremal::typed
