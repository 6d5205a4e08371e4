// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families with a quadrature rule for each direction.
#pragma once

#include "engine/model/parts.hpp"

namespace extremal {

/// It takes {"space": .., "time": ..} as a quadrature. Other families refuse such a rule.
struct TensorRules {
    static constexpr PartInfo part{"tensor-rules", "a rule for each direction", false};
};

}  // namespace extremal
