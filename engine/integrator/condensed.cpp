// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/condensed.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/action/element_kernel.hpp"
#include "engine/core/dimension.hpp"
#include "engine/core/problem.hpp"
#include "engine/integrator/shared_force.hpp"
#include "engine/integrator/variation/transposed_step.hpp"

namespace extremal {
namespace {

/// The step of a discretization as an Integrator.
template <int D>
class Condensed final : public Integrator, public SharesForce, public TransposedStep {
public:
    Condensed(const Mechanics<double>& mechanics, TablesOfStep tables, double step, SolverPolicy policy,
              std::vector<LagrangianTerm<double>> parts, const LagrangianEntries* entries)
        : mechanics_(mechanics),
          tables_(std::move(tables)),
          policy_(policy),
          parts_(std::move(parts)),
          entries_(entries ? std::optional(*entries) : std::nullopt),
          h_(step),
          step_(own()) {}

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        if (changes_)
            step_ = own();  // the functions are others
        else
            step_.setStep(h);
    }
    void begin(State& state) override {
        state.memory.clear();
        step_.restart();
    }

    StepReport advance(State& state, double until) override {
        start_ = state.t;
        const StepReport report =
            step_.advance(state.t, state.x.data(), state.x.data() + mechanics_.dimension, stop());
        if (report.outcome != Outcome::converged) return report;
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        step_.denseOutput(tau, x.data(), x.data() + mechanics_.dimension);
    }
    double periodsPerStep() const override { return periods_; }

    std::size_t tangentSize() const override { return static_cast<std::size_t>(2 * mechanics_.dimension); }
    bool applyTangent(std::span<double> W) override {
        return step_.applyTangent(start_, W.data(), static_cast<int>(W.size() / tangentSize()));
    }
    bool applyTransposed(std::span<double> W) override {
        return step_.applyTransposed(start_, W.data(), static_cast<int>(W.size() / tangentSize()));
    }
    bool hasNodes() const override { return parts_.empty(); }
    void visitNodes(const std::function<void(const NodePull::Node&)>& visit) override {
        step_.visitNodes(start_, visit);
    }
    bool pullBack(std::span<double> W, NodePull& pull) override {
        return step_.applyTransposed(start_, W.data(), static_cast<int>(W.size() / tangentSize()), &pull);
    }

    /// E_d = -dS/dh at the solution, and S; not where the functions change with the step, or L with time.
    std::span<const Quantity> quantities() const override {
        static const Quantity known[] = {{"discrete_energy", "", "E_d", ""}, {"action", "", "S", ""}};
        const bool exists = !changes_ && parts_.empty() && !mechanics_.isTimeDependent;
        return {known, exists ? std::size(known) : 0};
    }
    void measure(const State& state, double* values) const override {
        const int d = mechanics_.dimension;
        if (!kernel_) kernel_.emplace(mechanics_, tables_(h_), ElementBasis::increments);
        Eigen::VectorXd Y(kernel_->size() - d), z(kernel_->size());
        std::vector<double> start(static_cast<std::size_t>(2 * d));
        step_.coefficients(Y.data());
        denseOutput(0, start);
        int next = 0;
        for (int k = 0; k < d; ++k) {
            z(kernel_->index(k, 0)) = start[static_cast<std::size_t>(k)];
            for (int a = 1; a < kernel_->functions(k); ++a) z(kernel_->index(k, a)) = Y(next++);
        }
        ElementDerivatives<double> S;
        const bool isFinite = kernel_->evaluate(state.t - h_, h_, z, DerivativeOrder::first, S);
        values[0] = isFinite ? -S.byStep : std::numeric_limits<double>::quiet_NaN();
        values[1] = isFinite ? S.action : std::numeric_limits<double>::quiet_NaN();
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Condensed>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(step_);
        return true;
    }
    void takeForce(const SharesForce& other) override {
        step_.takeEnd(static_cast<const Condensed&>(other).step_);
    }

private:
    GalerkinStep<double, D> own() {
        std::vector<Table<double>> tables = tables_(h_);
        periods_ = std::abs(tables.front().frequency) / (2 * std::numbers::pi);
        changes_ = periods_ > 0 || std::any_of(tables.begin(), tables.end(),
                                               [](const Table<double>& t) { return t.dependsOnStep; });
        return {mechanics_, std::move(tables), h_, policy_, parts_, entries_ ? &*entries_ : nullptr};
    }

    Mechanics<double> mechanics_;
    TablesOfStep tables_;
    SolverPolicy policy_;
    std::vector<LagrangianTerm<double>> parts_;
    std::optional<LagrangianEntries> entries_;
    double h_, periods_ = 0;
    bool changes_ = false;  ///< the functions are others for another step
    double start_ = 0;      ///< of the last step
    GalerkinStep<double, D> step_;
    mutable std::optional<ElementKernel<double>> kernel_;  ///< made where the discrete energy is asked for
};

}  // namespace

SolverPolicy solverPolicy(const Settings& solver, const System& system) {
    SolverPolicy policy;
    if (solver.type == "newton") policy.method = SolverMethod::newton;
    if (solver.type == "fixed-point") {
        policy.method = SolverMethod::fixedPoint;
        if (const Mechanical* const m = system.parts.find<Mechanical>(); m && !m->isSeparable)
            throw InvalidScene("/solver/method",
                               "fixed-point iteration alone is for separable Lagrangians, and that of " +
                                   system.id + " is not",
                               "use newton or auto");
    }
    policy.tolerance = solver.number("tolerance");
    if (const int n = solver.integer("max_iterations"); n > 0) policy.maxIterations = n;
    return policy;
}

std::unique_ptr<Integrator> makeCondensed(const Mechanics<double>& mechanics, TablesOfStep tables,
                                          double step, const SolverPolicy& policy,
                                          std::vector<LagrangianTerm<double>> parts,
                                          const LagrangianEntries* entries) {
    return withDimension(mechanics.dimension, [&](auto d) -> std::unique_ptr<Integrator> {
        return std::make_unique<Condensed<decltype(d)::value>>(mechanics, std::move(tables), step, policy,
                                                               std::move(parts), entries);
    });
}

}  // namespace extremal
