/// The keys of "model" of type "lagrangian" and what they mean.
///
/// Errors: InvalidScene with pointers below /model ("/coordinates/1", "/parameters/pi", "/lagrangian"); what is wrong
/// inside the formula is shown with a caret under the place.
#pragma once

#include "engine/core/settings.hpp"
#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::typed {

/// Checks the names.
Formula formulaOf(const Settings& settings);

/// Mechanics of a regular Lagrangian.
TypedMechanics mechanicsOf(const Formula& formula);

}  // namespace extremal::typed
