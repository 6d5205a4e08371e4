#include "engine/family/lie/lie.hpp"

#include <utility>

#include "engine/core/problem.hpp"
#include "engine/family/lie/lie_step_build.hpp"
#include "engine/family/galerkin/table_of.hpp"

namespace extremal {
namespace {

template <class G>
class Lie final : public Integrator {
public:
    Lie(const BodyMechanics<double>& body, const Table<double>& table, const Clock& clock, bool isReduced,
        bool isSymmetrised, const SolverPolicy& policy)
        : clock_(clock),
          isSymmetrised_(isSymmetrised),
          adjoint_(body, table, clock.step / 2, isReduced, true, policy),
          step_(body, table, isSymmetrised ? clock.step / 2 : clock.step, isReduced, false, policy) {}

    StepReport advance(State& state) override {
        StepReport report;
        report.step = clock_.step;
        Pose<double> pose = G::read(state.x.data());
        if (isSymmetrised_) report.outcome = adjoint_.advance(pose, report, stop());
        if (report.outcome == Outcome::converged) report.outcome = step_.advance(pose, report, stop());
        if (report.outcome != Outcome::converged) return report;
        G::write(pose, state.x.data());
        state.t = clock_.at(++state.node);
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        if (!isSymmetrised_) return G::write(step_.denseOutput(tau), x.data());
        G::write(tau < 0.5 ? adjoint_.denseOutput(2 * tau) : step_.denseOutput(2 * tau - 1), x.data());
    }

private:
    Clock clock_;
    bool isSymmetrised_;
    LieStep<double, G> adjoint_, step_;
};

}  // namespace

std::unique_ptr<Integrator> makeLieIntegrator(const System& system, const Discretization& pair,
                                              const Clock& clock, const SolverPolicy& policy) {
    if (!isBody(system))
        throw InvalidScene("/space/type", "lie-polynomial needs a rigid body, and " + system.id + " is none",
                           "take polynomial");
    if (policy.method == SolverMethod::fixedPoint)
        throw InvalidScene("/solver/method", "lie-polynomial is solved by Newton's method alone",
                           "use newton or auto");
    const Table<double> table = tableOf(pair.space, pair.quadrature);
    const bool isReduced = pair.space.flag("reduced"), isSymmetrised = pair.space.flag("symmetric");
    const BodyMechanics<double>& body = system.body();
    if (body.dimension == 3)
        return std::make_unique<Lie<RotationGroup<double>>>(body, table, clock, isReduced, isSymmetrised,
                                                            policy);
    return std::make_unique<Lie<MotionGroup<double>>>(body, table, clock, isReduced, isSymmetrised, policy);
}

}  // namespace extremal
