// SPDX-License-Identifier: GPL-3.0-or-later
/// A scheme on its scene as one program that needs nothing of Extremal: the table of the scheme, the
/// equations of the system from its symbolic Lagrangian, and a test of itself against the CSV of a run.
///
/// Systems: typed Lagrangians, and models that say theirs (ModelEntry::lagrangian). Schemes: Galerkin schemes
/// with one space and one rule, and what has a Runge-Kutta tableau with a fixed step; compositions of them.
/// Implicit steps are solved by Newton's method with exact derivatives, explicit ones directly.
#pragma once

#include <cstddef>
#include <string>

#include "engine/scene/resolve.hpp"

namespace extremal {

enum class ProgramLanguage { cpp, python };

/// Throws InvalidScene where the system or the scheme cannot be taken along, with the reason.
std::string programOf(const ResolvedScene& scene, std::size_t scheme, ProgramLanguage language);

}  // namespace extremal
