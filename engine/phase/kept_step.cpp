// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/kept_step.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "engine/core/algebra/exact_sum.hpp"
#include "engine/phase/flow_jacobian.hpp"
#include "engine/solve/correction_size.hpp"
#include "engine/solve/fixed_point_policy.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Legendre's polynomials of length 1 on [0, 1], P_0 to P_{s-1}, and their integrals from 0.
void legendre(double tau, int s, double* value, double* integral) {
    const double x = 2 * tau - 1;
    double before = 0, here = 1;  // L_{k-1}, L_k
    for (int k = 0; k < s; ++k) {
        const double after = ((2 * k + 1) * x * here - k * before) / (k + 1), root = std::sqrt(2. * k + 1);
        if (value) value[k] = root * here;
        if (integral) integral[k] = k == 0 ? tau : (after - before) / (2 * root);
        before = here;
        here = after;
    }
}

/// The basis at the nodes of a rule, and the projection from values there.
struct ProjectionTable {
    ProjectionTable(int degree, const Rule<double>& rule) : s(degree), u(rule.size()) {
        value = integral = ahead = Matrix::Zero(u, s);
        std::vector<double> P(static_cast<std::size_t>(s)), I(P);
        for (int i = 0; i < u; ++i) {
            const double c = rule.c[static_cast<std::size_t>(i)];
            legendre(c, s, P.data(), I.data());
            value.row(i) = Eigen::Map<const Vector>(P.data(), s).transpose();
            integral.row(i) = Eigen::Map<const Vector>(I.data(), s).transpose();
            legendre(1 + c, s, P.data(), nullptr);
            ahead.row(i) = Eigen::Map<const Vector>(P.data(), s).transpose();
        }
        const Eigen::Map<const Vector> b(rule.b.data(), u);
        const Matrix tested = value.transpose() * b.asDiagonal();
        project = (tested * value).partialPivLu().solve(tested);
        at = Eigen::Map<const Vector>(rule.c.data(), u);
    }
    int s, u;
    Matrix value, integral, ahead;  ///< (i, k); ahead: P_k at the nodes of the next step
    Matrix project;                 ///< (k, i)
    Vector at;
};

class KeptStep final : public Integrator {
public:
    KeptStep(const Mechanics<double>& flow, std::vector<Invariant> invariants, int degree,
             const Rule<double>& rule, double step, const SolverPolicy& policy)
        : flow_(flow),
          invariants_(std::move(invariants)),
          table_(degree, rule),
          jacobian_(flow),
          policy_(policy),
          tolerance_(toleranceOf<double>(policy)),
          h_(step),
          n_(2 * flow.dimension) {
        isProjected_ = invariants_.size() != 1 || !invariants_.front().isKeptByProjection;
        alpha_ = newAlpha_ = Matrix::Zero(table_.s, n_);
        places_ = f_ = Matrix::Zero(table_.u, n_);
        for (Vector* v : {&x0_, &x1_, &lost_, &work_, &rate_}) *v = Vector::Zero(n_);
        if (isProjected_) gradients_.assign(invariants_.size(), f_);
        const Eigen::Index size = table_.s * n_;
        system_ = Matrix::Zero(size, size);
        slopes_.assign(static_cast<std::size_t>(table_.u), Matrix::Zero(n_, n_));
        residual_ = Vector::Zero(size);
        lu_ = Eigen::PartialPivLU<Matrix>(size);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }
    void begin(State& state) override {
        state.memory.clear();
        hasCurve_ = false;
        newtonSteps_ = 0;
        lost_.setZero();
    }

    StepReport advance(State& state, double until) override {
        report_ = StepReport{};
        report_.step = h_;
        const Eigen::Map<const Vector> x(state.x.data(), n_);
        const bool isContinued = hasCurve_ && x == x1_;
        if (!isContinued) lost_.setZero();
        start_ = state.t;
        x0_ = x;
        report_.outcome = solve(isContinued && curveStep_ == h_);
        hasCurve_ = report_.outcome == Outcome::converged;
        if (!hasCurve_) return report_;
        for (int k = 0; k < n_; ++k) x1_(k) = addExactly(x0_(k), h_ * alpha_(0, k) + lost_(k), lost_(k));
        if (!x1_.allFinite()) {
            hasCurve_ = false;
            report_.outcome = Outcome::notFinite;
            return report_;
        }
        curveStep_ = h_;
        Eigen::Map<Vector>(state.x.data(), n_) = x1_;
        state.t = until;
        ++state.node;
        return report_;
    }

    void denseOutput(double tau, std::span<double> x) const override {
        Eigen::Map<Vector> to(x.data(), n_);
        to = tau >= 1 ? x1_ : x0_;
        if (tau <= 0 || tau >= 1) return;
        std::vector<double> integral(static_cast<std::size_t>(table_.s));
        legendre(tau, table_.s, nullptr, integral.data());
        for (int k = 0; k < table_.s; ++k)
            to += h_ * integral[static_cast<std::size_t>(k)] * alpha_.row(k).transpose();
    }

    std::size_t tangentSize() const override { return isProjected_ ? 0 : static_cast<std::size_t>(n_); }
    std::string tangentProblem() const override {
        return "the projection that takes out what would change invariants has derivatives that are not "
               "known";
    }
    bool applyTangent(std::span<double> W) override {
        const Eigen::Index columns = static_cast<Eigen::Index>(W.size()) / n_;
        Eigen::Map<Matrix> w(W.data(), n_, columns);
        place();
        if (!linearise()) return false;
        Matrix rhs = Matrix::Zero(system_.rows(), columns);
        for (int i = 0; i < table_.u; ++i) {
            const Matrix moved = slopes_[static_cast<std::size_t>(i)] * w;
            for (int k = 0; k < table_.s; ++k) rhs.middleRows(k * n_, n_) += table_.project(k, i) * moved;
        }
        w += h_ * lu_.solve(rhs).topRows(n_);
        return w.allFinite();
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<KeptStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(alpha_, x1_, lost_, hasCurve_, curveStep_, newtonSteps_);
        return true;
    }

private:
    Outcome solve(bool isContinued) {
        if (isContinued) {
            f_.noalias() = table_.ahead.lazyProduct(alpha_);
            alpha_.noalias() = table_.project.lazyProduct(f_);
            const Outcome attempt = iterate();
            if (attempt == Outcome::converged || attempt == Outcome::stopped) return attempt;
        }
        if (!evaluate(x0_, start_)) return Outcome::singular;
        alpha_.setZero();
        alpha_.row(0) = rate_.transpose();
        return iterate();
    }

    /// By the fixed point, and where that is slow by Newton's method, for as many steps as that is likely.
    Outcome iterate() {
        constexpr int most = 200, stepsWithNewton = 20;
        if (policy_.method != SolverMethod::newton && newtonSteps_ == 0) {
            FixedPointPolicy<double> policy(tolerance_);
            const Outcome attempt = repeat(most, policy, [&] { alpha_.swap(newAlpha_); });
            if (attempt != Outcome::diverged || policy_.method == SolverMethod::fixedPoint) return attempt;
            newtonSteps_ = stepsWithNewton;
        }
        if (newtonSteps_ > 0) --newtonSteps_;
        bool isFirst = true;
        FixedPointPolicy<double> policy(tolerance_);
        return repeat(policy_.maxIterations, policy, [&] {
            if (isFirst && !linearise()) alpha_.setConstant(std::numeric_limits<double>::quiet_NaN());
            isFirst = false;
            for (int k = 0; k < table_.s; ++k)
                residual_.segment(k * n_, n_) = (newAlpha_.row(k) - alpha_.row(k)).transpose();
            residual_ = lu_.solve(residual_).eval();
            for (int k = 0; k < table_.s; ++k) alpha_.row(k) += residual_.segment(k * n_, n_).transpose();
        });
    }
    template <class Update>
    Outcome repeat(int most, FixedPointPolicy<double>& policy, Update&& update) {
        using Verdict = FixedPointPolicy<double>::Verdict;
        for (int sweep = 0; sweep < most; ++sweep) {
            if (stop().stop_requested()) return Outcome::stopped;
            place();
            if (const Outcome trouble = evaluateNodes(); trouble != Outcome::converged) return trouble;
            newAlpha_.noalias() = table_.project.lazyProduct(f_);
            ++report_.cost.iterations;
            report_.residual = change();
            const Verdict verdict = policy.judge(report_.residual);
            if (verdict == Verdict::notFinite) return Outcome::notFinite;
            if (verdict == Verdict::slow) return Outcome::diverged;
            update();
            if (verdict == Verdict::converged) return Outcome::converged;
        }
        return Outcome::diverged;
    }
    double change() const {
        const double h = std::abs(h_);
        double worst = 0;
        for (int k = 0; k < n_; ++k)
            worst = std::max(worst,
                             relativeCorrection(h * (newAlpha_.col(k) - alpha_.col(k)).cwiseAbs().maxCoeff(),
                                                h * std::max(newAlpha_.col(k).cwiseAbs().maxCoeff(),
                                                             alpha_.col(k).cwiseAbs().maxCoeff()),
                                                x0_(k)));
        return worst;
    }

    void place() {
        places_.noalias() = table_.integral.lazyProduct(alpha_);
        for (int k = 0; k < n_; ++k) places_.col(k) = (h_ * places_.col(k)).array() + x0_(k);
    }
    bool evaluate(const Vector& x, double t) {
        const int d = n_ / 2;
        ++report_.cost.evaluations;
        return flow_.flow(flow_.model.get(), t, x.data(), x.data() + d, rate_.data(), rate_.data() + d);
    }
    /// f at the nodes, without what would change the invariants.
    Outcome evaluateNodes() {
        const int d = n_ / 2;
        for (int i = 0; i < table_.u; ++i) {
            work_ = places_.row(i).transpose();
            if (!evaluate(work_, start_ + table_.at(i) * h_)) return Outcome::singular;
            f_.row(i) = rate_.transpose();
            for (std::size_t a = 0; a < gradients_.size(); ++a) {
                if (!invariants_[a].gradient) {
                    gradients_[a].row(i) << -rate_.tail(d).transpose(), rate_.head(d).transpose();
                    continue;
                }
                invariants_[a].gradient(work_.data(), rate_.data());
                gradients_[a].row(i) = rate_.transpose();
                for (int k = 0; k < n_; ++k) rate_(k) = f_(i, k);
            }
        }
        return isProjected_ ? takeOut() : Outcome::converged;
    }
    Outcome takeOut() {
        constexpr double singular = 1e-13;
        for (Matrix& each : gradients_) {
            newAlpha_.noalias() = table_.project.lazyProduct(each);
            each.noalias() = table_.value.lazyProduct(newAlpha_);
        }
        const auto m = static_cast<Eigen::Index>(gradients_.size());
        gram_.resize(m, m);
        share_.resize(m);
        for (int i = 0; i < table_.u; ++i) {
            for (Eigen::Index a = 0; a < m; ++a) {
                const auto& ga = gradients_[static_cast<std::size_t>(a)];
                share_(a) = ga.row(i).dot(f_.row(i));
                for (Eigen::Index b = 0; b < m; ++b)
                    gram_(a, b) = ga.row(i).dot(gradients_[static_cast<std::size_t>(b)].row(i));
            }
            // Of gradients of length 1, so that the pivots tell how far they are from dependent.
            for (Eigen::Index a = 0; a < m; ++a) length_(a) = std::sqrt(gram_(a, a));
            for (Eigen::Index a = 0; a < m; ++a) {
                share_(a) /= length_(a);
                for (Eigen::Index b = 0; b < m; ++b) gram_(a, b) /= length_(a) * length_(b);
            }
            gramLu_.compute(gram_);
            if (!gram_.allFinite()) return Outcome::notFinite;
            if (gramLu_.info() != Eigen::Success || !(gramLu_.vectorD().minCoeff() > singular))
                return Outcome::singular;
            share_ = gramLu_.solve(share_).eval();
            for (Eigen::Index a = 0; a < m; ++a)
                f_.row(i) -= share_(a) / length_(a) * gradients_[static_cast<std::size_t>(a)].row(i);
        }
        return Outcome::converged;
    }

    /// I - h Pi f' Psi at the places of the nodes, factorised.
    bool linearise() {
        const int d = n_ / 2;
        system_.setIdentity();
        for (int i = 0; i < table_.u; ++i) {
            work_ = places_.row(i).transpose();
            const double t = start_ + table_.at(i) * h_;
            if (!flow_.flow(flow_.model.get(), t, work_.data(), work_.data() + d, rate_.data(),
                            rate_.data() + d))
                return false;
            Matrix& slope = slopes_[static_cast<std::size_t>(i)];
            slope = jacobian_.evaluate(t, work_.data(), work_.data() + d, rate_.data());
            for (int k = 0; k < table_.s; ++k)
                for (int l = 0; l < table_.s; ++l)
                    system_.block(k * n_, l * n_, n_, n_) -=
                        (h_ * table_.project(k, i) * table_.integral(i, l)) * slope;
        }
        if (!system_.allFinite()) return false;
        lu_.compute(system_);
        return true;
    }

    Mechanics<double> flow_;
    std::vector<Invariant> invariants_;
    ProjectionTable table_;
    FlowJacobian jacobian_;
    SolverPolicy policy_;
    double tolerance_, h_;
    int n_;                     ///< entries of x
    bool isProjected_ = false;  ///< more than the energy alone
    Matrix alpha_, newAlpha_;   ///< coefficients of x', function k, entry j
    Matrix places_, f_;         ///< node i, entry j
    std::vector<Matrix> gradients_;
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;
    using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;
    Small gram_;
    SmallVector share_, length_ = SmallVector::Zero(8);
    /// Computed from the start: a copy reads its state, which is not set before.
    Eigen::LDLT<Small> gramLu_{Small::Identity(1, 1)};
    Vector x0_, x1_, lost_, work_, rate_, residual_;
    std::vector<Matrix> slopes_;
    Matrix system_;
    Eigen::PartialPivLU<Matrix> lu_;
    double start_ = 0, curveStep_ = 0;
    bool hasCurve_ = false;
    int newtonSteps_ = 0;
    StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> makeKeptStep(const Mechanics<double>& flow, std::vector<Invariant> invariants,
                                         int degree, const Rule<double>& rule, double step,
                                         const SolverPolicy& policy) {
    return std::make_unique<KeptStep>(flow, std::move(invariants), degree, rule, step, policy);
}

}  // namespace extremal
