// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/lie/lie.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/core/memo_cache.hpp"
#include "engine/family/lie/body_poses.hpp"
#include "engine/family/lie/data_lagrangian.hpp"
#include "engine/family/lie/lie_step_build.hpp"
#include "engine/family/lie/quaternion_step.hpp"
#include "engine/family/lie/sphere_variations.hpp"
#include "engine/integrator/condensed.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal {

template class LieStep<double, RotationGroup<double>>;
template class LieStep<double, MotionGroup<double>>;
template class LieStep<double, DataGroup>;

namespace {

/// Poses from states and back: the group's own, but of rotations those of BodyPoses.
template <class G>
class StatePoses {
public:
    explicit StatePoses(const typename G::Mechanics& mechanics) : group_(mechanics) {}
    decltype(auto) read(const std::vector<double>& x) const { return group_.read(x.data()); }
    void put(const typename G::Pose& p, double* x) const { group_.write(p, x); }
    void write(const typename G::Pose& p, std::vector<double>& x) { group_.write(p, x.data()); }
    void forget() {}
    void checkpoint(Archive&) {}
    void varyBody(double*, int) const {}
    void varyState(double*, int) const {}

private:
    G group_;
};
template <>
class StatePoses<RotationGroup<double>> : public BodyPoses {
public:
    explicit StatePoses(const BodyMechanics<double>&) {}
    explicit StatePoses(BodyForm form) : BodyPoses(std::move(form)) {}
};

/// Of the adjoint: the same space, with the nodes 1 - c_i.
Table<double> mirroredTable(const Settings& space, const Settings& quadrature) {
    const Table<double> own = lieTable(space, quadrature);
    if (own.rule.isSymmetric) return own;
    Rule<double> rule = own.rule;
    for (std::vector<double>* const each : {&rule.c, &rule.ends}) {
        std::reverse(each->begin(), each->end());
        for (double& c : *each) c = 1 - c;
    }
    std::reverse(rule.b.begin(), rule.b.end());
    return makeTable(own.space, rule);
}

template <class G>
class Lie final : public Integrator {
public:
    Lie(const typename G::Mechanics& mechanics, StatePoses<G> poses, const Discretization& d, double step,
        const SolverPolicy& policy)
        : poses_(std::move(poses)),
          mechanics_(mechanics),
          table_(lieTable(d.space, d.quadrature)),
          mirrored_(mirroredTable(d.space, d.quadrature)),
          policy_(policy),
          h_(step),
          base_(d.space.number("base")),
          isReduced_(d.space.flag("reduced")),
          isSymmetrised_(d.space.flag("symmetric")),
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
        poses_.forget();
    }
    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        const G& group = step_.group();
        pose_ = poses_.read(state.x);
        if (isSymmetrised_) report.outcome = adjoint_.advance(pose_, report, stop());
        if (report.outcome == Outcome::converged) report.outcome = step_.advance(pose_, report, stop());
        if (report.outcome != Outcome::converged) return report;
        group.settle(pose_, state.node);
        poses_.write(pose_, state.x);
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        if (!isSymmetrised_) return poses_.put(step_.denseOutput(tau), x.data());
        poses_.put(tau < 0.5 ? adjoint_.denseOutput(2 * tau) : step_.denseOutput(2 * tau - 1), x.data());
    }

    std::size_t tangentSize() const override {
        const auto d = static_cast<std::size_t>(step_.group().dimension());
        return isOnSpheres() ? 4 * d / 3 : 2 * d;
    }
    bool applyTangent(std::span<double> W) override {
        const auto columns = static_cast<int>(W.size() / tangentSize());
        if constexpr (hasSpheres)
            if (isOnSpheres()) {
                const int spheres = step_.group().dimension() / 3;
                std::vector<double> wide = spheres::variationsOfFrames(W.data(), spheres, columns);
                if (!applyInGroup(wide.data(), columns)) return false;
                spheres::variationsOfPoints(pose_, wide, spheres, columns, W.data());
                return true;
            }
        poses_.varyBody(W.data(), columns);
        const bool isKnown = applyInGroup(W.data(), columns);
        poses_.varyState(W.data(), columns);
        return isKnown;
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Lie>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(poses_, adjoint_, step_);
        return true;
    }

private:
    static constexpr bool hasSpheres = std::is_same_v<G, DataGroup>;
    bool isOnSpheres() const {
        if constexpr (hasSpheres) return step_.group().isOnSpheres();
        return false;
    }
    bool applyInGroup(double* W, int columns) {
        return (!isSymmetrised_ || adjoint_.applyTangent(W, columns)) && step_.applyTangent(W, columns);
    }
    LieStep<double, G> adjoint() const {
        return {mechanics_, mirrored_, h_ / 2, isReduced_, 1 - base_, policy_};
    }
    LieStep<double, G> own() const {
        return {mechanics_, table_, isSymmetrised_ ? h_ / 2 : h_, isReduced_, base_, policy_};
    }

    StatePoses<G> poses_;
    typename G::Mechanics mechanics_;
    Table<double> table_, mirrored_;
    SolverPolicy policy_;
    double h_, base_;
    bool isReduced_, isSymmetrised_;
    LieStep<double, G> adjoint_, step_;
    typename G::Pose pose_;  ///< at the end of the last step
};

}  // namespace

Settings lieSpace(int degree, bool isSymmetric, double base) {
    return {"lie-polynomial",
            {{"degree", static_cast<double>(degree)},
             {"symmetric", isSymmetric},
             {"base", base},
             {"reduced", true}},
            {}};
}

Table<double> lieTable(const Settings& space, const Settings& quadrature) {
    static MemoCache<std::pair<Settings, Settings>, Table<double>> known(64);
    return known.get({space, quadrature}, [&] {
        return makeTable(polynomialSpace<double>(space.integer("degree"), PolynomialBasis::lobatto),
                         makeRule<double>(quadrature));
    });
}

std::unique_ptr<Integrator> makeLieIntegrator(const System& system, const Discretization& discretization,
                                              double step) {
    if (discretization.space.type == "quaternion-polynomial")
        return makeQuaternionIntegrator(system, discretization, step);
    const SolverPolicy policy = solverPolicy(discretization.solver, system);
    const auto made = [&]<class G>(std::type_identity<G>, const auto& mechanics, StatePoses<G> poses) {
        return std::make_unique<Lie<G>>(mechanics, std::move(poses), discretization, step, policy);
    };
    using Rotations = RotationGroup<double>;
    if (const LieGroup* const group = system.parts.find<LieGroup>()) {
        const GroupMechanics& on = *group->mechanics;
        if (const auto form = BodyForm::of(on))
            return made(std::type_identity<Rotations>(), form->body(), StatePoses<Rotations>(*form));
        return made(std::type_identity<DataGroup>(), on, StatePoses<DataGroup>(on));
    }
    if (const Spheres* const spheres = system.parts.find<Spheres>())
        return made(std::type_identity<DataGroup>(), *spheres->mechanics,
                    StatePoses<DataGroup>(*spheres->mechanics));
    const BodyMechanics<double>& body = system.body();
    if (body.dimension == 3) return made(std::type_identity<Rotations>(), body, StatePoses<Rotations>(body));
    using Motions = MotionGroup<double>;
    return made(std::type_identity<Motions>(), body, StatePoses<Motions>(body));
}

}  // namespace extremal
