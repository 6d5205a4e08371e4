// SPDX-License-Identifier: GPL-3.0-or-later
/// When the result of a scheme still holds after the scene has changed.
///
/// A result depends on the problem (model, initial data, times, reference, what is observed and written), on
/// the scheme and its step, and on what the views need from inside its steps. It does not depend on its name,
/// its place, its colour, the other schemes, or the plots of what it has already.
#pragma once

#include <memory>

#include "engine/run/comparison.hpp"

namespace extremal {

/// Whether a run of a scheme of one scene computes all that a run of a scheme of another one does, the same
/// way.
bool coversRun(const Scene& scene, const SchemeSpec& scheme, const Scene& wanted,
               const SchemeSpec& wantedScheme);

/// A result under the name and style of a scheme that it holds for; the same object where nothing differs.
std::shared_ptr<const SchemeResult> resultFor(const std::shared_ptr<const SchemeResult>& result,
                                              const SchemeSpec& scheme, int style);

}  // namespace extremal
