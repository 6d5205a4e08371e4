// SPDX-License-Identifier: GPL-3.0-or-later
/// The keys of "model" of type "lagrangian" and what they mean.
///
/// Errors: InvalidScene with pointers below /model ("/coordinates/1", "/parameters/pi", "/lagrangian"); what
/// is wrong inside the formula is shown with a caret under the place.
#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::typed {

/// Checks the names.
Formula formulaOf(const Settings& settings);

/// Mechanics of a regular Lagrangian.
TypedMechanics mechanicsOf(const Formula& formula);

/// What an editor shows beside a formula while it is typed.
struct Examination {
    std::optional<std::size_t> position;  ///< the byte where something is wrong
    std::vector<std::string> equations;   ///< rich text, one line per coordinate; empty if something is wrong
    bool isComplete = false;              ///< false: a stop was requested
};
/// What is found is remembered, so that reading a scene with the same formula is then fast, whatever it says.
Examination examine(const Formula& formula, const std::stop_token& stop);

}  // namespace extremal::typed
