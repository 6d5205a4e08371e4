// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/event_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/problem.hpp"

namespace extremal {

EventSearch::EventSearch(const std::vector<EventSpec>& events, const System& system)
    : events_(events), rule_(gauss<double>(6)) {
    for (const EventSpec& event : events) {
        functions_.emplace_back(event, system);
        now_.integrals.emplace_back(functions_.back().integrands().size());
    }
    now_.values.resize(functions_.size());
    sizes_.resize(functions_.size());
}

void EventSearch::start(const State& state) {
    for (std::size_t e = 0; e < functions_.size(); ++e) {
        std::fill(now_.integrals[e].begin(), now_.integrals[e].end(), 0.0);
        integralsNow_ = now_.integrals[e];
        now_.values[e] = valueAt(e, state.t, state.x.data());
        sizes_[e] = std::abs(now_.values[e]);
    }
    before_ = now_;
}

void EventSearch::goOnWith(const std::vector<EventSpec>& events, const System& system, const State& state) {
    constexpr double rounding = 1e-9;  // a landing under error control is no better
    events_ = events;
    for (std::size_t e = 0; e < functions_.size(); ++e) {
        integralsNow_ = now_.integrals[e];
        const double as = valueAt(e, state.t, state.x.data());
        functions_[e] = EventFunction(events[e], system);
        now_.values[e] = valueAt(e, state.t, state.x.data());
        const bool isBehind = now_.values[e] == as && std::abs(as) <= rounding * sizes_[e];
        if (isBehind) now_.values[e] = 0;
    }
}

template <class Curve>
void EventSearch::addIntegrals(std::size_t event, double start, double length, double tau,
                               const Curve& curve) {
    const std::vector<EventFunction>& integrands = functions_[event].integrands();
    for (std::size_t i = 0; i < rule_.c.size() && !integrands.empty(); ++i) {
        const double place = tau * rule_.c[i];
        const double* const x = curve(place);
        for (std::size_t k = 0; k < integrands.size(); ++k)
            integralsNow_[k] += tau * length * rule_.b[i] * integrands[k](start + place * length, x);
    }
}

template <class Curve>
void EventSearch::integrate(std::size_t event, double start, double length, double tau, const Curve& curve) {
    integralsNow_ = now_.integrals[event];
    addIntegrals(event, start, length, tau, curve);
}

void EventSearch::look(const Integrator& integrator, const State& before, const State& after,
                       std::vector<MetEvent>& met) {
    before_ = now_;
    samples_.begin(integrator, after.x.size());
    const double length = after.t - before.t;
    const auto curve = [&](double tau) { return samples_.at(tau); };
    for (std::size_t e = 0; e < functions_.size(); ++e) {
        integrate(e, before.t, length, 1, curve);
        const Values atEnd = integralsNow_;
        const double first = now_.values[e], last = valueAt(e, after.t, after.x.data());
        const double noise = roundingOf(functions_[e].parts());
        const auto value = [&](double tau) {
            integrate(e, before.t, length, tau, curve);
            return valueAt(e, tau == 1 ? after.t : before.t + tau * length, samples_.at(tau));
        };
        for (const Crossing& crossing : finder_.find(first, last, samples_.places(), value, noise)) {
            using Direction = EventSpec::Direction;
            if (events_[e].direction != (crossing.isUpwards ? Direction::down : Direction::up))
                met.push_back({crossing.tau, e, crossing.isUpwards});
        }
        now_.values[e] = last;
        sizes_[e] = std::max({sizes_[e], std::abs(first), std::abs(last)});
        now_.integrals[e] = atEnd;
    }
}

void EventSearch::takeBack() { now_ = before_; }

void EventSearch::goTo(const Integrator& integrator, const State& from, double end, const State& at) {
    samples_.begin(integrator, at.x.size());
    const double length = end - from.t, tau = length != 0 ? (at.t - from.t) / length : 0;
    for (std::size_t e = 0; e < functions_.size(); ++e) {
        integrate(e, from.t, length, tau, [&](double part) { return samples_.at(std::min(part, 1.0)); });
        now_.integrals[e] = integralsNow_;
        now_.values[e] = valueAt(e, at.t, at.x.data());
    }
}

double EventSearch::valueAfter(Trial& trial, double part) {
    trial.end = trial.start;
    const double until = trial.start.t + part * trial.h;
    const bool isFixed = trial.scheme.grid() == TimeGrid::fixed;
    if (isFixed) trial.scheme.setStep(part * trial.h);
    trial.scheme.begin(trial.end);
    integralsNow_ = now_.integrals[trial.event];
    constexpr int mostSteps = 1000;
    for (int step = 0; step < mostSteps; ++step) {
        const double from = trial.from = trial.end.t;
        trial.report = trial.scheme.advance(trial.end, until);
        if (trial.report.outcome != Outcome::converged) break;
        addIntegrals(trial.event, from, trial.end.t - from, 1, [&](double tau) {
            trial.scheme.denseOutput(tau, inside_);
            return inside_.data();
        });
        if (isFixed || !((until - trial.end.t) / trial.h > 0))
            return valueAt(trial.event, trial.end.t, trial.end.x.data());
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// The secant method, to round-off.
double EventSearch::partAtZero(Trial& trial, double part) {
    constexpr int mostIterations = 30;
    double last = part, lastValue = valueAfter(trial, last);
    double next = last < 0.5 ? last * (1 + 1e-5) : last * (1 - 1e-5);
    for (int i = 0; i < mostIterations && std::abs(next - last) > 4e-16 * next; ++i) {
        const double now = valueAfter(trial, next), better = next - now * (next - last) / (now - lastValue);
        const bool isFlat = now == 0 || now == lastValue;  // round-off is left
        lastValue = now;
        last = next;
        if (isFlat) break;
        next = better > 0 && better < 1.5 ? better : std::nan("");
    }
    return std::abs(next - last) < 1e-10 ? next : std::nan("");
}

/// Newton's method with the slope of the dense output: what the code finds varies by its tolerance from one
/// end to the next, so that differences of it tell nothing. Ends where it comes no closer.
double EventSearch::partAtZeroUnderControl(Trial& trial, double part) {
    constexpr int mostIterations = 8;
    constexpr double apart = 1e-4;
    double least = std::numeric_limits<double>::infinity(), best = std::nan("");
    double next = part;
    for (int i = 0; i < mostIterations; ++i) {
        const double now = valueAfter(trial, next);
        if (!(std::abs(now) < least / 2) && i > 0) {
            if (std::abs(now) < least) best = next;
            break;
        }
        least = std::abs(now);
        best = next;
        if (now == 0) break;
        // Along the step that ends there.
        const double from = trial.end.t - apart * trial.h;
        const double length = trial.report.step != 0 ? trial.report.step : next * trial.h;
        if (!(std::abs(apart * trial.h) < std::abs(length))) break;
        const Values whole = integralsNow_;
        trial.scheme.denseOutput(1 - apart * trial.h / length, inside_);
        const double slope = (now - valueAt(trial.event, from, inside_.data())) / apart;
        const double better = next - now / slope;
        if (!(better > 0 && better < 1.5) || std::abs(better - next) < 1e-15) break;
        next = better;
    }
    return best;
}

std::optional<EventLanding> EventSearch::landOn(std::unique_ptr<Integrator> scheme, const State& before,
                                                double h, MetEvent& met) {
    const TimeGrid grid = scheme->grid();
    if (grid == TimeGrid::free || (grid == TimeGrid::fixed && !scheme->memoryParts().empty())) return {};
    State start = before;
    start.memory.clear();
    inside_.resize(before.x.size());
    try {
        Trial trial{*scheme, start, h, met.event};
        const double part =
            grid == TimeGrid::fixed ? partAtZero(trial, met.tau) : partAtZeroUnderControl(trial, met.tau);
        // Only where it is the event that was found.
        if (!(std::abs(part - met.tau) < 0.1) || !std::isfinite(valueAfter(trial, part))) return {};
        met.tau = std::min(part, 1.0);
        EventLanding landing{
            trial.end, trial.report, std::vector<double>(scheme->quantities().size()), {}, trial.from};
        scheme->measure(landing.state, landing.quantities.data());
        landing.scheme = std::move(scheme);
        return landing;
    } catch (const InvalidScene&) {
        return {};  // the scheme does not exist for steps of that length
    }
}

}  // namespace extremal
