// SPDX-License-Identifier: GPL-3.0-or-later
/// A parameter of a model that took another value inside a step, as the step reports it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "engine/core/state.hpp"

namespace extremal {

struct System;

struct ParameterSwitch {
    std::size_t event = 0;                      ///< of the scene: its place among all
    bool isUpwards = true;                      ///< how its expression passed zero
    double tau = 0;                             ///< where in the step
    State state;                                ///< there, as the motion goes on
    std::string parameter;                      ///< its name
    double value = 0;                           ///< from there on
    std::shared_ptr<const System> system = {};  ///< what moves it from there on
};

}  // namespace extremal
