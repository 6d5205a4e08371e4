// SPDX-License-Identifier: GPL-3.0-or-later
/// The one virtual boundary of the engine, crossed once per step.
///
/// An Integrator is made for one system, one discretization and one step size. The run owns time: it says
/// where the next node is. What a scheme must remember from step to step is in the State and nowhere else;
/// buffers, starting values of iterations and what rounding took from the last sum may stay hidden in the
/// integrator, so that a run resumed from a State differs by round-off only. advance() allocates nothing.
/// Trouble is an Outcome in the report; the state is then left as it was.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/clock.hpp"
#include "engine/core/impact.hpp"
#include "engine/core/node_block.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text/archive.hpp"

namespace extremal {

/// fixed: the nodes are products of the run; landing: under error control, but a step ends at the end of the
/// run; free: the times of nodes are unknowns of the scheme.
enum class TimeGrid { fixed, landing, free };

class Integrator {
public:
    virtual ~Integrator() = default;

    virtual TimeGrid grid() const { return TimeGrid::fixed; }

    /// The step size of a fixed grid, negative where it goes back in time; 0 of other grids.
    virtual double stepSize() const { return 0; }
    /// Another step size, for a fixed grid. Tables are made anew, which may allocate; throws InvalidScene
    /// where the scheme does not exist for the step. Only fixed grids have it.
    virtual void setStep(double) {}

    /// What State::memory consists of; empty for a one-step method.
    virtual std::vector<MemoryPart> memoryParts() const { return {}; }
    /// A run begins at this state: fills its memory from x, and forgets whatever came before. advance() calls
    /// it where a scheme with memory meets a state without.
    virtual void begin(State& state) { state.memory.clear(); }

    /// Takes one step: x, memory and node move on. fixed: by the step size, after which t is exactly `until`;
    /// landing: not beyond `until`; free: as far as the scheme goes.
    virtual StepReport advance(State& state, double until) = 0;

    /// Takes steps until `nodes` is full, or `count` of them, or to the first trouble; each node reached is
    /// appended. Only on fixed grids; `clock` gives the time of each node. Overridden where a step is so
    /// cheap that this boundary would be felt.
    virtual StepReport advanceBlock(State& state, NodeBlock& nodes, std::size_t count, const Clock& clock);
    /// Whether advance() looks for infinities itself and then leaves the state as it was, with the outcome
    /// notFinite: for states so wide that a run should neither copy them before a step nor read them after
    /// it.
    virtual bool checksFinite() const { return false; }

    /// What the integrator can say of its last step besides the report: a discrete energy, a residual, ...
    virtual std::span<const Quantity> quantities() const { return {}; }
    /// Their values, one for each, where something reads them. `state`: as the last advance() left it.
    virtual void measure(const State& /*state*/, double* /*values*/) const {}

    /// The impacts on walls in the last step, in their order.
    virtual std::span<const Impact> impacts() const { return {}; }

    /// The scheme's own solution inside the last step, at t = t_before + tau * step, tau in [0, 1]; x as in
    /// State. Only valid after a converged advance(). It is whole even if a stop was requested since, and
    /// not a number where it is computed by a step of its own that has no solution.
    virtual void denseOutput(double tau, std::span<double> x) const = 0;

    /// How many numbers a variation of the state has, 0 where the scheme has no tangent map. They are
    /// canonical coordinates, first those of positions, then those of momenta: (dq, dp); real and imaginary
    /// parts of a wave function; (dt, dq, -dE, dp) where times are unknowns. On a group they are left
    /// trivialised, (g^{-1} dg, dmu), with the form of model/symplectic_form.hpp.
    virtual std::size_t tangentSize() const { return 0; }
    /// Why not, where that is 0, after "has no tangent map: ".
    virtual std::string tangentProblem() const { return "its steps cannot be differentiated"; }
    /// Moves variations of the state before the last step to those of the state after it, W <- M W with the
    /// tangent map M = dx_1/dx_0 of the step; column after column. Steps of a size chosen from the state are
    /// taken as given. False where M does not exist; W is then of no use. Only valid after a converged
    /// advance() of a scheme with a tangentSize().
    virtual bool applyTangent(std::span<double> /*W*/) { return false; }

    /// The same integrator with all that it remembers: its next step has the same bits.
    virtual std::unique_ptr<Integrator> clone() const = 0;

    /// Writes or reads what the next step depends on besides the State: starting values, what rounding took
    /// from sums, factors in use. An integrator just made for the same scheme that reads it goes on from the
    /// State with the same bits. False where a library keeps its history to itself; what was written is then
    /// of no use.
    virtual bool checkpoint(Archive& /*archive*/) { return true; }

    /// How often the dense output of a step oscillates by itself: what a picture of it must resolve. 0 where
    /// steps are to resolve the motion.
    virtual double periodsPerStep() const { return 0; }

    /// How it solves its equations, where that was a choice, for people: "banded, 4.1 us per step"; else
    /// empty.
    virtual std::string about() const { return {}; }

    /// Asks the iteration inside advance() to give up with Outcome::stopped. Polled in every iteration.
    void setStop(std::stop_token stop) { stop_ = std::move(stop); }

protected:
    const std::stop_token& stop() const { return stop_; }

private:
    std::stop_token stop_;
};

/// One step on a fixed grid, to the node after the one that the state is at, for what is not a run. The start
/// of the grid follows from t and node, so that nodes stay products.
inline StepReport advance(Integrator& integrator, State& state) {
    const double h = integrator.stepSize();
    const double start = state.t - static_cast<double>(state.node) * h;
    return integrator.advance(state, Clock{start, h}.at(state.node + 1));
}

/// The step of a copy that computes dense output: without the stop token, as the run may have been asked to
/// stop since; x is not a number where the step has no solution.
inline void advanceForDenseOutput(Integrator& copy, State& state, double until) {
    copy.setStop({});
    if (copy.advance(state, until).outcome != Outcome::converged)
        std::fill(state.x.begin(), state.x.end(), std::numeric_limits<double>::quiet_NaN());
}

}  // namespace extremal
