// SPDX-License-Identifier: GPL-3.0-or-later
/// A scheme of a scene on the system that has the numbers of interest as coordinates (varied_scene.hpp): its
/// tangent maps are the derivatives of the motion of the scheme by these numbers.
#pragma once

#include <memory>
#include <string>

#include "engine/integrator/integrator.hpp"
#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// Why a scheme cannot be differentiated at all, as "it has ..."; empty: it can.
std::string differentiationProblem(const ResolvedScene& scene, const ResolvedScheme& scheme,
                                   const Integrator& integrator);

struct VariedMotion {
    std::unique_ptr<Integrator> integrator;  ///< null: no parameter is varied
    VariedScene varied;
    State start;          ///< x = (q, u, p, 0)
    std::string problem;  ///< empty: there is none
    std::string place;    ///< what a problem belongs to ("--over"); may be empty
};

/// Which way derivatives are wanted. Backwards, a scheme that can is made on the system without the
/// parameters as coordinates, and is their step all the same (integrator/variation/held_step.hpp).
enum class VariedDirection { forward, backward };

/// `start`: of the scheme, x = (q, p).
VariedMotion variedMotion(const ResolvedScene& scene, const ResolvedScheme& scheme, double step,
                          const State& start, VariedDirection direction, const VariedExtras& extras = {});

}  // namespace extremal
