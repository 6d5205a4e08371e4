// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps that end where an event switches a parameter of the model, and go on with the other value.
///
/// The place is the end of a step of the scheme itself (event_search.hpp); where it has none, as a scheme
/// with a memory has none, it is that of its dense output. What goes on from there is the same scheme for
/// another system, begun anew: places and momenta are the same on both sides, as a jump of L by time alone
/// does not kick; on constraints momenta are projected, and places that miss them end the run. On a fixed
/// grid a step consists of as many pieces as it needs and ends at its node; under error control each piece
/// is a step. Which setting a motion is in is not part of its State: it is of the integrator, and begin()
/// goes back to the first one.
///
/// More than a thousand switches in a step end the run as `accumulation`. Variations are not known across a
/// switch: there is no tangent map.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/family/parts/parameter_switching.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

/// The parameters that events of a scene switch, and the systems that come of it.
class SwitchableSystems {
public:
    struct Switch {
        std::size_t event;  ///< of the scene
        EventSpec spec;
        std::size_t parameter;  ///< of those that are switched
    };
    /// Of each parameter that is switched: its value, or nothing while it has that of the model.
    using Setting = std::vector<std::optional<double>>;

    explicit SwitchableSystems(const Scene& scene);

    const std::vector<Switch>& all() const { return all_; }
    /// The events with the values of a setting in them.
    std::vector<EventSpec> events(const Setting& setting) const;
    Setting first() const { return Setting(parameters_.size()); }
    /// Throws InvalidScene where there is no such system.
    std::shared_ptr<const System> system(const Setting& setting) const;

private:
    EventSpec withSetting(EventSpec event, const Setting& setting) const;

    Scene scene_;  ///< model and events alone
    std::vector<std::string> parameters_;
    std::vector<Switch> all_;
};

/// The integrator of a system of the first setting, from a state.
std::unique_ptr<Integrator> makeSwitchedStep(std::shared_ptr<const SwitchableSystems> systems,
                                             const System& first, const State& start, MakeFrom make);

}  // namespace extremal
