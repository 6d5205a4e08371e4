// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/moving_mesh/moving_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/family/moving_mesh/energy_root.hpp"
#include "engine/family/moving_mesh/explicit_step.hpp"
#include "engine/family/moving_mesh/hierarchical_step.hpp"
#include "engine/family/moving_mesh/multiplier_step.hpp"

namespace extremal {
namespace {

/// A mesh whose residual is larger has left its constraint: Newton's method leaves 1e-13, and one explicit
/// step more than 1e-3.
constexpr double onConstraint = 1e-8;
/// In wave speeds. Nodes that carry a front are as fast as it; where equidistribution asks for more it has to
/// follow what changes everywhere at once.
constexpr double fastestNodes = 1.5;
/// Residual of a mesh that no longer follows the solution: a share that is the mean one and this many times
/// more, as a square, beside its neighbour. Runs whose error makes sense have at most 6, with few nodes;
/// those that have lost a front have 15 to 40.
constexpr double lostResidual = 10;

class MovingMesh final : public Integrator {
    using Method = MovingMeshOptions::Method;

public:
    MovingMesh(std::shared_ptr<const FieldProblem> problem, const MovingMeshOptions& options, double step)
        : space_(std::move(problem)),
          options_(options),
          h_(step),
          multiplier_(space_, options.monitor, options.tolerance, options.maxIterations),
          explicit_(space_, options.monitor, options.relaxation, options.speedLimit * std::sqrt(space_.c2),
                    options.tolerance, options.maxIterations),
          hierarchical_(space_, options.monitor, options.tolerance, options.maxIterations),
          constraint_(options.monitor, space_.n) {
        if (options.method == Method::free) multiplier_.setFree(options.meshMass);
        options_.hasFallback = options.hasFallback && options.method == Method::multiplier;
        for (auto* each : {&z_, &v_, &zBefore_, &vBefore_}) each->assign(2 * space_.n, 0);
    }

    TimeGrid grid() const override { return choosesSteps() ? TimeGrid::free : TimeGrid::fixed; }
    double stepSize() const override { return choosesSteps() ? 0 : h_; }
    void setStep(double h) override { h_ = h; }
    bool checksFinite() const override { return true; }

    std::vector<MemoryPart> memoryParts() const override {
        if (!choosesSteps()) return {};
        return {{"discrete energy", 1}, {"last step", 1}, {"change of energy by the step", 1}};
    }
    /// The first step is made once for its energy, and again by advance().
    void begin(State& state) override {
        state.memory.clear();
        if (!choosesSteps()) return;
        StepReport report;
        unpack(state.x);
        const double energy = energyOf(h_, report);
        state.memory = {energy, h_, 0};
    }

    StepReport advance(State& state, double until) override {
        if (choosesSteps() && state.memory.empty()) begin(state);
        StepReport report;
        unpack(state.x);
        report.step = h_;
        report.outcome = choosesSteps() ? freeStep(state.memory, report) : step(h_, report);
        if (report.outcome != Outcome::converged) return report;
        pack(state.x);
        state.t = choosesSteps() ? state.t + report.step : until;
        lastStep_ = report.step;
        ++state.node;
        return report;
    }

    std::span<const Quantity> quantities() const override {
        static const std::array<Quantity, 5> all{{{"discrete_energy", "discrete energy", "E_d", ""},
                                                  {"multiplier", "multiplier", "max |λ|", ""},
                                                  {"mesh_residual", "mesh residual", "max |g|", ""},
                                                  {"density", "", "ℓ", ""},
                                                  {"monitor", "", "", ""}}};
        return all;
    }
    /// The density of the action's error in time is 0 = H - E_d - 3 h^2 l, and the monitor h |l|^(1/3).
    void measure(const State&, double* values) const override {
        values[0] = last_ == Method::explicitMesh   ? explicit_.slabEnergy()
                    : last_ == Method::hierarchical ? hierarchical_.slabEnergy()
                                                    : multiplier_.slabEnergy();
        values[1] = last_ == Method::multiplier ? multiplier_.largestMultiplier() : std::nan("");
        values[2] = constraint_.residual(z_.data());
        values[3] = values[4] = std::nan("");
        if (!choosesSteps() || last_ != Method::multiplier) return;
        const double H =
            (space_.energy(zBefore_.data(), vBefore_.data()) + space_.energy(z_.data(), v_.data())) / 2;
        values[3] = (H - values[0]) / (3 * lastStep_ * lastStep_);
        values[4] = std::abs(lastStep_) * std::cbrt(std::abs(values[3]));
    }

    void denseOutput(double tau, std::span<double> x) const override {
        State state;
        state.x.resize(4 * space_.n);
        MovingMesh shorter = *this;
        shorter.z_ = zBefore_;
        shorter.v_ = vBefore_;
        shorter.pack(state.x);
        shorter.options_.hasEnergyTimes = false;
        if (tau > 0) {
            shorter.setStep(tau * lastStep_);
            advanceForDenseOutput(shorter, state, 0);
        }
        std::copy(state.x.begin(), state.x.end(), x.begin());
    }
    std::string tangentProblem() const override {
        return "its nodes are tied to its values, by a constraint or a monitor, so that neither can be "
               "varied alone";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MovingMesh>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(multiplier_);
        return true;
    }

private:
    /// x = (y, y', X, X') to z and v, which are (y_i, X_i) and their rates node by node, before the step and
    /// now.
    void unpack(const std::vector<double>& x) {
        const std::size_t n = space_.n;
        for (std::size_t i = 0; i < n; ++i) {
            z_[2 * i] = x[i];
            v_[2 * i] = x[n + i];
            z_[2 * i + 1] = x[2 * n + i];
            v_[2 * i + 1] = x[3 * n + i];
        }
        zBefore_ = z_;
        vBefore_ = v_;
    }
    void pack(std::vector<double>& x) const {
        const std::size_t n = space_.n;
        for (std::size_t i = 0; i < n; ++i) {
            x[i] = z_[2 * i];
            x[n + i] = v_[2 * i];
            x[2 * n + i] = z_[2 * i + 1];
            x[3 * n + i] = v_[2 * i + 1];
        }
    }

    bool choosesSteps() const { return options_.hasEnergyTimes; }
    bool isOffConstraint() { return options_.hasFallback && constraint_.residual(z_.data()) > onConstraint; }

    /// Of a multiplier step of length h from where the state is, which is left at its end; not a number where
    /// it has no solution.
    double energyOf(double h, StepReport& report) {
        z_ = zBefore_;
        v_ = vBefore_;
        if (checked(multiplier_.advance(z_, v_, h, report, stop())) != Outcome::converged)
            return std::nan("");
        last_ = Method::multiplier;
        return multiplier_.slabEnergy();
    }

    /// memory: E, the last step, and dE_d/d(h^2).
    Outcome freeStep(std::vector<double>& memory, StepReport& report) {
        if (isOffConstraint() || !std::isfinite(memory[0])) return step(h_, report);
        const double tolerance = 16 * std::numeric_limits<double>::epsilon() * std::abs(memory[0]);
        const EnergyRoot root = findEnergyRoot([&](double h) { return energyOf(h, report); }, memory[0],
                                               memory[1], memory[2], tolerance);
        if (stop().stop_requested()) return Outcome::stopped;
        if (root.isFound && !(options_.hasFallback && isTooFast(root.h))) {
            report.step = memory[1] = root.h;
            memory[2] = root.slope;
            return Outcome::converged;
        }
        z_ = zBefore_;
        v_ = vBefore_;
        ++report.cost.rejected;
        const Outcome outcome = step(h_, report);
        if (outcome == Outcome::converged && last_ == Method::multiplier) {
            report.event = StepEvent::energyUnsolvable;
            memory = {multiplier_.slabEnergy(), h_, 0};
        }
        return outcome;
    }

    Outcome step(double h, StepReport& report) {
        last_ = options_.method;
        if (last_ == Method::explicitMesh) return followed(explicit_.advance(z_, v_, h, report, stop()));
        if (last_ == Method::hierarchical) return checked(hierarchical_.advance(z_, v_, h, report, stop()));
        Outcome outcome = Outcome::diverged;
        if (!isOffConstraint()) {
            outcome = checked(multiplier_.advance(z_, v_, h, report, stop()));
            const bool isSound = outcome == Outcome::converged && !isTooFast(h);
            if (!options_.hasFallback || isSound || outcome == Outcome::stopped) return outcome;
            ++report.cost.rejected;
        }
        z_ = zBefore_;
        v_ = vBefore_;
        last_ = Method::explicitMesh;
        report.event = StepEvent::meshFallback;
        return followed(explicit_.advance(z_, v_, h, report, stop()));
    }
    bool isTooFast(double h) const {
        const double most = fastestNodes * std::sqrt(space_.c2) * std::abs(h);
        for (std::size_t i = 0; i < space_.n; ++i)
            if (std::abs(z_[2 * i + 1] - zBefore_[2 * i + 1]) > most) return true;
        return false;
    }
    /// Of an explicit step.
    Outcome followed(Outcome outcome) {
        outcome = checked(outcome);
        const bool isLost = outcome == Outcome::converged && constraint_.residual(z_.data()) > lostResidual;
        return isLost ? Outcome::lost : outcome;
    }
    Outcome checked(Outcome outcome) const {
        if (outcome != Outcome::converged) return outcome;
        double sum = 0;
        for (const double value : z_) sum += 0 * value;
        for (const double value : v_) sum += 0 * value;
        if (sum != 0) return Outcome::notFinite;
        return space_.isOrdered(z_.data()) ? Outcome::converged : Outcome::lost;
    }

    NodeSpace space_;
    MovingMeshOptions options_;
    double h_, lastStep_ = 0;
    MultiplierStep multiplier_;
    ExplicitStep explicit_;
    HierarchicalStep hierarchical_;
    mutable MeshConstraint constraint_;  ///< for what is measured: it has buffers
    Method last_ = Method::multiplier;   ///< of the last step
    std::vector<double> z_, v_, zBefore_, vBefore_;
};

}  // namespace

std::unique_ptr<Integrator> makeMovingMesh(std::shared_ptr<const FieldProblem> problem,
                                           const MovingMeshOptions& options, double step) {
    return std::make_unique<MovingMesh>(std::move(problem), options, step);
}

}  // namespace extremal
