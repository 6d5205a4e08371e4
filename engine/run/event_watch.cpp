#include "engine/run/event_watch.hpp"

#include <algorithm>
#include <cmath>

#include "engine/run/crossing.hpp"
#include "engine/run/inside_step.hpp"

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
    found_.clear();
    for (std::size_t e = 0; e < functions_.size(); ++e) {
        const double first = last_[e], last = valueAt(e, after.t, after.x.data());
        last_[e] = last;
        const bool isUpwards = passesUpwards(first, last), isDownwards = passesDownwards(first, last);
        const auto wanted = found.all[e].spec.direction;
        if (!(isUpwards && wanted != EventSpec::Direction::down) &&
            !(isDownwards && wanted != EventSpec::Direction::up))
            continue;
        const double tau = crossingOf(last, [&](double part) {
            integrator.denseOutput(part, at_.x);
            return valueAt(e, timeAt(part), at_.x.data());
        });
        found_.push_back({tau, e, isUpwards});
    }
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Crossing& a, const Crossing& b) { return a.tau < b.tau; });
    for (const Crossing& crossing : found_) {
        FoundEvents::Event& event = found.all[crossing.event];
        const double t = timeAt(crossing.tau);
        if (++event.count == 1) event.first = t;
        event.last = t;
        const bool hasRoom = found.rows.rows() < FoundEvents::mostRows;
        if (event.spec.action != EventSpec::Action::count && hasRoom) {
            integrator.denseOutput(crossing.tau, at_.x);
            auto& columns = found.rows.columns;
            appendState(found.rows, t, at_.x, width_);
            columns[width_ + 1].values.push_back(static_cast<double>(crossing.event));
            columns[width_ + 2].values.push_back(crossing.isUpwards ? 1 : -1);
        } else if (event.spec.action != EventSpec::Action::count) {
            found.isCut = true;
        }
        if (event.spec.action != EventSpec::Action::stop) continue;
        found.stoppedBy = static_cast<int>(crossing.event);
        return crossing.tau;
    }
    return {};
}

}  // namespace extremal
