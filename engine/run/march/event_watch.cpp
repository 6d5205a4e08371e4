// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/event_watch.hpp"

#include <algorithm>
#include <cmath>

#include "engine/run/march/inside_step.hpp"

namespace extremal {

EventWatch::EventWatch(SchemeResult& result, const Scene& scene, const System& system) : result_(result) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    found.rows.columns = leadingColumns(system);
    width_ = found.rows.columns.size() - 1;
    found.rows.columns.push_back({"event", "", "", {}, {}});
    found.rows.columns.push_back({"direction", "", "", {}, {}});
    for (const EventSpec& spec : scene.events) {
        found.all.push_back({spec});
        functions_.emplace_back(spec, system);
    }
    last_.resize(functions_.size());
}

void EventWatch::start(const State& state) {
    at_ = state;
    for (std::size_t e = 0; e < functions_.size(); ++e) last_[e] = valueAt(e, state.t, state.x.data());
}

std::optional<double> EventWatch::look(const Integrator& integrator, const State& before,
                                       const State& after) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    const auto timeAt = [&](double tau) {
        return tau == 1 ? after.t : before.t + tau * (after.t - before.t);
    };
    met_.clear();
    samples_.begin(integrator, after.x.size());
    for (std::size_t e = 0; e < functions_.size(); ++e) {
        const double first = last_[e], last = valueAt(e, after.t, after.x.data());
        const double noise = roundingOf(functions_[e].parts());
        last_[e] = last;
        const auto wanted = found.all[e].spec.direction;
        const auto value = [&](double tau) { return valueAt(e, timeAt(tau), samples_.at(tau)); };
        for (const Crossing& crossing : finder_.find(first, last, samples_.places(), value, noise))
            if (wanted != (crossing.isUpwards ? EventSpec::Direction::down : EventSpec::Direction::up))
                met_.push_back({crossing.tau, e, crossing.isUpwards});
    }
    std::stable_sort(met_.begin(), met_.end(), [](const Met& a, const Met& b) { return a.tau < b.tau; });
    for (const Met& met : met_) {
        record(integrator, timeAt(met.tau), met);
        if (found.all[met.event].spec.action != EventSpec::Action::stop) continue;
        found.stoppedBy = static_cast<int>(met.event);
        return met.tau;
    }
    return {};
}

void EventWatch::record(const Integrator& integrator, double t, const Met& met) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    FoundEvents::Event& event = found.all[met.event];
    if (++event.count == 1) event.first = t;
    event.last = t;
    if (event.spec.action == EventSpec::Action::count) return;
    if (found.rows.rows() >= FoundEvents::mostRows) {
        found.isCut = true;
        return;
    }
    integrator.denseOutput(met.tau, at_.x);
    auto& columns = found.rows.columns;
    appendState(found.rows, t, at_.x, width_);
    columns[width_ + 1].values.push_back(static_cast<double>(met.event));
    columns[width_ + 2].values.push_back(met.isUpwards ? 1 : -1);
}

}  // namespace extremal
