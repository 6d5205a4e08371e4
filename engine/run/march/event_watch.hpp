// SPDX-License-Identifier: GPL-3.0-or-later
/// Looks for the events of a scene in every step, on its dense output (integrator/crossing.hpp).
///
/// Events that a step has in common are in the order of their times; one that stops the run ends the motion
/// there, and what comes later in the step has not happened.
#pragma once

#include <optional>
#include <vector>

#include "engine/integrator/crossing.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/run/comparison.hpp"
#include "engine/run/march/found_events.hpp"
#include "engine/scene/event_names.hpp"

namespace extremal {

class EventWatch {
public:
    /// Writes into the product of the result.
    EventWatch(SchemeResult& result, const Scene& scene, const System& system);

    void start(const State& state);
    /// The part of the step at which the run is to stop; none: it goes on.
    std::optional<double> look(const Integrator& integrator, const State& before, const State& after);
    void checkpoint(Archive& archive) { archive(last_, at_.x); }

private:
    struct Met {
        double tau;
        std::size_t event;
        bool isUpwards;
    };
    void record(const Integrator& integrator, double t, const Met& met);
    double valueAt(std::size_t event, double t, const double* x) const { return functions_[event](t, x); }

    SchemeResult& result_;
    std::size_t width_;
    std::vector<EventFunction> functions_;
    std::vector<double> last_;  ///< values at the last node
    StepSamples samples_;
    CrossingFinder finder_;
    std::vector<Met> met_;
    State at_;
};

}  // namespace extremal
