// SPDX-License-Identifier: GPL-3.0-or-later
/// Zeros of the expressions of events along the steps of a scheme, on its dense output
/// (integrator/crossing.hpp), and the steps of the scheme itself that end there.
///
/// Integrals in an expression are taken over each step, or the part of one, by Gauss's rule with 6 nodes on
/// the dense output.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "engine/integrator/crossing.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/scene/event_names.hpp"

namespace extremal {

struct MetEvent {
    double tau = 0;         ///< of the step
    std::size_t event = 0;  ///< of those searched for
    bool isUpwards = true;
};

/// What a scheme is at the end of a step of its own that ends at an event.
struct EventLanding {
    State state;
    StepReport report;
    std::vector<double> quantities;
    std::unique_ptr<Integrator> scheme;  ///< with the dense output of its last step
    double from = 0;                     ///< the time at which that step began
};

class EventSearch {
public:
    EventSearch(const std::vector<EventSpec>& events, const System& system);

    std::size_t count() const { return functions_.size(); }
    /// A motion begins here; its integrals are 0.
    void start(const State& state);
    /// The same events of a system in which parameters have other values, at a state of the motion: integrals
    /// go on, and an expression that is zero there, as it was before, has its zero behind it.
    void goOnWith(const std::vector<EventSpec>& events, const System& system, const State& state);
    /// Appends what is met in the step between the states, event by event.
    void look(const Integrator& integrator, const State& before, const State& after,
              std::vector<MetEvent>& met);
    /// Puts the search back to the start of the step that was last looked at.
    void takeBack();
    /// Goes on to a state inside of a step, from `from` to the time `end`, that is not looked at again.
    void goTo(const Integrator& integrator, const State& from, double end, const State& at);

    /// The step, of a part of h, of `scheme` from `before` that ends at an event which look() has found in
    /// the step of length h, and was taken back. `met.tau` becomes that part. Nothing where the scheme has
    /// none: it keeps something in memory, chooses its times itself, or does not find it. Dense output is of
    /// a lower order.
    std::optional<EventLanding> landOn(std::unique_ptr<Integrator> scheme, const State& before, double h,
                                       MetEvent& met);

    void checkpoint(Archive& archive) { archive(now_.values, now_.integrals, sizes_); }

private:
    using Values = std::vector<double>;
    struct Place {
        Values values;                  ///< of the events
        std::vector<Values> integrals;  ///< of each event, up to there
    };
    /// A step of the scheme that ends at a chosen part of h.
    struct Trial {
        Integrator& scheme;
        const State& start;
        double h;
        std::size_t event;
        State end = {};
        StepReport report = {};
        double from = 0;  ///< where the last of its steps began
    };
    double valueAfter(Trial& trial, double part);
    double partAtZero(Trial& trial, double part);
    double partAtZeroUnderControl(Trial& trial, double part);

    double valueAt(std::size_t event, double t, const double* x) const {
        return functions_[event](t, x, integralsNow_);
    }
    /// The integrals of an event up to the part tau of a step, into integralsNow_; `curve(tau)` is the state
    /// there.
    template <class Curve>
    void integrate(std::size_t event, double start, double length, double tau, const Curve& curve);
    template <class Curve>
    void addIntegrals(std::size_t event, double start, double length, double tau, const Curve& curve);

    std::vector<EventSpec> events_;
    std::vector<EventFunction> functions_;
    Place now_, before_;  ///< at the end and at the start of the step last looked at
    Values sizes_;        ///< the largest values of the events at nodes
    Values integralsNow_, inside_;
    Rule<double> rule_;
    StepSamples samples_;
    CrossingFinder finder_;
};

}  // namespace extremal
