#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/dimension.hpp"
#include "engine/core/problem.hpp"
#include "engine/integrator/elliptic.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/integrator/lie.hpp"
#include "engine/integrator/oscillatory.hpp"
#include "engine/integrator/scheme.hpp"
#include "engine/integrator/table_of.hpp"
#include "engine/integrator/wave.hpp"

namespace extremal {
namespace {

/// The step of a pair as an Integrator.
template <int D>
class Galerkin final : public Integrator {
public:
    Galerkin(const Mechanics<double>& mechanics, std::vector<Table<double>> tables, const Clock& clock,
             SolverPolicy policy)
        : clock_(clock), d_(mechanics.dimension), step_(mechanics, std::move(tables), clock.step, policy) {}

    StepReport advance(State& state) override {
        const StepReport report = step_.advance(state.t, state.x.data(), state.x.data() + d_, stop());
        if (report.outcome == Outcome::converged) state.t = clock_.at(++state.node);
        return report;
    }
    void curve(double tau, std::span<double> x) const override {
        step_.curve(tau, x.data(), x.data() + d_);
    }
    void restart() override { step_.restart(); }

private:
    Clock clock_;
    int d_;
    GalerkinStep<double, D> step_;
};

SolverPolicy solverPolicy(const Settings& solver, const System& system) {
    SolverPolicy policy;
    if (solver.type == "newton") policy.method = SolverMethod::newton;
    if (solver.type == "fixed-point") {
        policy.method = SolverMethod::fixedPoint;
        if (system.hasMechanics() && !system.mechanics.isSeparable)
            throw InvalidScene("/solver/method",
                               "fixed-point iteration needs a separable Lagrangian, and that of " + system.id + " is not",
                               "use newton or auto");
    }
    policy.tolerance = solver.number("tolerance");
    if (const int n = solver.integer("max_iterations"); n > 0) policy.maxIterations = n;
    return policy;
}

}  // namespace

std::unique_ptr<Integrator> makeIntegrator(const System& system, const Discretization& pair, const Clock& clock) {
    if (isWaveSpace(pair.space)) return makeWaveIntegrator(system, pair, clock);
    const SolverPolicy policy = solverPolicy(pair.solver, system);
    if (pair.space.type == "lie-polynomial") return makeLieIntegrator(system, pair, clock, policy);
    if (isElliptic(pair.space)) return makeEllipticIntegrator(system, pair, clock);
    if (!system.hasMechanics())
        throw InvalidScene("/space/type", pair.space.type + " needs coordinates, and " + system.id + " has none",
                           system.hasBody() ? "take lie-polynomial" : system.hasWave() ? "take fourier" : "another space: extremal list spaces");
    const bool isFast = isOscillatory(pair.space);
    if (isFast && policy.method == SolverMethod::fixedPoint)
        throw InvalidScene("/solver/method", "fixed-point iteration diverges on fast oscillations", "use newton or auto");
    std::vector<Table<double>> tables = isFast ? oscillatoryTables(system, pair, clock.step)
                                               : std::vector<Table<double>>{tableOf(pair.space, pair.quadrature)};
    return withDimension(system.dimension(), [&](auto d) -> std::unique_ptr<Integrator> {
        return std::make_unique<Galerkin<decltype(d)::value>>(system.mechanics, std::move(tables), clock, policy);
    });
}

}  // namespace extremal
