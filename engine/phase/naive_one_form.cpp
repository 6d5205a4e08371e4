// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/naive_one_form.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"
#include "engine/quadrature/collocation.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

class NaiveOneForm final : public Integrator {
public:
    NaiveOneForm(const OneForm& form, int degree, bool isProjected, double step)
        : form_(form),
          equations_(form),
          m_(form.variables),
          s_(degree),
          isProjected_(isProjected),
          h_(step),
          rule_(gauss<double>(degree)),
          A_(collocationMatrix(rule_)) {
        const Eigen::Index size = m_ * s_;
        V_ = X_ = F_ = Matrix::Zero(m_, s_);
        theta_ = gradient_ = p0_ = p1_ = x0_ = x1_ = x2_ = change_ = difference_ = Vector::Zero(m_);
        slopes_.assign(static_cast<std::size_t>(s_), Matrix::Zero(m_, m_));
        forces_ = slopes_;
        hessian_ = Matrix::Zero(m_, m_);
        curvatures_.assign(static_cast<std::size_t>(m_ * m_ * m_), 0);
        residual_ = Vector::Zero(size);
        system_ = Matrix::Zero(size, size);
        lu_ = Eigen::PartialPivLU<Matrix>(size);
        small_ = Eigen::PartialPivLU<Matrix>(m_);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }
    std::vector<MemoryPart> memoryParts() const override {
        if (isProjected_) return {};
        return {{"p", static_cast<std::size_t>(m_)}};
    }
    void begin(State& state) override {
        state.memory.clear();
        if (isProjected_) return;
        p0_ = thetaAt(Eigen::Map<const Vector>(state.x.data(), m_), slopes_[0]);
        state.memory.assign(p0_.begin(), p0_.end());
    }

    StepReport advance(State& state, double until) override {
        StepReport report;
        report.step = h_;
        x0_ = Eigen::Map<const Vector>(state.x.data(), m_);
        if (!isProjected_ && state.memory.size() == static_cast<std::size_t>(m_))
            p0_ = Eigen::Map<const Vector>(state.memory.data(), m_);
        else
            p0_ = thetaAt(x0_, slopes_[0]);
        if (!equations_.rate(x0_.data(), change_.data())) {
            report.outcome = Outcome::singular;
            return report;
        }
        for (int i = 0; i < s_; ++i) V_.col(i) = change_;
        report.outcome = solveByCorrections({}, stop(), report, [&](int, double) { return correct(report); });
        if (report.outcome != Outcome::converged) return report;
        x1_ = x0_;
        p1_ = p0_;
        evaluate(report);
        for (int i = 0; i < s_; ++i) {
            const double b = h_ * rule_.b[static_cast<std::size_t>(i)];
            x1_ += b * V_.col(i);
            p1_ += b * F_.col(i);
        }
        difference_ = p1_ - thetaAt(x1_, slopes_[0]);
        if (isProjected_) report.outcome = project(report);
        if (report.outcome == Outcome::converged && !(x1_.allFinite() && p1_.allFinite()))
            report.outcome = Outcome::notFinite;
        if (report.outcome != Outcome::converged) return report;
        Eigen::Map<Vector>(state.x.data(), m_) = x1_;
        if (!isProjected_) state.memory.assign(p1_.begin(), p1_.end());
        state.t = until;
        ++state.node;
        return report;
    }

    /// The straight line: what happens here happens from node to node.
    void denseOutput(double tau, std::span<double> x) const override {
        Eigen::Map<Vector>(x.data(), m_) = (1 - tau) * x0_ + tau * x1_;
    }

    std::span<const Quantity> quantities() const override {
        static const Quantity known{"one_form_constraint", "", "|p − θ(x)|", ""};
        return {&known, 1};
    }
    /// Before the projection, where there is one.
    void measure(const State&, double* values) const override { values[0] = difference_.norm(); }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<NaiveOneForm>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(x0_, x1_, difference_);
        return true;
    }

private:
    /// theta, and its slopes d theta_i / dx_k as (i, k).
    const Vector& thetaAt(const Vector& x, Matrix& slopes) {
        form_.form(form_.model.get(), x.data(), theta_.data(), slopes.data(), nullptr);
        slopes.transposeInPlace();
        return theta_;
    }
    /// X and F at the nodes, theta' and dF/dx there.
    void evaluate(StepReport& report) {
        X_.noalias() = h_ * V_ * A_.transpose();
        X_.colwise() += x0_;
        double value = 0;
        for (int i = 0; i < s_; ++i) {
            Matrix &slope = slopes_[static_cast<std::size_t>(i)],
                   &change = forces_[static_cast<std::size_t>(i)];
            form_.form(form_.model.get(), X_.col(i).data(), theta_.data(), slope.data(), curvatures_.data());
            slope.transposeInPlace();
            form_.energy(form_.model.get(), X_.col(i).data(), &value, gradient_.data(), hessian_.data());
            F_.col(i) = slope.transpose() * V_.col(i) - gradient_;
            change = -hessian_;
            for (int j = 0; j < m_; ++j)
                change += V_(j, i) * Eigen::Map<const Matrix>(curvatures_.data() + j * m_ * m_, m_, m_);
            places(i) = theta_ - p0_;
            ++report.cost.evaluations;
        }
    }
    Eigen::VectorBlock<Vector> places(int i) { return residual_.segment(i * m_, m_); }

    /// One step of Newton's method in V.
    Correction correct(StepReport& report) {
        evaluate(report);
        system_.setZero();
        for (int j = 0; j < s_; ++j)
            for (int i = 0; i < s_; ++i) {
                places(j) -= h_ * A_(j, i) * F_.col(i);
                const auto at = static_cast<std::size_t>(i);
                for (int l = 0; l < s_; ++l)
                    system_.block(j * m_, l * m_, m_, m_) -= h_ * h_ * A_(j, i) * A_(i, l) * forces_[at];
                system_.block(j * m_, i * m_, m_, m_) +=
                    h_ * A_(j, i) * (slopes_[static_cast<std::size_t>(j)] - slopes_[at].transpose());
            }
        lu_.compute(system_);
        ++report.cost.linearSolves;
        residual_ = lu_.solve(residual_).eval();
        Correction made;
        made.size = residual_.cwiseAbs().maxCoeff();
        for (int i = 0; i < s_; ++i) V_.col(i) -= places(i);
        made.scale = V_.cwiseAbs().maxCoeff();
        return made;
    }
    /// x with theta(x) + theta'(x)^T (x~ - x) = p~, by Newton's method with the matrix of the form.
    Outcome project(StepReport& report) {
        x2_ = x1_;
        Matrix& slope = slopes_[0];
        const Outcome outcome = solveByCorrections({}, stop(), report, [&](int, double) {
            gradient_ = thetaAt(x1_, slope);
            gradient_ += slope.transpose() * (x2_ - x1_) - p1_;
            small_.compute(slope - slope.transpose());
            change_ = small_.solve(gradient_);
            x1_ -= change_;
            return Correction{change_.cwiseAbs().maxCoeff(), x1_.cwiseAbs().maxCoeff()};
        });
        p1_ = thetaAt(x1_, slope);
        return outcome;
    }

    OneForm form_;
    OneFormEquations equations_;
    int m_, s_;
    bool isProjected_;
    double h_;
    Rule<double> rule_;
    Matrix A_;
    Matrix V_, X_, F_;  ///< entry, node
    Vector theta_, gradient_, p0_, p1_, x0_, x1_, x2_, change_, difference_,
        residual_;  ///< x2: before the projection
    std::vector<Matrix> slopes_, forces_;
    std::vector<double> curvatures_;
    Matrix hessian_, system_;
    Eigen::PartialPivLU<Matrix> lu_, small_;
};

}  // namespace

std::unique_ptr<Integrator> makeNaiveOneForm(const OneForm& form, int degree, bool isProjected, double step) {
    return std::make_unique<NaiveOneForm>(form, degree, isProjected, step);
}

}  // namespace extremal
