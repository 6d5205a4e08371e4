// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems of which a parameter takes another value at an event of the motion.
///
/// Such a system is that of the start, and has this part besides: who makes an integrator for it makes one
/// that goes on with another system after each switch. The part does not bind the motion, as a scheme is
/// asked for the systems between the switches, each of which it takes or refuses.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "engine/core/parameter_switch.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// What integrators of such systems are besides.
class SwitchesParameters {
public:
    virtual ~SwitchesParameters() = default;
    /// The parameters that took another value in the last step, in the order of their times.
    virtual std::span<const ParameterSwitch> switches() const = 0;
};

/// The scheme for a system, from a state.
using MakeFrom = std::function<std::unique_ptr<Integrator>(const System&, const State& start)>;

struct ParameterSwitching {
    static constexpr PartInfo part{"parameter-switching", "a parameter that is switched", false};

    /// The scheme that `make` makes, with steps that end where a parameter is switched (switched_step.hpp).
    std::function<std::unique_ptr<Integrator>(const System& system, const State& start, const MakeFrom& make)>
        integrator;
};

/// What `make` makes of a system, with its switches where it has some.
inline std::unique_ptr<Integrator> withSwitchedParameters(const System& system, const State& start,
                                                          const MakeFrom& make) {
    const auto* const switching = system.parts.find<ParameterSwitching>();
    return switching ? switching->integrator(system, start, make) : make(system, start);
}

}  // namespace extremal
