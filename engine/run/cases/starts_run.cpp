// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/cases/starts_run.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/core/library_exceptions.hpp"
#include "engine/core/problem.hpp"
#include "engine/integrator/crossing.hpp"
#include "engine/integrator/variation/with_variations.hpp"
#include "engine/mechanism/tangent_space.hpp"
#include "engine/run/march/inside_step.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/plane_start.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

using Known = std::shared_ptr<const Orbit>;

/// What was computed before, by all that it depends on.
class OrbitMemory {
public:
    Known find(const std::string& key, const std::vector<double>& start) const {
        const std::lock_guard lock(mutex_);
        const auto found = known_.find(key);
        if (found == known_.end()) return {};
        const auto orbit = found->second.find(start);
        return orbit == found->second.end() ? Known() : orbit->second;
    }
    void keep(const std::string& key, const Known& orbit) {
        constexpr std::size_t most = 4'000'000;  // points
        const std::lock_guard lock(mutex_);
        points_ += orbit->points.rows();
        if (points_ > most) {
            known_.clear();
            points_ = orbit->points.rows();
        }
        known_[key][orbit->start] = orbit;
    }

private:
    mutable std::mutex mutex_;
    std::map<std::string, std::map<std::vector<double>, Known>> known_;
    std::size_t points_ = 0;
};

OrbitMemory& orbitMemory() {
    static OrbitMemory memory;
    return memory;
}

std::string keyOf(const Scene& scene, std::size_t scheme, const ViewPlane& plane, std::size_t points) {
    const Value document = toValue(scene);
    Value own = document.find("schemes")->asArray()[scheme];
    for (const char* key : {"label", "style"}) own.set(key, nullptr);
    return writeCompactJson(Value::Array{*document.find("model"), *document.find("time"), own, plane.at,
                                         static_cast<double>(points)});
}

/// One motion being computed.
class Motion {
public:
    Motion(const ResolvedScene& resolved, const ResolvedScheme& scheme, const ViewPlane& plane,
           std::size_t mostPoints, Orbit& orbit)
        : resolved_(resolved),
          scheme_(scheme),
          system_(*systemOf(resolved, scheme)),
          mostPoints_(mostPoints),
          orbit_(orbit) {
        orbit_.points.columns = leadingColumns(system_);
        if (plane.at.empty()) return;
        at_ = indexOf(stateColumns(system_), plane.at).value();
        isSection_ = true;
    }

    /// False where it was stopped.
    bool run(const std::stop_token& stop) {
        const Scene& scene = resolved_.scene;
        const double step = signedStep(scene, scheme_.spec.step.value);
        State state{scene.start.value, 0, orbit_.start, {}};
        const auto integrator =
            withVariations(scheme_.make(system_, step, state), system_, VariationPlan{.vector = true},
                           tangentBasis(system_), freeVariations(system_));
        const MarchGrid grid = marchGrid(scene, scheme_, step);
        inside_ = state;
        keep(state.t, state.x);
        const MarchSink sink{[&](const Stretch& stretch) {
                                 if (!stretch.isStart) see(stretch);
                                 return true;
                             },
                             isSection_ || grid.steps < static_cast<long long>(mostPoints_) / 4};
        pointsPerStep_ =
            !sink.looksInsideSteps || isSection_ || grid.steps == 0
                ? 1
                : std::clamp(static_cast<int>(static_cast<long long>(mostPoints_) / grid.steps), 1, 20);
        MotionCheck motion(system_, state, step);
        const MarchReport report = march(*integrator, state, grid, {&sink, 1}, stop, &motion);
        orbit_.outcome = report.outcome;
        orbit_.steps = state.node;
        const auto quantities = integrator->quantities();
        std::vector<double> values(quantities.size(), std::numeric_limits<double>::quiet_NaN());
        if (state.node > 0 && !values.empty()) integrator->measure(state, values.data());
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (quantities[i].name == "lyapunov") orbit_.lyapunov = values[i];
            if (quantities[i].name == "megno") orbit_.megno = values[i];
        }
        orbit_.isDone = report.outcome != Outcome::stopped;
        return orbit_.isDone;
    }

private:
    void see(const Stretch& stretch) {
        if (isSection_) return cross(stretch);
        const NodeBlock& nodes = stretch.nodes;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (int j = 1; j < pointsPerStep_ && hasRoom(); ++j) {
                const double tau = static_cast<double>(j) / pointsPerStep_;
                stretch.integrator.denseOutput(tau, inside_.x);
                keep(stretch.before.t + tau * (stretch.state.t - stretch.before.t), inside_.x);
            }
            if (!hasRoom()) return;
            inside_.x.assign(nodes.x(i), nodes.x(i) + nodes.width());
            keep(nodes.t(i), inside_.x);
        }
    }
    void cross(const Stretch& stretch) {
        samples_.begin(stretch.integrator, stretch.state.x.size());
        const double noise = roundingOf(stretch.state.x);
        const bool isForwards = stretch.state.t > stretch.before.t;  // upwards in t
        const auto value = [&](double tau) { return samples_.at(tau)[at_]; };
        for (const Crossing& crossing :
             finder_.find(stretch.before.x[at_], stretch.state.x[at_], samples_.places(), value, noise)) {
            if (crossing.isUpwards != isForwards || !hasRoom()) continue;
            stretch.integrator.denseOutput(crossing.tau, inside_.x);
            keep(stretch.before.t + crossing.tau * (stretch.state.t - stretch.before.t), inside_.x);
        }
    }
    void keep(double t, const std::vector<double>& x) { appendState(orbit_.points, t, x, x.size()); }
    bool hasRoom() {
        const bool has = orbit_.points.rows() < mostPoints_;
        orbit_.isCut = orbit_.isCut || !has;
        return has;
    }

    const ResolvedScene& resolved_;
    const ResolvedScheme& scheme_;
    const System& system_;
    std::size_t mostPoints_, at_ = 0;
    Orbit& orbit_;
    bool isSection_ = false;
    int pointsPerStep_ = 1;
    State inside_;
    StepSamples samples_;
    CrossingFinder finder_;
};

/// All motions together keep what a plot can show.
std::size_t pointsOf(std::size_t starts, bool isSection) {
    constexpr std::size_t together = 200'000, mostOfPortrait = 4000, mostOfSection = 20'000, least = 100;
    return std::clamp(together / std::max<std::size_t>(1, starts), least,
                      isSection ? mostOfSection : mostOfPortrait);
}

}  // namespace

std::optional<std::size_t> schemeOfStarts(const Scene& scene, const View& view) {
    for (std::size_t i = 0; i < scene.schemes.size(); ++i)
        if (scene.schemes[i].isEnabled && (view.scheme.empty() || scene.schemes[i].label == view.scheme))
            return i;
    return {};
}

StartsRun::StartsRun(const ResolvedScene& resolved) : resolved_(resolved) {
    const Scene& scene = resolved.scene;
    for (std::size_t v = 0; v < scene.views.size(); ++v) {
        const View& view = scene.views[v];
        if (view.starts.isEmpty()) continue;
        const auto plane = planeOf(view, *resolved.system);
        const auto scheme = schemeOfStarts(scene, view);
        if (!plane || !scheme || !startProblem(*resolved.system, *plane).empty()) continue;
        const StartPlane starts(*resolved.system, resolved.initial, *plane);
        const auto places = startsOf(starts, view);
        const std::size_t most = pointsOf(places.size(), !plane->at.empty());
        Origin origin{*scheme, keyOf(scene, *scheme, *plane, most), most, {}};
        for (const auto& [x, y] : places) {
            PlaneStart start = starts.at(x, y);
            Orbit& orbit = origin.starts.emplace_back();
            orbit.x = x;
            orbit.y = y;
            orbit.start = std::move(start.x);
            orbit.problem = std::move(start.problem);
            tasks_.push_back({origins_.size(), origin.starts.size() - 1});
        }
        StartSet set{v, scene.schemes[*scheme].label, styleOf(scene.schemes[*scheme], *scheme), *plane, {}};
        set.orbits.resize(places.size());
        sets_.all.push_back(std::move(set));
        origins_.push_back(std::move(origin));
    }
}

void StartsRun::run(std::size_t task, const std::stop_token& stop) {
    const auto [set, place] = tasks_[task];
    const Origin& origin = origins_[set];
    Known known;
    if (!origin.starts[place].problem.empty()) {
        known = std::make_shared<const Orbit>(origin.starts[place]);
    } else {
        known = orbitMemory().find(origin.key, origin.starts[place].start);
    }
    if (!known && !stop.stop_requested()) {
        Orbit orbit = origin.starts[place];
        bool isWhole = false;
        try {
            contained("", [&, &plane = sets_.all[set].plane] {
                isWhole = Motion(resolved_, resolved_.schemes[origin.scheme], plane, origin.mostPoints, orbit)
                              .run(stop);
            });
        } catch (const InvalidScene& e) {
            orbit.outcome = Outcome::refused;
            orbit.problem = e.problems().front().message;
            isWhole = true;
        }
        if (isWhole) {
            known = std::make_shared<const Orbit>(std::move(orbit));
            orbitMemory().keep(origin.key, known);
        }
    }
    if (!known) return;
    const std::lock_guard lock(mutex_);
    sets_.all[set].orbits[place] = known;
    ++done_;
}

StartSets StartsRun::latest() const {
    const std::lock_guard lock(mutex_);
    return sets_;
}

double StartsRun::fraction() const {
    const std::lock_guard lock(mutex_);
    return tasks_.empty() ? 1 : static_cast<double>(done_) / static_cast<double>(tasks_.size());
}

}  // namespace extremal
