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
    Galerkin(const Mechanics<double>& mechanics, std::vector<Table<double>> tables, const Clock& clock,
             SolverPolicy policy)
        : clock_(clock),
          d_(mechanics.dimension),
          periods_(std::abs(tables.front().frequency) / (2 * std::numbers::pi)),
          step_(mechanics, std::move(tables), clock.step, policy) {}

    StepReport advance(State& state) override {
        const StepReport report = step_.advance(state.t, state.x.data(), state.x.data() + d_, stop());
        if (report.outcome == Outcome::converged) state.t = clock_.at(++state.node);
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        step_.denseOutput(tau, x.data(), x.data() + d_);
    }
    double periodsPerStep() const override { return periods_; }
    void restart() override { step_.restart(); }

private:
    Clock clock_;
    int d_;
    double periods_;
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

std::unique_ptr<Integrator> makeGalerkin(const System& system, std::vector<Table<double>> tables,
                                         const Clock& clock, const SolverPolicy& policy) {
    return withDimension(system.dimension(), [&](auto d) -> std::unique_ptr<Integrator> {
        return std::make_unique<Galerkin<decltype(d)::value>>(system.mechanics(), std::move(tables), clock,
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
    return makeGalerkin(system, {tableOf(pair.space, pair.quadrature)}, clock,
                        solverPolicy(pair.solver, system));
}

}  // namespace extremal
