// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families some of whose spaces belong to a model in place of the system.
#pragma once

#include <string>

#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// What a discretization has in place of the system ("rod"); empty where it is the system itself. Without it
/// all of them are. The error of the model is a floor of its own.
struct ModelInPlace {
    static constexpr PartInfo part{"model-in-place", "models in place of systems", false};
    std::string (*title)(const Discretization&, const System&) = nullptr;
};

}  // namespace extremal
