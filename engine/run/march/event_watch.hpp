// SPDX-License-Identifier: GPL-3.0-or-later
/// Looks for the events of a scene in every step, on its dense output (scene/event_search.hpp).
///
/// Events that a step has in common are in the order of their times; one that stops the run ends the motion
/// there, and what comes later in the step has not happened. The place where a run stops is that of a step of
/// the scheme itself, whose length is found so that the event is at its end: the dense output is of a lower
/// order. Events that reflect are impacts of the walls that they are (scene/reflections.hpp), and those that
/// switch a parameter are found by the integrator (scene/switched_step.hpp).
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/family/parts/parameter_switching.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/run/comparison.hpp"
#include "engine/run/march/found_events.hpp"
#include "engine/scene/event_search.hpp"

namespace extremal {

class EventWatch {
public:
    /// The scheme alone, with nothing that was done yet; it may not exist for steps of other lengths.
    using MakeScheme = std::function<std::unique_ptr<Integrator>(const System& system, const State& start)>;

    /// Writes into the product of the result. `switching`: of the run, where its parameters are switched.
    EventWatch(SchemeResult& result, const Scene& scene, const System& system, MakeScheme make,
               const SwitchesParameters* switching);

    void start(const State& state);
    /// Where the run is to stop, in which part of the step; none: it goes on.
    struct Stop {
        double tau;
        State state;
        /// Of the step of the scheme itself that ends there; empty where it is a place of the dense output.
        std::optional<StepReport> report = {};
        std::vector<double> quantities = {};

        /// As many as the run measures: those of the step that ends there, or nothing that is known, as the
        /// whole step says nothing of its part.
        std::vector<double> quantitiesFor(const std::vector<double>& ofWholeStep) const {
            if (report && quantities.size() == ofWholeStep.size()) return quantities;
            return std::vector<double>(ofWholeStep.size(), std::numeric_limits<double>::quiet_NaN());
        }
        template <class Archive>
        void checkpoint(Archive& archive) {
            archive(tau, state, report, quantities);
        }
    };
    std::optional<Stop> look(const Integrator& integrator, const State& before, const State& after);
    void checkpoint(Archive& archive) { archive(search_, at_.x); }

private:
    struct Met {
        double tau;
        std::size_t event;
        bool isUpwards;
        MetEvent sought;  ///< as the search has it
    };
    void findImpacts(const Integrator& integrator, const State& before, const State& after);
    /// Parameters of the expressions and the system, as they are at the end of a step.
    void followSwitches(const State& at);
    std::span<const ParameterSwitch> switches() const {
        return switching_ ? switching_->switches() : std::span<const ParameterSwitch>();
    }
    Stop stopAt(const Integrator& integrator, const State& before, const State& after, const Met& met);
    void record(const State& at, const Met& met);

    SchemeResult& result_;
    MakeScheme make_;
    const SwitchesParameters* switching_;
    std::size_t width_;
    std::vector<int> wallOf_;           ///< of each event: the wall that it is; -1: it is not one
    std::vector<EventSpec> sought_;     ///< those searched for, with present values of parameters
    std::vector<std::size_t> eventOf_;  ///< their places among all
    EventSearch search_;
    std::shared_ptr<const System> system_;  ///< that moves it now
    std::vector<MetEvent> found_;
    std::vector<Met> met_;
    State at_;
};

}  // namespace extremal
