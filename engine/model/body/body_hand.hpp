// SPDX-License-Identifier: GPL-3.0-or-later
/// Rigid bodies moved by hand.
#pragma once

#include "engine/model/parts/by_hand.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// A displacement is a rotation vector in space, then on SE(3) the way of the centre of mass. The angular
/// momentum in the body stays, and so does the linear one in space.
ByHand bodyByHand(const Body& body);

}  // namespace extremal
