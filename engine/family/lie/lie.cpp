// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/lie/lie.hpp"

#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/family/lie/lie_step_build.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal {

template class LieStep<double, RotationGroup<double>>;
template class LieStep<double, MotionGroup<double>>;

namespace {

template <class G>
class Lie final : public Integrator {
public:
    Lie(const BodyMechanics<double>& body, const Table<double>& table, double step, bool isReduced,
        bool isSymmetrised, const SolverPolicy& policy)
        : body_(body),
          table_(table),
          policy_(policy),
          h_(step),
          isReduced_(isReduced),
          isSymmetrised_(isSymmetrised),
          adjoint_(adjoint()),
          step_(own()) {}

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        adjoint_ = adjoint();
        step_ = own();
    }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        Pose<double> pose = G::read(state.x.data());
        if (isSymmetrised_) report.outcome = adjoint_.advance(pose, report, stop());
        if (report.outcome == Outcome::converged) report.outcome = step_.advance(pose, report, stop());
        if (report.outcome != Outcome::converged) return report;
        G::write(pose, state.x.data());
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        if (!isSymmetrised_) return G::write(step_.denseOutput(tau), x.data());
        G::write(tau < 0.5 ? adjoint_.denseOutput(2 * tau) : step_.denseOutput(2 * tau - 1), x.data());
    }

    std::size_t tangentSize() const override { return 2 * G::n; }
    bool applyTangent(std::span<double> W) override {
        const auto columns = static_cast<int>(W.size() / tangentSize());
        return (!isSymmetrised_ || adjoint_.applyTangent(W.data(), columns)) &&
               step_.applyTangent(W.data(), columns);
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Lie>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(adjoint_, step_);
        return true;
    }

private:
    LieStep<double, G> adjoint() const { return {body_, table_, h_ / 2, isReduced_, true, policy_}; }
    LieStep<double, G> own() const {
        return {body_, table_, isSymmetrised_ ? h_ / 2 : h_, isReduced_, false, policy_};
    }

    BodyMechanics<double> body_;
    Table<double> table_;
    SolverPolicy policy_;
    double h_;
    bool isReduced_, isSymmetrised_;
    LieStep<double, G> adjoint_, step_;
};

}  // namespace

Table<double> lieTable(const Settings& space, const Settings& quadrature) {
    static MemoCache<std::pair<Settings, Settings>, Table<double>> known(64);
    return known.get({space, quadrature}, [&] {
        return makeTable(polynomialSpace<double>(space.integer("degree"), PolynomialBasis::lobatto),
                         makeRule<double>(quadrature));
    });
}

std::unique_ptr<Integrator> makeLieIntegrator(const System& system, const Discretization& discretization,
                                              double step) {
    const SolverPolicy policy = solverPolicy(discretization.solver, system);
    const Table<double> table = lieTable(discretization.space, discretization.quadrature);
    const bool isReduced = discretization.space.flag("reduced"),
               isSymmetrised = discretization.space.flag("symmetric");
    const BodyMechanics<double>& body = system.body();
    if (body.dimension == 3)
        return std::make_unique<Lie<RotationGroup<double>>>(body, table, step, isReduced, isSymmetrised,
                                                            policy);
    return std::make_unique<Lie<MotionGroup<double>>>(body, table, step, isReduced, isSymmetrised, policy);
}

}  // namespace extremal
