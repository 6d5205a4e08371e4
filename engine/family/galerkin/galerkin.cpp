#include <cmath>
#include <memory>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/dimension.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/family.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/galerkin/table_of.hpp"

namespace extremal {
namespace {

/// The step of a pair as an Integrator.
template <int D>
class Galerkin final : public Integrator {
public:
    Galerkin(const Mechanics<double>& mechanics, TablesOfStep tables, double step, SolverPolicy policy)
        : mechanics_(mechanics), tables_(std::move(tables)), policy_(policy), h_(step), step_(own()) {}

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        step_ = own();
    }
    void begin(State& state) override {
        state.memory.clear();
        step_.restart();
    }

    StepReport advance(State& state, double until) override {
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
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Galerkin>(*this); }

private:
    GalerkinStep<double, D> own() {
        std::vector<Table<double>> tables = tables_(h_);
        periods_ = std::abs(tables.front().frequency) / (2 * std::numbers::pi);
        return {mechanics_, std::move(tables), h_, policy_};
    }

    Mechanics<double> mechanics_;
    TablesOfStep tables_;
    SolverPolicy policy_;
    double h_, periods_ = 0;
    GalerkinStep<double, D> step_;
};

SolverPolicy solverPolicy(const Settings& solver, const System& system) {
    SolverPolicy policy;
    if (solver.type == "newton") policy.method = SolverMethod::newton;
    if (solver.type == "fixed-point") {
        policy.method = SolverMethod::fixedPoint;
        if (isMechanical(system) && !system.mechanics().isSeparable)
            throw InvalidScene(
                "/solver/method",
                "fixed-point iteration needs a separable Lagrangian, and that of " + system.id + " is not",
                "use newton or auto");
    }
    policy.tolerance = solver.number("tolerance");
    if (const int n = solver.integer("max_iterations"); n > 0) policy.maxIterations = n;
    return policy;
}

}  // namespace

std::unique_ptr<Integrator> makeGalerkin(const System& system, TablesOfStep tables, double step,
                                         const SolverPolicy& policy) {
    return withDimension(system.dimension(), [&](auto d) -> std::unique_ptr<Integrator> {
        return std::make_unique<Galerkin<decltype(d)::value>>(system.mechanics(), std::move(tables), step,
                                                              policy);
    });
}

std::unique_ptr<Integrator> makeIntegrator(const System& system, const Discretization& pair,
                                           const Clock& clock) {
    const PairFamily* const family = familyOf(pair.space);
    const bool needsCoordinates = !family || !(family->hasOneTable || kindOf<BoundaryProblem>(system));
    if (needsCoordinates && !isMechanical(system))
        throw InvalidScene("/space/type",
                           pair.space.type + " needs coordinates, and " + system.id + " has none",
                           isBody(system)   ? "take lie-polynomial"
                           : isWave(system) ? "take fourier"
                                            : "another space: extremal list spaces");
    if (family) return family->make(system, pair, clock, solverPolicy(pair.solver, system));
    return makeGalerkin(
        system, [table = tableOf(pair.space, pair.quadrature)](double) { return std::vector{table}; },
        clock.step, solverPolicy(pair.solver, system));
}

}  // namespace extremal
