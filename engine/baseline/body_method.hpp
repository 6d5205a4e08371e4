// SPDX-License-Identifier: GPL-3.0-or-later
/// Baselines of rigid bodies: step/body_method.hpp, and a key of those on quaternions.
#pragma once

#include "engine/baseline/catalog.hpp"
#include "engine/step/body_method.hpp"

namespace extremal {

inline FieldInfo projectionField() {
    return flagField("projection", true, "Bring the quaternion back to length 1 after each step.");
}

}  // namespace extremal
