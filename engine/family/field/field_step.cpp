// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/field_step.hpp"

#include <array>

namespace extremal {

std::span<const Quantity> FieldStep::quantities() const {
    static const std::array<Quantity, 1> all{{{"discrete_energy", "discrete energy", "E_d", ""}}};
    return all;
}

}  // namespace extremal
