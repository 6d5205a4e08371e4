// SPDX-License-Identifier: GPL-3.0-or-later
/// The file of a ring that moves with a scheme: "t,point", its place in the plane of the ring, whose
/// coordinates the header names, and "loop", the integral over the ring; a row for each point of each frame.
#pragma once

#include <functional>
#include <string>

#include "engine/model/system.hpp"
#include "engine/run/products.hpp"

namespace extremal {

/// Hands the text over in blocks.
void writeRings(const MovedRings& rings, const System& system,
                const std::function<void(const std::string& block)>& sink);

}  // namespace extremal
