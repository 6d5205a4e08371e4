// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/phase_step.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/core/algebra/exact_sum.hpp"
#include "engine/core/dimension.hpp"
#include "engine/phase/node_guess.hpp"
#include "engine/phase/phase_cell.hpp"
#include "engine/phase/phase_lanes.hpp"
#include "engine/phase/phase_newton.hpp"
#include "engine/solve/correction_size.hpp"
#include "engine/solve/fixed_point_policy.hpp"
#include "engine/solve/step_continuation.hpp"

namespace extremal {
namespace {

/// A step and the rates at its nodes, of any dimension.
struct StepAt {
    using Vector = Eigen::Map<const Eigen::VectorXd>;
    using Nodes = Eigen::Map<const Eigen::MatrixXd>;
    double start, h;
    Vector q0, p0;
    Nodes K, F;
};

/// The curve inside a step.
void insideOf(const StepAt& step, const PhaseCell& cell, double tau, double* x) {
    std::vector<double> value(static_cast<std::size_t>(cell.table.space.size)), slope(value.size());
    cell.table.space.evaluate(tau, value, slope);
    const Eigen::VectorXd rates =
        (StepAt::Vector(value.data(), cell.table.space.size).transpose() * cell.table.change * cell.ofRates)
            .transpose();
    const std::vector<double> shares = weightsUpTo(cell.table, tau);
    const StepAt::Vector forces(shares.data(), cell.nodes());
    const Eigen::Index d = step.q0.size();
    Eigen::Map<Eigen::VectorXd>(x, d) = step.q0 + step.h * step.K.transpose().lazyProduct(rates);
    Eigen::Map<Eigen::VectorXd>(x + d, d) = step.p0 + step.h * step.F.transpose().lazyProduct(forces);
}

double actionOf(const StepAt& step, const PhaseCell& cell, const PhaseMechanics& H) {
    const Eigen::MatrixXd rates = cell.slope * (cell.ofRates * step.K);
    double action = 0;
    Eigen::VectorXd q, p;
    for (int i = 0; i < cell.nodes(); ++i) {
        q = step.q0 + step.h * step.K.transpose().lazyProduct(cell.A.row(i).transpose());
        p = cell.fromStart(i) * step.p0 + step.h * step.F.transpose().lazyProduct(cell.B.row(i).transpose());
        const double energy =
            H.energy(H.model.get(), step.start + cell.place(i) * step.h, q.data(), p.data());
        action += step.h * cell.weight(i) * (p.dot(rates.row(i).transpose()) - energy);
    }
    return action;
}

template <int D>
class PhaseStep final : public Integrator {
    using Vector = Eigen::Matrix<double, D, 1>;
    using Nodes = Eigen::Matrix<double, Eigen::Dynamic, D>;  ///< node i, coordinate k
    using View = Eigen::Map<Vector>;

public:
    PhaseStep(const PhaseMechanics& mechanics, const SharedCell& cell, double step,
              const SolverPolicy& policy)
        : H_(mechanics), cell_(cell), policy_(policy), tolerance_(toleranceOf<double>(policy)), h_(step) {
        const int n = cell_->nodes();
        for (Nodes* nodes : {&K_, &F_, &newK_, &newF_, &Q_, &P_}) *nodes = Nodes::Zero(n, d());
        if (cell_->ahead.size() > 0) guess_.emplace(cell_->ahead, d());
        for (Vector* v : {&q0_, &p0_, &q1_, &p1_, &q_, &p_, &lostQ_, &lostP_}) *v = Vector::Zero(d());
        gradient_.assign(static_cast<std::size_t>(2 * d()), 0);
        if (H_.gradients && n > 1) lanes_.emplace(H_, cell_);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }

    void begin(State& state) override {
        state.memory.clear();
        hasCurve_ = false;
        newtonSteps_ = 0;
        lostQ_.setZero();
        lostP_.setZero();
    }

    StepReport advance(State& state, double until) override {
        report_ = StepReport{};
        report_.step = h_;
        const View q(state.x.data(), d()), p(state.x.data() + d(), d());
        const bool isContinued = hasCurve_ && q == q1_ && p == p1_;
        if (!isContinued) {
            if (guess_) guess_->forget();
            lostQ_.setZero();
            lostP_.setZero();
        }
        start_ = state.t;
        q0_ = q;
        p0_ = p;
        report_.outcome = solve(isContinued && curveStep_ == h_);
        hasCurve_ = false;
        if (report_.outcome != Outcome::converged) return report_;
        finish();
        if (!q1_.allFinite() || !p1_.allFinite()) {
            report_.outcome = Outcome::notFinite;
            return report_;
        }
        View(state.x.data(), d()) = q1_;
        View(state.x.data() + d(), d()) = p1_;
        state.t = until;
        ++state.node;
        return report_;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        View q(x.data(), d()), p(x.data() + d(), d());
        if (tau <= 0 || tau >= 1) {
            q = tau <= 0 ? q0_ : q1_;
            p = tau <= 0 ? p0_ : p1_;
            return;
        }
        insideOf(here(), *cell_, tau, x.data());
    }

    std::size_t tangentSize() const override { return static_cast<std::size_t>(2 * d()); }
    bool applyTangent(std::span<double> W) override {
        placeNodes();
        return newton().applyTangent(start_, h_, Q_, P_, W);
    }

    /// S of the last step.
    std::span<const Quantity> quantities() const override {
        static const Quantity action{"action", "", "S", ""};
        return {&action, 1};
    }
    void measure(const State&, double* values) const override { values[0] = actionOf(here(), *cell_, H_); }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<PhaseStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(K_, F_, q1_, p1_, lostQ_, lostP_, hasCurve_, curveStep_, newtonSteps_);
        if (guess_) archive(*guess_);
        return true;
    }

private:
    int d() const { return H_.dimension; }
    PhaseNewton& newton() { return newton_ ? *newton_ : newton_.emplace(H_, cell_); }
    StepAt here() const {
        return {start_,
                h_,
                {q0_.data(), d()},
                {p0_.data(), d()},
                {K_.data(), K_.rows(), d()},
                {F_.data(), F_.rows(), d()}};
    }

    Outcome solve(bool isContinued) {
        if (policy_.method != SolverMethod::newton && newtonSteps_ == 0) {
            Outcome attempt = Outcome::diverged;
            if (isContinued && guess_) {
                guess_->make(K_, F_, newK_, newF_);
                attempt = iterate();
            }
            // What the last step says of this one may be of no use.
            if (attempt == Outcome::diverged || attempt == Outcome::notFinite) {
                startFresh();
                attempt = iterate();
            }
            if (attempt == Outcome::converged || attempt == Outcome::stopped ||
                policy_.method == SolverMethod::fixedPoint)
                return attempt;
            newtonSteps_ = std::max(1, stepsWithNewton * oneByOne / worth());
        }
        if (newtonSteps_ > 0) --newtonSteps_;
        return solveByNewton(isContinued);
    }

    static constexpr int oneByOne = 21;
    /// Sweeps that are worth a step by Newton's method, of some three iterations. With N unknowns one of them
    /// takes the time of N (N + 4)/(8 + 7 d) sweeps over eight nodes together, within a third for d = 1 to 7
    /// and N = 8 to 170 (AVX-512). Not more than a slow contraction leaves exact to the tolerance.
    int worth() const {
        constexpr int most = 120, iterations = 3;
        if (!lanes_) return oneByOne;
        const int N = 2 * cell_->unknowns() * d(), eights = (cell_->nodes() + 7) / 8;
        return std::clamp(iterations * N * (N + 4) / ((8 + 7 * d()) * eights), oneByOne, most);
    }

    /// A constant field.
    void startFresh() {
        if (lanes_) {  // and no other formulas are needed
            lanes_->startAt(start_, q0_.data(), p0_.data());
            lanes_->rates(newK_, newF_);
            ++report_.cost.evaluations;
            return;
        }
        evaluate(start_, q0_, p0_);
        for (int k = 0; k < d(); ++k) {
            newK_.col(k).setConstant(gradient_[static_cast<std::size_t>(d() + k)]);
            newF_.col(k).setConstant(-gradient_[static_cast<std::size_t>(k)]);
        }
    }

    void evaluate(double t, const Vector& q, const Vector& p) {
        H_.gradient(H_.model.get(), t, q.data(), p.data(), gradient_.data());
        ++report_.cost.evaluations;
    }
    /// q and p at the nodes, from K and F.
    void placeNodes() {
        Q_.noalias() = cell_->A.lazyProduct(K_);
        for (int k = 0; k < d(); ++k) Q_.col(k) = (h_ * Q_.col(k)).array() + q0_(k);
        P_.noalias() = cell_->B.lazyProduct(F_);
        for (int k = 0; k < d(); ++k) P_.col(k) = h_ * P_.col(k) + p0_(k) * cell_->fromStart;
    }
    /// newK and newF at the nodes as they are placed.
    void evaluateNodes() {
        for (int i = 0; i < cell_->nodes(); ++i) {
            q_ = Q_.row(i).transpose();
            p_ = P_.row(i).transpose();
            evaluate(start_ + cell_->place(i) * h_, q_, p_);
            for (int k = 0; k < d(); ++k) {
                newF_(i, k) = -gradient_[static_cast<std::size_t>(k)];
                newK_(i, k) = gradient_[static_cast<std::size_t>(d() + k)];
            }
        }
    }

    /// Gives what it has changed, each coordinate against its own increments and the round-off of its value.
    double sweep() {
        if (lanes_) {
            report_.cost.evaluations += cell_->nodes();
            return lanes_->sweep(start_, h_, q0_.data(), p0_.data());
        }
        K_.swap(newK_);
        F_.swap(newF_);
        placeNodes();
        evaluateNodes();
        return change();
    }

    /// From newK and newF to K and F.
    Outcome iterate() {
        using Verdict = FixedPointPolicy<double>::Verdict;
        constexpr int most = 200;  // sweeps
        FixedPointPolicy<double> policy(tolerance_, worth());
        if (lanes_) lanes_->start(newK_, newF_);
        for (int k = 0; k < most; ++k) {
            if (stop().stop_requested()) return Outcome::stopped;
            report_.residual = sweep();
            ++report_.cost.iterations;
            const Verdict verdict = policy.judge(report_.residual);
            if (verdict == Verdict::notFinite) return Outcome::notFinite;
            if (verdict == Verdict::slow) return Outcome::diverged;
            if (verdict == Verdict::converged) {
                if (lanes_) lanes_->rates(newK_, newF_);
                K_.swap(newK_);
                F_.swap(newF_);
                return Outcome::converged;
            }
        }
        return Outcome::diverged;
    }

    double change() const {
        const double h = std::abs(h_);
        double worst = 0;
        const auto look = [&](const auto& now, const auto& then, double value) {
            const double size = h * (now - then).cwiseAbs().maxCoeff(),
                         increments = h * std::max(now.cwiseAbs().maxCoeff(), then.cwiseAbs().maxCoeff());
            worst = std::max(worst, std::isfinite(size) ? relativeCorrection(size, increments, value)
                                                        : std::numeric_limits<double>::infinity());
        };
        for (int k = 0; k < d(); ++k) {
            look(newF_.col(k), F_.col(k), p0_(k));
            look(newK_.col(k), K_.col(k), q0_(k));
        }
        return worst;
    }

    Outcome solveByNewton(bool isContinued) {
        const auto attempt = [&](double h, bool isFresh) {
            if (isFresh) {
                startFresh();
                newton().startFrom(h, newK_, newF_);
            }
            return newton().solve(start_, h, q0_, p0_, tolerance_, policy_.maxIterations, stop(), report_);
        };
        Outcome result = Outcome::diverged;
        if (isContinued && cell_->ahead.size() > 0) {
            newK_.noalias() = cell_->ahead.lazyProduct(K_);
            newF_.noalias() = cell_->ahead.lazyProduct(F_);
            newton().startFrom(h_, newK_, newF_);
            result = attempt(h_, false);
        }
        if (result != Outcome::converged && result != Outcome::stopped) result = attempt(h_, true);
        if (result != Outcome::converged && result != Outcome::stopped) {
            StepContinuation<double> continuation;
            const bool hasArrived = continuation.follow(newton().unknowns(), [&](double part, bool isFresh) {
                return !stop().stop_requested() && attempt(part * h_, isFresh) == Outcome::converged;
            });
            if (hasArrived) result = Outcome::converged;
        }
        if (stop().stop_requested() && result != Outcome::converged) return Outcome::stopped;
        if (result != Outcome::converged) return result;
        newton().place(q0_, p0_, Q_, P_);
        evaluateNodes();
        K_.swap(newK_);
        F_.swap(newF_);
        return Outcome::converged;
    }

    /// (q_1, p_1) with what the last sums have lost.
    void finish() {
        if (guess_) guess_->learn(K_, F_);
        for (int k = 0; k < d(); ++k) {
            const double q = cell_->endRates.dot(K_.col(k)), p = cell_->weight.dot(F_.col(k));
            q1_(k) = addExactly(q0_(k), h_ * q + lostQ_(k), lostQ_(k));
            p1_(k) = addExactly(p0_(k), h_ * p + lostP_(k), lostP_(k));
        }
        hasCurve_ = true;
        curveStep_ = h_;
    }

    PhaseMechanics H_;
    SharedCell cell_;
    std::optional<PhaseNewton> newton_;  ///< made when it is needed
    SolverPolicy policy_;
    double tolerance_, h_;
    Nodes K_, F_, newK_, newF_;  ///< H_p and -H_q at the nodes
    Nodes Q_, P_;
    Vector q0_, p0_, q1_, p1_, q_, p_, lostQ_, lostP_;
    std::vector<double> gradient_;
    std::optional<NodeGuess<D>> guess_;  ///< of the next step; none where its nodes are beyond the space
    std::optional<PhaseLanes> lanes_;    ///< none: node after node
    double start_ = 0, curveStep_ = 0;
    bool hasCurve_ = false;
    int newtonSteps_ = 0;  ///< steps for which Newton's method is preferred
    StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> makePhaseStep(const PhaseMechanics& mechanics, const SharedCell& cell,
                                          double step, const SolverPolicy& policy) {
    return withDimension(mechanics.dimension, [&](auto d) -> std::unique_ptr<Integrator> {
        return std::make_unique<PhaseStep<decltype(d)::value>>(mechanics, cell, step, policy);
    });
}

}  // namespace extremal
