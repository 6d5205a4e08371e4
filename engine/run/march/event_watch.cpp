// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/event_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/run/march/inside_step.hpp"

namespace extremal {

EventWatch::EventWatch(SchemeResult& result, const Scene& scene, const System& system, MakeScheme make)
    : result_(result), make_(std::move(make)), rule_(gauss<double>(6)) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    found.rows.columns = leadingColumns(system);
    width_ = found.rows.columns.size() - 1;
    found.rows.columns.push_back({"event", "", "", {}, {}});
    found.rows.columns.push_back({"direction", "", "", {}, {}});
    const auto isReflecting = [](const EventSpec& spec) { return spec.action == EventSpec::Action::reflect; };
    // They are the last of the walls.
    const Wall* const walls = system.parts.find<Wall>();
    int wall = (walls ? walls->count() : 0) -
               static_cast<int>(std::count_if(scene.events.begin(), scene.events.end(), isReflecting));
    for (const EventSpec& spec : scene.events) {
        found.all.push_back({spec});
        functions_.emplace_back(spec, system);
        wallOf_.push_back(isReflecting(spec) ? wall++ : -1);
        integrals_.emplace_back(functions_.back().integrands().size());
    }
    last_.resize(functions_.size());
}

void EventWatch::start(const State& state) {
    at_ = state;
    for (std::size_t e = 0; e < functions_.size(); ++e) {
        std::fill(integrals_[e].begin(), integrals_[e].end(), 0.0);
        integralsNow_ = integrals_[e];
        last_[e] = valueAt(e, state.t, state.x.data());
    }
}

template <class Curve>
void EventWatch::integrate(std::size_t event, double start, double length, double tau, const Curve& curve) {
    integralsNow_ = integrals_[event];
    const std::vector<EventFunction>& integrands = functions_[event].integrands();
    for (std::size_t i = 0; i < rule_.c.size() && !integrands.empty(); ++i) {
        const double place = tau * rule_.c[i];
        const double* const x = curve(place);
        for (std::size_t k = 0; k < integrands.size(); ++k)
            integralsNow_[k] += tau * length * rule_.b[i] * integrands[k](start + place * length, x);
    }
}

std::optional<EventWatch::Stop> EventWatch::look(const Integrator& integrator, const State& before,
                                                 const State& after) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    met_.clear();
    samples_.begin(integrator, after.x.size());
    for (std::size_t e = 0; e < functions_.size(); ++e)
        if (wallOf_[e] < 0) findZeros(e, before, after);
    findImpacts(integrator, before, after);
    std::stable_sort(met_.begin(), met_.end(), [](const Met& a, const Met& b) { return a.tau < b.tau; });
    for (const Met& met : met_) {
        if (found.all[met.event].spec.action == EventSpec::Action::stop) {
            found.stoppedBy = static_cast<int>(met.event);
            return stopAt(integrator, before, after, met);
        }
        at_.t = met.tau == 1 ? after.t : before.t + met.tau * (after.t - before.t);
        at_.x.resize(after.x.size());
        integrator.denseOutput(met.tau, at_.x);
        record(at_, met);
    }
    return {};
}

void EventWatch::findZeros(std::size_t event, const State& before, const State& after) {
    const FoundEvents& found = *result_.products.find<FoundEvents>();
    const double length = after.t - before.t;
    const auto curve = [&](double tau) { return samples_.at(tau); };
    integrate(event, before.t, length, 1, curve);
    const Values atEnd = integralsNow_;
    const double first = last_[event], last = valueAt(event, after.t, after.x.data());
    const double noise = roundingOf(functions_[event].parts());
    const auto wanted = found.all[event].spec.direction;
    const auto value = [&](double tau) {
        integrate(event, before.t, length, tau, curve);
        return valueAt(event, tau == 1 ? after.t : before.t + tau * length, samples_.at(tau));
    };
    for (const Crossing& crossing : finder_.find(first, last, samples_.places(), value, noise))
        if (wanted != (crossing.isUpwards ? EventSpec::Direction::down : EventSpec::Direction::up))
            met_.push_back({crossing.tau, event, crossing.isUpwards});
    last_[event] = last;
    integrals_[event] = atEnd;
}

void EventWatch::findImpacts(const Integrator& integrator, const State& before, const State& after) {
    for (const Impact& impact : integrator.impacts()) {
        const auto event = std::find(wallOf_.begin(), wallOf_.end(), impact.wall);
        if (event == wallOf_.end()) continue;
        const auto e = static_cast<std::size_t>(event - wallOf_.begin());
        const bool isUpwards =
            result_.products.find<FoundEvents>()->all[e].spec.direction == EventSpec::Direction::up;
        met_.push_back({(impact.t - before.t) / (after.t - before.t), e, isUpwards});
    }
}

EventWatch::Stop EventWatch::stopAt(const Integrator& integrator, const State& before, const State& after,
                                    const Met& found) {
    Met met = found;
    const double h = after.t - before.t;
    std::optional<Stop> own;
    if (integrator.grid() == TimeGrid::fixed && met.tau < 1) own = ownStep(before, h, met);
    Stop stop{met.tau, after};
    if (own) {
        stop = *std::move(own);
    } else if (met.tau < 1) {
        stop.state.t = before.t + met.tau * h;
        integrator.denseOutput(met.tau, stop.state.x);
    }
    record(stop.state, met);
    return stop;
}

std::optional<EventWatch::Stop> EventWatch::ownStep(const State& before, double h, Met& met) {
    constexpr int mostIterations = 30;
    // The integrals up to the beginning of the step: look() has gone on to its end.
    const std::size_t e = met.event;
    Values atEnd = integrals_[e], own = atEnd;
    integrate(e, before.t, h, 1, [&](double tau) { return samples_.at(tau); });
    for (std::size_t k = 0; k < own.size(); ++k) own[k] -= integralsNow_[k] - integrals_[e][k];
    std::swap(integrals_[e], own);
    State start = before;
    start.memory.clear();
    std::optional<Stop> found;
    try {
        const auto scheme = make_(start);
        if (scheme->grid() == TimeGrid::fixed && scheme->memoryParts().empty()) {
            State s;
            StepReport report;
            std::vector<double> inside(before.x.size());
            // The value at the end of a step of the length tau h.
            const auto value = [&](double tau) {
                s = start;
                scheme->setStep(tau * h);
                scheme->begin(s);
                report = scheme->advance(s, start.t + tau * h);
                if (report.outcome != Outcome::converged) return std::nan("");
                integrate(e, start.t, tau * h, 1, [&](double part) {
                    scheme->denseOutput(part, inside);
                    return inside.data();
                });
                return valueAt(e, s.t, s.x.data());
            };
            double last = met.tau, lastValue = value(last);
            double tau = last < 0.5 ? last * (1 + 1e-5) : last * (1 - 1e-5);
            for (int i = 0; i < mostIterations && std::abs(tau - last) > 4e-16 * tau; ++i) {
                const double now = value(tau), next = tau - now * (tau - last) / (now - lastValue);
                const bool isFlat = now == 0 || now == lastValue;  // round-off is left
                lastValue = now;
                last = tau;
                if (isFlat) break;
                tau = next > 0 && next < 1.5 ? next : std::nan("");
            }
            // Only where it is the event that was found.
            if (std::abs(tau - last) < 1e-10 && std::abs(tau - met.tau) < 0.1 && std::isfinite(value(tau))) {
                met.tau = std::min(tau, 1.0);
                found = Stop{met.tau, s, report, std::vector<double>(scheme->quantities().size())};
                scheme->measure(s, found->quantities.data());
            }
        }
    } catch (const InvalidScene&) {
        // The scheme does not exist for steps of that length.
    }
    std::swap(integrals_[e], own);
    return found;
}

void EventWatch::record(const State& at, const Met& met) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    FoundEvents::Event& event = found.all[met.event];
    if (++event.count == 1) event.first = at.t;
    event.last = at.t;
    if (event.spec.action == EventSpec::Action::count) return;
    if (found.rows.rows() >= FoundEvents::mostRows) {
        found.isCut = true;
        return;
    }
    auto& columns = found.rows.columns;
    appendState(found.rows, at.t, at.x, width_);
    columns[width_ + 1].values.push_back(static_cast<double>(met.event));
    columns[width_ + 2].values.push_back(met.isUpwards ? 1 : -1);
}

}  // namespace extremal
