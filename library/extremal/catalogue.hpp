// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene may contain, from the same descriptors as `extremal list` and the forms of the window.
#pragma once

#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "extremal/api.hpp"

namespace extremal::api {

/// "models", "spaces", "quadratures", "schemes", "baselines", "compositions", "observables", "studies",
/// "views", "profiles", "presets".
EXTREMAL_API std::vector<std::string> catalogueNames();

/// One of them, as `extremal list NAME --json`: an array of objects with id, title, description, parameters;
/// schemes and baselines also say what they claim. Throws InvalidScene for another name.
EXTREMAL_API Value catalogue(const std::string& name);

}  // namespace extremal::api
