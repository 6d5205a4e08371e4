// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/lie/lie.hpp"

#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/family/lie/data_lagrangian.hpp"
#include "engine/family/lie/lie_step_build.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal {

template class LieStep<double, RotationGroup<double>>;
template class LieStep<double, MotionGroup<double>>;
template class LieStep<double, DataGroup>;

namespace {

template <class G>
class Lie final : public Integrator {
public:
    Lie(const typename G::Mechanics& mechanics, const Table<double>& table, double step, bool isReduced,
        bool isSymmetrised, const SolverPolicy& policy)
        : mechanics_(mechanics),
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

    void begin(State&) override {
        adjoint_.forget();
        step_.forget();
    }
    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        const G& group = step_.group();
        typename G::Pose pose = group.read(state.x.data());
        if (isSymmetrised_) report.outcome = adjoint_.advance(pose, report, stop());
        if (report.outcome == Outcome::converged) report.outcome = step_.advance(pose, report, stop());
        if (report.outcome != Outcome::converged) return report;
        group.settle(pose, state.node);
        group.write(pose, state.x.data());
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        const G& group = step_.group();
        if (!isSymmetrised_) return group.write(step_.denseOutput(tau), x.data());
        group.write(tau < 0.5 ? adjoint_.denseOutput(2 * tau) : step_.denseOutput(2 * tau - 1), x.data());
    }

    std::size_t tangentSize() const override {
        if constexpr (requires { step_.group().isotropy(); })
            if (step_.group().isOnSpheres()) return 0;
        return 2 * static_cast<std::size_t>(step_.group().dimension());
    }
    std::string tangentProblem() const override {
        return "how a frame turns about its point on a sphere is not a part of the state";
    }
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
    LieStep<double, G> adjoint() const { return {mechanics_, table_, h_ / 2, isReduced_, true, policy_}; }
    LieStep<double, G> own() const {
        return {mechanics_, table_, isSymmetrised_ ? h_ / 2 : h_, isReduced_, false, policy_};
    }

    typename G::Mechanics mechanics_;
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
    if (const LieGroup* const group = system.parts.find<LieGroup>())
        return std::make_unique<Lie<DataGroup>>(*group->mechanics, table, step, isReduced, isSymmetrised,
                                                policy);
    if (const Spheres* const spheres = system.parts.find<Spheres>())
        return std::make_unique<Lie<DataGroup>>(*spheres->mechanics, table, step, isReduced, isSymmetrised,
                                                policy);
    const BodyMechanics<double>& body = system.body();
    if (body.dimension == 3)
        return std::make_unique<Lie<RotationGroup<double>>>(body, table, step, isReduced, isSymmetrised,
                                                            policy);
    return std::make_unique<Lie<MotionGroup<double>>>(body, table, step, isReduced, isSymmetrised, policy);
}

}  // namespace extremal
