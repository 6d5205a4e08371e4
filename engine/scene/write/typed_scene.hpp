// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene with its model as a typed Lagrangian: the same motion, to be edited as formulas.
///
/// Models that write one (model/parts/written_form.hpp), and built-in ones that say their Lagrangian.
#pragma once

#include <optional>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// The keys of a typed model: of the scene where it is typed, be it as a Lagrangian, a Hamiltonian, a
/// one-form or a bracket, else of the Lagrangian that its model writes or says; none where it says none.
std::optional<Settings> typedModel(const ResolvedScene& resolved);

/// The document of the scene. Throws InvalidScene where its model says no Lagrangian.
Value typedScene(const ResolvedScene& resolved);

}  // namespace extremal
