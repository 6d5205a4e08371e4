// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/mechanism_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/core/algebra/exact_sum.hpp"
#include "engine/integrator/variation/hessian_pull.hpp"
#include "engine/integrator/variation/transposed_step.hpp"
#include "engine/mechanism/dense_equations.hpp"
#include "engine/mechanism/linked_equations.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/mechanism/mechanism_equations.hpp"
#include "engine/mechanism/said_of_forces.hpp"
#include "engine/mechanism/step_adjoint.hpp"
#include "engine/mechanism/step_correction.hpp"
#include "engine/mechanism/step_start.hpp"
#include "engine/mechanism/step_variation.hpp"
#include "engine/mechanism/sweep/mechanism_sweeps.hpp"
#include "engine/mechanism/varied_step.hpp"
#include "engine/solve/contraction.hpp"
#include "engine/solve/step_continuation.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
constexpr int mostVaried = 64;  ///< coordinates, of a tangent map with full matrices

class MechanismStep final : public Integrator, public VariedStep, public TransposedStep {
public:
    MechanismStep(const Parts& parts, const Table<double>& table, const MechanismRules& rules, double step,
                  const SolverPolicy& policy, LinkedAlgebra algebra)
        : mechanism_(parts, algebra),
          shared_(std::make_shared<MechanismCurve>(table, rules, mechanism_.dimension())),
          curve_(*shared_),
          policy_(policy),
          tolerance_(toleranceOf<double>(policy)),
          h_(step),
          continues_(curve_.table.extrapolation.size() > 0),
          sweeps_(mechanism_, curve_, step, policy),
          said_(parts, mechanism_.dimension()),
          correction_(mechanism_.dimension(), curve_.unknowns(), mechanism_.constraints()) {
        const int d = dimension(), m = curve_.unknowns(), n = constraints();
        Y_ = Vector::Zero(m * d);
        impulses_ = Vector::Zero(m * n);
        residual_ = Vector::Zero(m * (d + n));
        z_ = Vector::Zero((m + 1) * d);
        p0_ = q1_ = p1_ = carryQ_ = carryP_ = endVelocity_ = keptQ_ = keptP_ = Vector::Zero(d);
        last_.take(Y_, impulses_, Vector::Zero(d));
        forces_ = increment_ = impulse_ = Vector::Zero(d);
        if (!sweeps_.exist()) equations();
        node_ = gradient_ = Vector::Zero(2 * d);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }

    void begin(State& state) override {
        state.memory.clear();
        previousStep_ = 0;
        carryQ_.setZero();
        carryP_.setZero();
    }

    StepReport advance(State& state, double until) override {
        const int d = dimension();
        report_ = StepReport{};
        report_.step = h_;
        start_ = state.t;
        const Eigen::Map<const Vector> q(state.x.data(), d), p(state.x.data() + d, d);
        const bool isNext = q == q1_ && p == p1_;
        if (!isNext) {
            carryQ_.setZero();
            carryP_.setZero();
        }
        z_.head(d) = q;
        p0_ = p;
        report_.outcome = solve(isNext && previousStep_ == h_);
        if (report_.outcome != Outcome::converged) return report_;
        keptQ_ = carryQ_;
        keptP_ = carryP_;
        if (!finish()) {
            carryQ_ = keptQ_;
            carryP_ = keptP_;
            report_.outcome = Outcome::singular;
            return report_;
        }
        if (!sweeps_.haveSolved()) last_.take(Y_, impulses_, equations_->masses());
        previousStep_ = h_;
        Eigen::Map<Vector>(state.x.data(), d) = q1_;
        Eigen::Map<Vector>(state.x.data() + d, d) = p1_;
        state.t = until;
        ++state.node;
        return report_;
    }

    /// The curve, and L_v of its velocity.
    void denseOutput(double tau, std::span<double> x) const override {
        const int d = dimension();
        if (tau <= 0 || tau >= 1) {
            for (int k = 0; k < d; ++k) {
                x[static_cast<std::size_t>(k)] = tau <= 0 ? z_(k) : q1_(k);
                x[static_cast<std::size_t>(d + k)] = tau <= 0 ? p0_(k) : p1_(k);
            }
            return;
        }
        completeCurve();
        const int part = curve_.partOf(tau);
        if (part >= 0)
            onCurve(tau, atParts(), part, x);
        else
            onCurve(tau, curve_.samples({tau}), 0, x);
    }

    std::size_t tangentSize() const override {
        return dimension() <= mostVaried ? 2 * static_cast<std::size_t>(dimension()) : 0;
    }
    std::string tangentProblem() const override {
        return "steps with constraints or forces are varied for up to " + std::to_string(mostVaried) +
               " coordinates";
    }
    bool applyTangent(std::span<double> W) override {
        const Eigen::Index rows = 2 * dimension(), columns = static_cast<Eigen::Index>(W.size()) / rows;
        Eigen::Map<Eigen::MatrixXd> given(W.data(), rows, columns);
        Eigen::MatrixXd moved = given;
        const Eigen::RowVectorXd fixed = Eigen::RowVectorXd::Zero(columns);
        if (!vary(moved, fixed, fixed)) return false;
        given = moved;
        return true;
    }
    bool vary(Eigen::MatrixXd& W, const Eigen::RowVectorXd& start,
              const Eigen::RowVectorXd& length) override {
        using Matrix = Eigen::MatrixXd;
        const int d = dimension(), m = curve_.unknowns(), n = constraints();
        const Eigen::Index columns = W.cols();
        if (!haveFactorsAtSolution()) return false;
        if (!variation_) variation_.emplace(mechanism_, curve_);
        Matrix z = Matrix::Zero((m + 1) * d, columns), impulses = Matrix::Zero(m * n, columns);
        z.topRows(d) = W.topRows(d);
        const StepVariation::Step step{start_, h_, z_, impulses_};
        const StepVariation::Directions along{z, impulses, start, length};
        variation_->evaluate(step, along);
        Vector x;
        for (Eigen::Index c = 0; c < columns; ++c) {
            x = variation_->residual().col(c);
            x.segment((m - 1) * d, d) += W.col(c).tail(d);
            equations().solve(x);
            z.col(c).tail(m * d) = -x.head(m * d);
            impulses.col(c) = -x.tail(m * n);
        }
        variation_->evaluate(step, along);
        const Matrix dq = z.topRows(d) + z.middleRows(m * d, d);
        Matrix dp = W.bottomRows(d) + variation_->impulse();
        if (isProjected() &&
            !mechanism_.varyProjection(start_ + h_, q1_.data(), endVelocity_, kappa_, dq, start + length, dp))
            return false;
        W.topRows(d) = dq;
        W.bottomRows(d) = dp;
        return W.allFinite();
    }

    bool applyTransposed(std::span<double> W) override {
        if (!pull_) pull_.emplace(mechanism_.mechanics(), mechanism_.force());
        pull_->beginStep(static_cast<int>(W.size() / tangentSize()));
        return pullBack(W, *pull_);
    }
    bool hasNodes() const override { return constraints() == 0; }
    void visitNodes(const std::function<void(const NodePull::Node&)>& visit) override {
        completeCurve();
        adjoint().visit({start_, h_, z_, impulses_}, visit);
    }
    bool pullBack(std::span<double> W, NodePull& pull) override {
        const auto rows = static_cast<Eigen::Index>(tangentSize());
        const Eigen::Map<Eigen::MatrixXd> columns(W.data(), rows, static_cast<Eigen::Index>(W.size()) / rows);
        return haveFactorsAtSolution() &&
               (!isProjected() ||
                mechanism_.transposeProjection(start_ + h_, q1_.data(), endVelocity_, kappa_, columns)) &&
               adjoint().apply({start_, h_, z_, impulses_}, equations(), pull, columns);
    }

    double discreteEnergy() const override {
        completeCurve();
        const Table<double>& table = curve_.table;
        const auto& L = mechanism_.mechanics();
        const int d = dimension();
        double sum = 0;
        for (int i = 0; i < table.nodes(); ++i) {
            curve_.motionAt(curve_.atLagrangian, z_, i, h_, node_);
            const double* const x = node_.data();
            const double t = start_ + table.node(i) * h_;
            L.gradient(L.model.get(), t, x, x + d, gradient_.data());
            sum += table.weight(i) * L.energy(L.model.get(), t, x, gradient_.data() + d);
        }
        return sum;
    }

    /// The work of forces and of constraints that move with time, in the last step, and what forces do
    /// besides (said_of_forces.hpp).
    std::span<const Quantity> quantities() const override { return said_.quantities(); }
    void measure(const State&, double* values) const override {
        std::fill_n(values, said_.quantities().size(), 0.0);
        if (mechanism_.force()) {
            completeCurve();
            said_.addForces(forMeasures(), curve_, {start_, h_, z_}, values);
        }
        if (mechanism_.rolling() || (mechanism_.constraint() && mechanism_.constraint()->isTimeDependent))
            values[SaidOfForces::work] += said_.workOfConstraints(
                forMeasures(), curve_, {start_, h_, z_}, impulses_, isProjected() ? &kappa_ : nullptr);
    }

    std::string about() const override { return equations_ ? equations_->about() : std::string(); }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MechanismStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(carryQ_, carryP_, q1_, p1_, last_, previousStep_, ladder_);
        sweeps_.checkpoint(archive);
        return true;
    }

private:
    /// A new matrix of this size costs as much as so many corrections save.
    static double worth(Eigen::Index size) { return 4 + static_cast<double>(size) / 16; }

    const MechanismCurve::Samples& atParts() const {
        if (!atParts_) atParts_ = curve_.atParts();
        return *atParts_;
    }
    int dimension() const { return mechanism_.dimension(); }
    int constraints() const { return mechanism_.constraints(); }
    /// Whether p at the end is moved onto the conditions.
    bool isProjected() const { return constraints() > 0 && !curve_.isRollingAtGauss; }

    /// (q, L_v) at tau, with the functions there in a row of `at`.
    void onCurve(double tau, const MechanismCurve::Samples& at, int row, std::span<double> x) const {
        const int d = dimension();
        curve_.motionAt(at, row, z_, h_, node_);
        const auto& L = mechanism_.mechanics();
        L.gradient(L.model.get(), start_ + tau * h_, node_.data(), node_.data() + d, gradient_.data());
        std::copy_n(node_.data(), d, x.data());
        std::copy_n(gradient_.data() + d, d, x.data() + d);
    }

    /// By sweeps where they apply and converge, or else by Newton's method.
    Outcome solve(bool hasPrevious) {
        if (!sweeps_.exist()) return byNewton(hasPrevious);
        const bool wasBySweeps = sweeps_.haveSolved();
        const Outcome outcome = sweeps_.solve(
            {start_, h_, z_.data(), p0_.data(), carryQ_.data(), carryP_.data(), hasPrevious, stop()},
            mechanism_, motion_, report_);
        if (outcome == Outcome::converged)
            areFactorsHere_ = isEvaluatedHere_ = isCurveHere_ = areReactionsHere_ = false;
        return outcome == Outcome::converged || outcome == Outcome::stopped
                   ? outcome
                   : byNewton(hasPrevious && !wasBySweeps);
    }

    /// Newton's method from the last curve, or else from what is known at the start, and a second opinion
    /// where its root is far from that.
    Outcome byNewton(bool hasPrevious) {
        correction_.begin();
        if (continues_ && ladder_.begin(hasPrevious) == StartingValue::extrapolated &&
            last_.goOn(curve_, Y_, impulses_)) {
            const Outcome outcome = newton(h_, farFromRoot);
            if (outcome == Outcome::stopped || (outcome == Outcome::converged && nearness_ <= farFromRoot))
                return outcome;
            ladder_.below(StartingValue::extrapolated, false);
        }
        Outcome outcome = startFresh(h_) ? newton(h_) : Outcome::singular;
        if (outcome == Outcome::stopped) return outcome;
        if (outcome == Outcome::converged && nearness_ <= farFromRoot) return outcome;
        const Vector found = Y_;
        const bool wasFound = outcome == Outcome::converged;
        StepContinuation<double> continuation;
        const bool hasArrived = continuation.follow(Y_, [&](double part, bool isFresh) {
            if (stop().stop_requested()) return false;
            if (isFresh && !startFresh(part * h_)) return false;
            motion_.impulses(curve_, part * h_, mechanism_.holonomic(), impulses_);
            return newton(part * h_) == Outcome::converged && nearness_ <= farFromRoot;
        });
        if (stop().stop_requested()) return Outcome::stopped;
        if (hasArrived) return Outcome::converged;
        if (!wasFound) return outcome;
        // Short steps do not lead there: what was found may be another assembly.
        Y_ = found;
        return Outcome::lost;
    }

    bool startFresh(double h) {
        if (!motion_.take(mechanism_, start_, z_.data(), p0_.data(), report_)) return false;
        motion_.curve(curve_, h, Y_);
        motion_.impulses(curve_, h, mechanism_.holonomic(), impulses_);
        return true;
    }

    /// Those of Newton's method, which steps by sweeps mostly do without.
    MechanismEquations& equations() {
        if (!equations_)
            equations_ = OwnCopy<MechanismEquations>(mechanism_.linked()
                                                         ? linkedEquations(*mechanism_.linked(), curve_)
                                                         : denseEquations(mechanism_, shared_));
        return *equations_;
    }
    StepAdjoint& adjoint() {
        if (!adjoint_) adjoint_.emplace(mechanism_, shared_);
        return *adjoint_;
    }
    Outcome factorise() {
        report_.cost.evaluations += curve_.table.nodes();
        ++report_.cost.linearSolves;
        return equations().factorise();
    }

    bool evaluate(double h) {
        z_.tail(Y_.size()) = Y_;
        return evaluateHere(h);
    }
    bool evaluateHere(double h) {
        report_.cost.evaluations += curve_.table.nodes();
        return isEvaluatedHere_ = equations().evaluate(start_, h, z_, p0_, impulses_);
    }

    /// The curve, which sweeps leave to be asked for.
    void completeCurve() const {
        if (!sweeps_.haveSolved() || isCurveHere_) return;
        sweeps_.curve(z_.tail(Y_.size()));
        isCurveHere_ = true;
    }
    /// What Newton's method knows at the solution and sweeps do without.
    void completeStep() {
        completeCurve();
        if (!sweeps_.haveSolved() || areReactionsHere_ || !isProjected()) return;
        sweeps_.multipliers(start_, z_.data(), impulses_);
        areReactionsHere_ = true;
        takeEndVelocity();
        Vector p = p0_ + impulse_;
        mechanism_.project(start_ + h_, q1_.data(), p.data(), endVelocity_, kappa_, true);
    }
    /// v at the end of the curve.
    void takeEndVelocity() {
        const int d = dimension();
        endVelocity_.setZero();
        for (int a = 0; a < curve_.unknowns(); ++a)
            endVelocity_ += curve_.endSlope(0, a) / h_ * z_.segment((a + 1) * d, d);
    }

    /// The factors at the solution.
    bool haveFactorsAtSolution() {
        completeStep();
        if (!areFactorsHere_)
            areFactorsHere_ =
                (isEvaluatedHere_ || evaluateHere(h_)) && equations().factorise() == Outcome::converged;
        return areFactorsHere_;
    }

    /// Newton's method, with factors that are kept while corrections shrink well. Given up at once where the
    /// first correction shows the root to be farther away than `farthest`.
    Outcome newton(double h, double farthest = std::numeric_limits<double>::infinity()) {
        const int d = dimension(), m = curve_.unknowns(), n = constraints();
        const auto limits = NewtonLimits<double>::mechanismStep(tolerance_);
        NewtonPolicy<double> policy(limits);
        Contraction<double> contraction(limits);
        double firstChange = 0;
        bool needsFactors = true;
        for (int iteration = 0; iteration < policy_.maxIterations; ++iteration) {
            if (stop().stop_requested()) return Outcome::stopped;
            if (!evaluate(h)) return Outcome::notFinite;
            areFactorsHere_ = needsFactors;
            if (needsFactors) {
                if (const Outcome factors = factorise(); factors != Outcome::converged) return factors;
                policy.jacobianIsNew();
            }
            residual_ = equations().residual();
            equations().solve(residual_);
            ++report_.cost.linearSolves;
            ++report_.cost.iterations;
            correction_.take(equations(), {h, z_, p0_, impulses_, residual_});
            constexpr int usual = 4;
            if (iteration == usual) correction_.knowReactions();
            report_.residual = correction_.relative();
            // Of equations that are nearly linear on the way there is one root, however far the start was
            // from it.
            if (iteration <= 1) {
                constexpr double linear = 0.02;
                const double near = correction_.inMassMetric(), change = correction_.changeInMassMetric();
                if (iteration == 0 || change <= linear * firstChange) nearness_ = near;
                if (iteration == 0) firstChange = change;
                if (iteration == 0 && nearness_ > farthest) return Outcome::diverged;
            }
            contraction.take(report_.residual, correction_.ofCurve(), correction_.changeInMassMetric());
            const NewtonVerdict verdict =
                policy.judge(report_.residual, [this] { return correction_.apart(); });
            if (const auto end = endOf(verdict)) return *end;
            Y_ -= residual_.head(m * d);
            impulses_ -= residual_.tail(m * n);
            if (contraction.isLast()) return settle(h, contraction.next());
            needsFactors = verdict == NewtonVerdict::slow || correction_.isElsewhere() ||
                           contraction.left() > worth(residual_.size());
        }
        return Outcome::diverged;
    }

    /// The end, with unknowns from which the next correction would move by a part `next`, and A there: to
    /// first order where what that leaves out, which is such a part too, is far below the tolerance.
    Outcome settle(double h, double next) {
        report_.residual = next;
        z_.tail(Y_.size()) = Y_;
        areFactorsHere_ = isEvaluatedHere_ = false;
        const double little = std::max(1e-3 * tolerance_, std::numeric_limits<double>::epsilon());
        if (next <= little && equations().moveImpulse(residual_)) return Outcome::converged;
        return evaluate(h) ? Outcome::converged : Outcome::notFinite;
    }

    /// (q_1, p_1) with what the last sums have lost, and the work.
    bool finish() {
        const int d = dimension();
        const double end = start_ + h_;
        if (sweeps_.haveSolved()) {
            sweeps_.increments(increment_, impulse_, carryQ_, carryP_);
        } else {
            increment_ = Y_.tail(d);
            impulse_ = equations_->impulse();
        }
        for (int k = 0; k < d; ++k) q1_(k) = addExactly(z_(k), increment_(k) + carryQ_(k), carryQ_(k));
        p1_ = p0_ + impulse_;
        if (sweeps_.haveSolved() && sweeps_.project(p1_, forces_)) {
            // As below, without asking for multipliers.
        } else if (isProjected()) {
            completeCurve();
            takeEndVelocity();
            if (!mechanism_.project(end, q1_.data(), p1_.data(), endVelocity_, kappa_, true)) return false;
            mechanism_.reaction(end, q1_.data(), kappa_, forces_);
        } else {
            forces_.setZero();
        }
        for (int k = 0; k < d; ++k)
            p1_(k) = addExactly(p0_(k), impulse_(k) + forces_(k) + carryP_(k), carryP_(k));
        return q1_.allFinite() && p1_.allFinite();
    }

    /// A mechanism with buffers of its own, as those of the step are kept for what comes.
    Mechanism& forMeasures() const {
        if (!measured_) measured_.emplace(mechanism_);
        return *measured_;
    }

    Mechanism mechanism_;
    SharedCurve shared_;
    const MechanismCurve& curve_;
    OwnCopy<MechanismEquations> equations_;
    SolverPolicy policy_;
    double tolerance_, h_;
    Vector Y_, impulses_, residual_;         ///< impulses_: Lambda_j, j < m
    mutable Vector z_;                       ///< (q_0, Y)
    Vector p0_, q1_, p1_, carryQ_, carryP_;  ///< carries: lost to rounding in q_1 and p_1
    Vector keptQ_, keptP_;                   ///< the carries before the step
    StartMotion motion_;
    Vector endVelocity_, kappa_;
    LastCurve last_;           ///< by Newton's method
    double previousStep_ = 0;  ///< its length; 0: there was none
    bool continues_;           ///< whether the curve of a step goes on behind its end
    StartingLadder ladder_;
    /// Whether the last evaluation, and the last factors, are those at the unknowns.
    bool isEvaluatedHere_ = false, areFactorsHere_ = false;
    MechanismSweeps sweeps_;
    /// Whether z_ has the curve of a step by sweeps, and the multipliers are those of it.
    mutable bool isCurveHere_ = false;
    bool areReactionsHere_ = false;
    Vector increment_, impulse_, forces_;                     ///< of (q, p) in a step; reactions at its end
    mutable Vector node_, gradient_;                          ///< of one node
    mutable std::optional<MechanismCurve::Samples> atParts_;  ///< once they are looked at
    std::optional<HessianPull> pull_;
    SaidOfForces said_;
    StepCorrection correction_;
    std::optional<StepAdjoint> adjoint_;
    mutable std::optional<Mechanism> measured_;
    std::optional<StepVariation> variation_;
    double start_ = 0, nearness_ = 0;
    StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> makeMechanismStep(const Parts& parts, const Table<double>& table,
                                              const MechanismRules& rules, double step,
                                              const SolverPolicy& policy, LinkedAlgebra algebra) {
    return std::make_unique<MechanismStep>(parts, table, rules, step, policy, algebra);
}

}  // namespace extremal
