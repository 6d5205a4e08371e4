// SPDX-License-Identifier: GPL-3.0-or-later
/// The error that a motion shares with every scheme on its mesh: it is exact for the unknowns of the scene,
/// or computed with them, and does not solve the equation. Set by problems that can be put on another mesh.
#pragma once

#include <functional>
#include <stop_token>

#include "engine/core/settings.hpp"
#include "engine/core/state.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct MeshError {
    static constexpr PartInfo part{"mesh-error", "an error of the mesh", false};
    /// A run from `initial`, with the keys of its initial data as they were given.
    struct Run {
        const Settings& given;
        const State& initial;
        double start, end;
    };
    /// Of the exact motion, which is known.
    std::function<double(const Run& run, const std::stop_token& stop)> ofExact;
    /// Of a computed motion.
    std::function<double(const Run& run, const ExactSolution& motion, const std::stop_token& stop)>
        ofComputed;
};

}  // namespace extremal
