// SPDX-License-Identifier: GPL-3.0-or-later
/// How far a step is from keeping the form of phase spaces that are not those of coordinates: of one-forms,
/// of brackets, of groups given as data, of points and of spins on spheres.
#pragma once

#include <optional>

#include "tests/laws/claims.hpp"

namespace extremal::laws {

/// Of a step of time / each from the start, not a number where it fails; nothing where the phase space is
/// another.
std::optional<double> ownFormDefect(const Trial& trial, double each);

}  // namespace extremal::laws
