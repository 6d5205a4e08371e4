// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/cases/many_run.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/core/library_exceptions.hpp"
#include "engine/core/pool.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/integrator/many_states.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

constexpr std::size_t lanes = TakesManyStates::together;

class ManyRun {
public:
    ManyRun(const ResolvedScene& resolved, std::size_t scheme, const std::vector<std::vector<double>>& starts,
            const std::stop_token& stop)
        : scene_(resolved.scene),
          scheme_(resolved.schemes[scheme]),
          system_(*systemOf(resolved, scheme_)),
          starts_(starts),
          stop_(stop),
          step_(signedStep(scene_, scheme_.spec.step.value)),
          grid_(marchGrid(scene_, scheme_, step_)),
          energy_(energyOf(system_)) {
        motions.all.resize(starts.size());
    }

    /// Whether the motions of a block can go together, as far as one of them tells.
    bool canGoTogether() const {
        if (!scheme_.isFixed() || starts_.empty()) return false;
        const State state = startOf(0);
        return dynamic_cast<TakesManyStates*>(scheme_.make(system_, step_, state).get()) != nullptr &&
               !looksEverywhere(MotionCheck(system_, state, step_));
    }

    void alone(std::size_t i) {
        State state = startOf(i);
        ManyMotions::Motion& motion = motions.all[i];
        try {
            contained("", [&] {
                const auto integrator = scheme_.make(system_, step_, state);
                MotionCheck check(system_, state, step_);
                motion.outcome = march(*integrator, state, grid_, {}, stop_, &check).outcome;
            });
        } catch (const InvalidScene&) {
            motion.outcome = Outcome::refused;
        }
        end(i, state);
    }

    /// The motions from `first` on; those that have to be looked at more closely are computed by themselves.
    void block(std::size_t first) {
        try {
            contained("", [&] { inLanes(first); });
        } catch (const InvalidScene&) {
            for (std::size_t i = first; i < std::min(first + lanes, starts_.size()); ++i) alone(i);
        }
    }

    ManyMotions take() {
        motions.together = together_;
        return std::move(motions);
    }

    ManyMotions motions;

private:
    void inLanes(std::size_t first) {
        const std::size_t count = std::min(lanes, starts_.size() - first), width = starts_[first].size();
        const auto place = [&](std::size_t i) {
            return first + std::min(i, count - 1);
        };  // the last ones: again
        State state = startOf(first);
        const auto integrator = scheme_.make(system_, step_, state);
        auto& many = dynamic_cast<TakesManyStates&>(*integrator);
        std::vector<double> x(width * lanes);
        std::vector<MotionCheck> checks;
        for (std::size_t i = 0; i < lanes; ++i) {
            for (std::size_t k = 0; k < width; ++k) x[k * lanes + i] = starts_[place(i)][k];
            if (i < count) checks.emplace_back(system_, startOf(place(i)), step_);
        }
        std::array<bool, lanes> isSuspect{};
        const auto look = [&](std::size_t i, double t) {
            for (std::size_t k = 0; k < width; ++k) state.x[k] = x[k * lanes + i];
            const bool isFinite =
                std::all_of(state.x.begin(), state.x.end(), [](double v) { return std::isfinite(v); });
            return isFinite && checks[i].isSound(t, state.x.data()) && !looksEverywhere(checks[i]);
        };
        bool goesOn = true;
        for (long long node = 0; node < grid_.steps && goesOn && !stop_.stop_requested();) {
            const long long next = std::min(
                grid_.steps, node < lookAgain ? std::max(1LL, 2 * node) : (node / lookAgain + 1) * lookAgain);
            goesOn = many.advanceMany(x.data(), next - node);
            node = next;
            for (std::size_t i = 0; i < count && goesOn; ++i)
                isSuspect[i] = isSuspect[i] || !look(i, grid_.clock.at(node));
        }
        for (std::size_t i = 0; i < count; ++i) {
            if (!goesOn || isSuspect[i] || checks[i].hasGained()) {
                alone(first + i);
                continue;
            }
            for (std::size_t k = 0; k < width; ++k) state.x[k] = x[k * lanes + i];
            state.node = grid_.steps;
            state.t = grid_.clock.at(grid_.steps);
            ManyMotions::Motion& motion = motions.all[first + i];
            if (stop_.stop_requested()) continue;
            motion.outcome = Outcome::converged;
            end(first + i, state);
            ++together_;
        }
    }

    /// Nodes that a run is looked at: powers of two up to this one, and its multiples (motion_check.hpp).
    static constexpr long long lookAgain = 64;
    static bool looksEverywhere(const MotionCheck& check) { return check.looksAt(3); }

    State startOf(std::size_t i) const { return {scene_.start.value, 0, starts_[i], {}}; }
    void end(std::size_t i, const State& state) {
        ManyMotions::Motion& motion = motions.all[i];
        motion.steps = state.node;
        motion.t = state.t;
        motion.energyError = std::numeric_limits<double>::quiet_NaN();
        if (energy_)
            motion.energyError =
                energy_(state.t, state.x.data()) - energy_(scene_.start.value, starts_[i].data());
        motion.x = state.x;
    }

    const Scene& scene_;
    const ResolvedScheme& scheme_;
    const System& system_;
    const std::vector<std::vector<double>>& starts_;
    const std::stop_token& stop_;
    double step_;
    MarchGrid grid_;
    EnergyFunction energy_;
    std::atomic<std::size_t> together_{0};
};

void requireStates(const System& system, const State& initial, const std::vector<std::vector<double>>& starts) {
    const std::size_t width = initial.x.size();
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const std::string pointer = "/starts/" + std::to_string(i);
        if (starts[i].size() != width) {
            std::vector<std::string> names;
            for (const Quantity& column : stateColumns(system)) names.push_back(column.name);
            throw InvalidScene(
                pointer,
                "must have " + std::to_string(width) + " numbers, got " + std::to_string(starts[i].size()),
                joinNames(names));
        }
        for (std::size_t k = 0; k < width; ++k)
            if (!std::isfinite(starts[i][k]))
                throw InvalidScene(pointer + "/" + std::to_string(k), "must be a finite number");
    }
}

}  // namespace

ManyMotions runMany(const ResolvedScene& resolved, std::size_t scheme,
                    const std::vector<std::vector<double>>& starts, const ManyOptions& options,
                    const std::stop_token& stop) {
    requireStates(*systemOf(resolved, resolved.schemes[scheme]), initialOf(resolved, resolved.schemes[scheme]),
          starts);
    ManyRun run(resolved, scheme, starts, stop);
    const bool isTogether = options.isTogether && run.canGoTogether();
    const std::size_t size = isTogether ? lanes : 1;
    std::vector<std::size_t> tasks;
    for (std::size_t first = 0; first < starts.size(); first += size) tasks.push_back(first);
    std::atomic<std::size_t> done{0};
    forEachInPool(tasks, options.threads, stop, [&](std::size_t first) {
        if (isTogether)
            run.block(first);
        else
            run.alone(first);
        done += std::min(size, starts.size() - first);
        if (options.progress) options.progress(done);
    });
    return run.take();
}

}  // namespace extremal
