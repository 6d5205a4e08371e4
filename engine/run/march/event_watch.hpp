// SPDX-License-Identifier: GPL-3.0-or-later
/// Looks for the events of a scene in every step, on its dense output (integrator/crossing.hpp).
///
/// Events that a step has in common are in the order of their times; one that stops the run ends the motion
/// there, and what comes later in the step has not happened. On a fixed grid the place where a run stops is
/// that of a step of the scheme itself, whose length is found so that the event is at its end: the dense
/// output is of a lower order. Integrals in an expression are taken over each step, or the part of one, by
/// Gauss's rule with 6 nodes on the dense output. Events that reflect are impacts of the walls that they are
/// (scene/reflections.hpp).
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "engine/integrator/crossing.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/run/comparison.hpp"
#include "engine/run/march/found_events.hpp"
#include "engine/scene/event_names.hpp"

namespace extremal {

class EventWatch {
public:
    /// The scheme alone, with nothing that was done yet; it may not exist for steps of other lengths.
    using MakeScheme = std::function<std::unique_ptr<Integrator>(const State& start)>;

    /// Writes into the product of the result.
    EventWatch(SchemeResult& result, const Scene& scene, const System& system, MakeScheme make);

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
    void checkpoint(Archive& archive) { archive(last_, at_.x, integrals_); }

private:
    struct Met {
        double tau;
        std::size_t event;
        bool isUpwards;
    };
    using Values = std::vector<double>;
    void findZeros(std::size_t event, const State& before, const State& after);
    void findImpacts(const Integrator& integrator, const State& before, const State& after);
    Stop stopAt(const Integrator& integrator, const State& before, const State& after, const Met& met);
    /// The step of the scheme itself that ends at the event; nothing where it has none.
    std::optional<Stop> ownStep(const State& before, double h, Met& met);
    void record(const State& at, const Met& met);
    double valueAt(std::size_t event, double t, const double* x) const {
        return functions_[event](t, x, integralsNow_);
    }
    /// The integrals of an event up to the part tau of a step, into integralsNow_; `curve(tau)` is the state
    /// there.
    template <class Curve>
    void integrate(std::size_t event, double start, double length, double tau, const Curve& curve);

    SchemeResult& result_;
    MakeScheme make_;
    std::size_t width_;
    std::vector<EventFunction> functions_;
    std::vector<int> wallOf_;        ///< of each event: the wall that it is; -1: it is not one
    Values last_;                    ///< values at the last node
    std::vector<Values> integrals_;  ///< of each event, up to the last node
    Values integralsNow_;
    Rule<double> rule_;
    StepSamples samples_;
    CrossingFinder finder_;
    std::vector<Met> met_;
    State at_;
};

}  // namespace extremal
