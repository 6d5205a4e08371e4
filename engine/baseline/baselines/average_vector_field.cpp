// SPDX-License-Identifier: GPL-3.0-or-later
/// The average vector field method: z_1 = z_0 + h int_0^1 X_H(z_0 + xi (z_1 - z_0)) dxi, the integral by
/// Gauss points.
///
/// With the exact integral H(z_1) = H(z_0), since (z_1 - z_0) . int grad H = H(z_1) - H(z_0) and J is skew. n
/// points integrate grad H along the chord exactly where H is a polynomial of degree at most 2n; elsewhere
/// the energy error is that of the rule, O(h^(2n+1)) per step. Symmetric, of order 2, not symplectic;
/// quadratic invariants other than H are not kept. Sources: Quispel and McLaren 2008; Celledoni et al. 2012.

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"
#include "engine/phase/flow_jacobian.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/step/coordinate_watch.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal::baselines {
namespace {

template <int D>
class AverageVectorField final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;

public:
    AverageVectorField(const Mechanics<double>& mechanics, double step, int points)
        : Base(mechanics, step), rule_(gauss<double>(points)), jacobian_(mechanics) {
        const int d = this->d();
        for (Vector* v : {&q_, &p_, &dq_, &dp_}) *v = Vector::Zero(d);
        average_ = change_ = residual_ = Eigen::VectorXd::Zero(2 * d);
        system_ = Eigen::MatrixXd::Zero(2 * d, 2 * d);
        lu_ = Eigen::PartialPivLU<Eigen::MatrixXd>(2 * d);
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<AverageVectorField>(*this); }

private:
    void step(double t) override {
        const int d = this->d();
        const double h = this->h();
        this->flow(t, this->q0_, this->p0_, dq_, dp_);
        if (this->report_.outcome != Outcome::converged) return;
        change_ << h * dq_, h * dp_;
        CoordinateWatch watch;
        this->report_.outcome = solveByCorrections(
            CorrectionLimits{}, this->stop(), this->report_, [&](int iteration, double ratio) {
                evaluate(t, iteration == 0 || ratio > 0.1);
                if (this->report_.outcome != Outcome::converged)
                    return Correction{.outcome = this->report_.outcome};
                residual_ = lu_.solve(h * average_ - change_);
                change_ += residual_;
                ++this->report_.cost.linearSolves;
                for (int k = 0; k < d; ++k) {
                    watch.add(residual_(k), change_(k), this->q0_(k));
                    watch.add(residual_(d + k), change_(d + k), this->p0_(k));
                }
                return Correction{residual_.cwiseAbs().maxCoeff(),
                                  std::max({this->q0_.cwiseAbs().maxCoeff(), this->p0_.cwiseAbs().maxCoeff(),
                                            change_.cwiseAbs().maxCoeff()}),
                                  watch.isSettled()};
            });
        if (this->report_.outcome != Outcome::converged) return;
        this->q1_ = this->q0_ + change_.head(d);
        this->p1_ = this->p0_ + change_.tail(d);
    }
    /// The average of X_H along the chord, and, where it is wanted, I - h sum_i b_i c_i DX_H factored.
    void evaluate(double t, bool withJacobian) {
        const int d = this->d();
        const double h = this->h();
        average_.setZero();
        if (withJacobian) system_.setIdentity();
        for (std::size_t i = 0; i < rule_.c.size(); ++i) {
            const double c = rule_.c[i], b = rule_.b[i];
            q_ = this->q0_ + c * change_.head(d);
            p_ = this->p0_ + c * change_.tail(d);
            this->flow(t + c * h, q_, p_, dq_, dp_);
            if (this->report_.outcome != Outcome::converged) return;
            average_.head(d) += b * dq_;
            average_.tail(d) += b * dp_;
            if (!withJacobian) continue;
            system_ -= (h * b * c) * jacobian_.evaluate(t + c * h, q_.data(), p_.data(), dq_.data());
            ++this->report_.cost.evaluations;
        }
        if (withJacobian) lu_.compute(system_);
    }

    /// (1 - h sum_i b_i c_i f'_i) dz_1 = (1 + h sum_i b_i (1 - c_i) f'_i) dz_0, f'_i along the chord.
    bool tangent(double t, typename Base::Columns W) override {
        const double h = this->h();
        change_ << this->q1_ - this->q0_, this->p1_ - this->p0_;
        system_.setIdentity();
        moved_ = W;
        for (std::size_t i = 0; i < rule_.c.size(); ++i) {
            const double c = rule_.c[i], b = rule_.b[i];
            q_ = this->q0_ + c * change_.head(this->d());
            p_ = this->p0_ + c * change_.tail(this->d());
            const Eigen::MatrixXd* const jacobian = this->flowJacobian(t + c * h, q_, p_);
            if (!jacobian) return false;
            system_ -= (h * b * c) * *jacobian;
            moved_.noalias() += (h * b * (1 - c)) * jacobian->lazyProduct(W);
        }
        lu_.compute(system_);
        W = lu_.solve(moved_);
        return true;
    }

    Rule<double> rule_;
    FlowJacobian jacobian_;
    Vector q_, p_, dq_, dp_;
    Eigen::VectorXd average_, change_, residual_;
    Eigen::MatrixXd system_, moved_;
    Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace

BaselineEntry average_vector_field() {
    constexpr int usual = 3;
    BaselineEntry e;
    e.item = {
        "average-vector-field",
        "average vector field",
        "Keeps the energy: exactly where H is a polynomial of degree at most twice the points. Order 2, "
        "symmetric, not symplectic.",
        {integerField("points", "n", 1, 16, usual, "Gauss points of the average along the chord.")},
        Claims{2, true, false, {"quartic energy"}},
        ""};
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) {
        Claims claims{2, true, false, {}};
        if (settings.integer("points") >= 2) claims.conserves = {"quartic energy"};
        if (settings.integer("points") == 1)  // the midpoint rule
            claims = {2, true, true, {"momentum", "quadratic invariants"}};
        return claims;
    }});
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.takes = flowProblems();
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeFlowMethod<AverageVectorField>(flowOf(system), options.step,
                                                  options.settings.integer("points"));
    };
    return e;
}

}  // namespace extremal::baselines
