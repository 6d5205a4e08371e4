// SPDX-License-Identifier: GPL-3.0-or-later
/// A scheme on its scene as one program that needs nothing of Extremal: the table of the scheme, the
/// equations of the system from its symbolic Lagrangian, and a test of itself against the CSV of a run.
///
/// Systems: typed Lagrangians, and models that say theirs (ModelEntry::lagrangian). Schemes: Galerkin schemes
/// with one space and one rule, and what has a Runge-Kutta tableau with a fixed step; compositions of them.
/// Implicit steps are solved by Newton's method with exact derivatives, explicit ones directly.
///
/// The program also has the derivative of the state at its end by numbers of the scene: columns dx/dmu that
/// each step moves along with the derivative of its own equations, K dY = -(rx dx + rm dmu), exact for the
/// discrete motion as those of `extremal gradient`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal {

enum class ProgramLanguage { cpp, python };

/// `with`: pointers to the numbers of the derivative, at most 32; none: the parameters and initial values of
/// the scene. Throws InvalidScene where the system or the scheme cannot be taken along, with the reason, and
/// ("--with", "--scheme") where there is no such derivative.
std::string programOf(const ResolvedScene& scene, std::size_t scheme, ProgramLanguage language,
                      const std::vector<std::string>& with = {});

}  // namespace extremal
