// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/event_watch.hpp"

#include <algorithm>
#include <utility>

#include "engine/model/parts/wall.hpp"
#include "engine/run/march/inside_step.hpp"

namespace extremal {

namespace {

using Action = EventSpec::Action;

bool isReflecting(const EventSpec& spec) { return spec.action == Action::reflect; }

std::vector<EventSpec> soughtOf(const Scene& scene) {
    std::vector<EventSpec> sought;
    for (const EventSpec& spec : scene.events)
        if (!isReflecting(spec) && spec.action != Action::change) sought.push_back(spec);
    return sought;
}

}  // namespace

EventWatch::EventWatch(SchemeResult& result, const Scene& scene, const System& system, MakeScheme make,
                       const SwitchesParameters* switching)
    : result_(result),
      make_(std::move(make)),
      switching_(switching),
      sought_(soughtOf(scene)),
      search_(sought_, system),
      system_(std::make_shared<const System>(system)) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    found.rows.columns = leadingColumns(system);
    width_ = found.rows.columns.size() - 1;
    found.rows.columns.push_back({"event", "", "", {}, {}});
    found.rows.columns.push_back({"direction", "", "", {}, {}});
    // They are the last of the walls.
    const Wall* const walls = system.parts.find<Wall>();
    int wall = (walls ? walls->count() : 0) -
               static_cast<int>(std::count_if(scene.events.begin(), scene.events.end(), isReflecting));
    for (const EventSpec& spec : scene.events) {
        if (!isReflecting(spec) && spec.action != Action::change) eventOf_.push_back(found.all.size());
        found.all.push_back({spec});
        wallOf_.push_back(isReflecting(spec) ? wall++ : -1);
    }
}

void EventWatch::start(const State& state) {
    at_ = state;
    search_.start(state);
}

std::optional<EventWatch::Stop> EventWatch::look(const Integrator& integrator, const State& before,
                                                 const State& after) {
    FoundEvents& found = result_.products.make<FoundEvents>();
    met_.clear();
    found_.clear();
    search_.look(integrator, before, after, found_);
    for (std::size_t i = 0; i < found_.size(); ++i)
        met_.push_back({found_[i].tau, eventOf_[found_[i].event], found_[i].isUpwards, found_[i]});
    findImpacts(integrator, before, after);
    for (const ParameterSwitch& each : switches()) met_.push_back({each.tau, each.event, each.isUpwards, {}});
    std::stable_sort(met_.begin(), met_.end(), [](const Met& a, const Met& b) { return a.tau < b.tau; });
    for (const Met& met : met_) {
        if (found.all[met.event].spec.action == Action::stop) {
            found.stoppedBy = static_cast<int>(met.event);
            return stopAt(integrator, before, after, met);
        }
        at_.t = met.tau == 1 ? after.t : before.t + met.tau * (after.t - before.t);
        at_.x.resize(after.x.size());
        integrator.denseOutput(met.tau, at_.x);
        record(at_, met);
    }
    followSwitches(after);
    return {};
}

void EventWatch::followSwitches(const State& at) {
    if (switches().empty()) return;
    for (const ParameterSwitch& each : switches()) {
        for (EventSpec& event : sought_) event.setParameter(each.parameter, each.value);
        system_ = each.system;
    }
    search_.goOnWith(sought_, *system_, at);
}

void EventWatch::findImpacts(const Integrator& integrator, const State& before, const State& after) {
    for (const Impact& impact : integrator.impacts()) {
        const auto event = std::find(wallOf_.begin(), wallOf_.end(), impact.wall);
        if (event == wallOf_.end()) continue;
        const auto e = static_cast<std::size_t>(event - wallOf_.begin());
        const bool isUpwards =
            result_.products.find<FoundEvents>()->all[e].spec.direction == EventSpec::Direction::up;
        met_.push_back({(impact.t - before.t) / (after.t - before.t), e, isUpwards, {}});
    }
}

EventWatch::Stop EventWatch::stopAt(const Integrator& integrator, const State& before, const State& after,
                                    const Met& met) {
    const double h = after.t - before.t;
    // Where the motion that meets it began, and what moves it.
    State from = before;
    MetEvent sought = met.sought;
    bool isSwitched = false;
    for (const ParameterSwitch& each : switches())
        if (each.tau <= met.tau) {
            from = each.state;
            system_ = each.system;
            isSwitched = true;
        }
    Met at = met;
    Stop stop{met.tau, after};
    std::optional<EventLanding> own;
    if (met.tau < 1 && !isSwitched) {
        search_.takeBack();
        own = search_.landOn(make_(*system_, from), from, h, sought);
    }
    if (own) {
        at.tau = stop.tau = sought.tau;
        stop = {sought.tau, std::move(own->state), own->report, std::move(own->quantities)};
    } else if (met.tau < 1) {
        stop.state.t = before.t + met.tau * h;
        integrator.denseOutput(met.tau, stop.state.x);
    }
    record(stop.state, at);
    return stop;
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
