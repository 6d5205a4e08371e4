// SPDX-License-Identifier: GPL-3.0-or-later
/// States of a system as states of another, which is the same on a mesh with other nodes.
#pragma once

#include <functional>

#include "engine/model/parts.hpp"

namespace extremal {

struct System;

/// Set by systems whose state is not the values at their nodes, so that System::at does not tell. Without it
/// schemes on a mesh of their own are compared with what is known at all places.
struct OnOtherMesh {
    static constexpr PartInfo part{"on-other-mesh", "states on other meshes", false};
    /// Writes the state of the other system that has the values of x at its nodes.
    using Map = std::function<void(const double* x, double* other)>;
    std::function<Map(const System& other)> to;
};

}  // namespace extremal
