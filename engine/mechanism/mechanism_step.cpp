// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/mechanism_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/action/element_kernel.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/exact_sum.hpp"
#include "engine/core/problem.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/step_continuation.hpp"

namespace extremal {
namespace {

using Vector = Eigen::VectorXd;
using Rows = Mechanism::Rows;

/// The functions of a table at other places: row j at tau_j, column a.
struct Samples {
    Eigen::MatrixXd value, slope;
};
Samples samplesOf(const Table<double>& table, const std::vector<double>& places) {
    const auto rows = static_cast<Eigen::Index>(places.size());
    Samples s{Eigen::MatrixXd(rows, table.unknowns()), Eigen::MatrixXd(rows, table.unknowns())};
    std::vector<double> value(static_cast<std::size_t>(table.space.size)), slope(value.size());
    for (Eigen::Index j = 0; j < rows; ++j) {
        table.space.evaluate(places[static_cast<std::size_t>(j)], value, slope);
        s.value.row(j) = Eigen::Map<const Vector>(value.data(), table.space.size).transpose() * table.change;
        s.slope.row(j) = Eigen::Map<const Vector>(slope.data(), table.space.size).transpose() * table.change;
    }
    return s;
}

class MechanismStep final : public Integrator {
public:
    MechanismStep(const Parts& parts, const Table<double>& table, double step, const SolverPolicy& policy)
        : mechanism_(parts),
          table_(table),
          kernel_(mechanism_.mechanics(), table_, ElementBasis::increments),
          policy_(policy),
          tolerance_(toleranceOf<double>(policy)),
          h_(step) {
        const int d = dimension(), m = table_.unknowns(), n = constraints();
        const Rule<double> nodes = lobatto<double>(m + 1);
        place_ = nodes.c;
        weight_ = nodes.b;
        atConstraints_ = samplesOf(table_, place_).value;
        const Eigen::MatrixXd ends = atConstraints_.bottomRows(m);
        if (!(dense::Lu<double>(ends).pivotRatio() > 1e-10))
            throw InvalidScene("/space",
                               "has functions that " + std::to_string(m + 1) +
                                   " Lobatto nodes do not tell apart, where constraints hold",
                               "polynomials");
        endSlope_ = samplesOf(table_, {1.0}).slope;
        fit_ = dense::inverse<double>(ends);
        lu_ = SmallLu<double>(m * (d + n));
        Y_ = Vector::Zero(m * d);
        impulses_ = Vector::Zero(m * n);
        residual_ = Vector::Zero(m * (d + n));
        z_ = gradient_ = Vector::Zero((m + 1) * d);
        hessian_ = Eigen::MatrixXd::Zero((m + 1) * d, (m + 1) * d);
        p0_ = velocity_ = q1_ = p1_ = carryQ_ = carryP_ = endVelocity_ = masses_ = Vector::Zero(d);
        forces_ = Vector::Zero(d);
        byState_ = Rows::Zero(d, 2 * d);
        byPlace_.assign(static_cast<std::size_t>(m + 1), Rows::Zero(n, d));
        value_ = byTime_ = Vector::Zero(n);
        curvature_ = Eigen::MatrixXd::Zero(d, d);
        motion_ = Vector::Zero(2 * d);
        jetHessian_ = Rows::Zero(2 * d, 2 * d);
    }

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }

    void begin(State& state) override {
        state.memory.clear();
        carryQ_.setZero();
        carryP_.setZero();
    }

    StepReport advance(State& state, double until) override {
        const int d = dimension();
        report_ = StepReport{};
        report_.step = h_;
        start_ = state.t;
        const Eigen::Map<const Vector> q(state.x.data(), d), p(state.x.data() + d, d);
        if (q != q1_ || p != p1_) {
            carryQ_.setZero();
            carryP_.setZero();
        }
        z_.head(d) = q;
        p0_ = p;
        report_.outcome = solve();
        if (report_.outcome != Outcome::converged) return report_;
        const Vector carryQ = carryQ_, carryP = carryP_;
        if (!finish()) {
            carryQ_ = carryQ;
            carryP_ = carryP;
            report_.outcome = Outcome::singular;
            return report_;
        }
        Eigen::Map<Vector>(state.x.data(), d) = q1_;
        Eigen::Map<Vector>(state.x.data() + d, d) = p1_;
        state.t = until;
        ++state.node;
        return report_;
    }

    /// The curve, and L_v of its velocity.
    void denseOutput(double tau, std::span<double> x) const override {
        const int d = dimension(), m = table_.unknowns();
        if (tau <= 0 || tau >= 1) {
            for (int k = 0; k < d; ++k) {
                x[static_cast<std::size_t>(k)] = tau <= 0 ? z_(k) : q1_(k);
                x[static_cast<std::size_t>(d + k)] = tau <= 0 ? p0_(k) : p1_(k);
            }
            return;
        }
        const Samples here = samplesOf(table_, {tau});
        Vector q = z_.head(d), v = Vector::Zero(d), both(2 * d);
        for (int a = 0; a < m; ++a) {
            q += here.value(0, a) * Y_.segment(a * d, d);
            v += here.slope(0, a) / h_ * Y_.segment(a * d, d);
        }
        const auto& L = mechanism_.mechanics();
        L.gradient(L.model.get(), start_ + tau * h_, q.data(), v.data(), both.data());
        for (int k = 0; k < d; ++k) {
            x[static_cast<std::size_t>(k)] = q(k);
            x[static_cast<std::size_t>(d + k)] = both(d + k);
        }
    }

    std::string tangentProblem() const override { return "constraints and forces are not varied yet"; }

    /// The work of forces and of constraints that move with time, in the last step.
    std::span<const Quantity> quantities() const override {
        static const Quantity work{"work", "", "W", ""};
        return {&work, 1};
    }
    void measure(const State&, double* values) const override {
        values[0] = workOfForces() + workOfConstraints();
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MechanismStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(carryQ_, carryP_, q1_, p1_);
        return true;
    }

private:
    int dimension() const { return mechanism_.dimension(); }
    int constraints() const { return mechanism_.constraints(); }

    /// Newton's method from what is known at the start, and a second opinion where its root is far from it.
    Outcome solve() {
        constexpr double far = 0.25;
        Outcome outcome = startFresh(h_) ? newton(h_) : Outcome::singular;
        if (outcome == Outcome::stopped) return outcome;
        if (outcome == Outcome::converged && nearness_ <= far) return outcome;
        const Vector found = Y_;
        const bool wasFound = outcome == Outcome::converged;
        StepContinuation<double> continuation;
        const bool hasArrived = continuation.follow(Y_, [&](double part, bool isFresh) {
            if (stop().stop_requested()) return false;
            if (isFresh && !startFresh(part * h_)) return false;
            guessImpulses(part * h_);
            return newton(part * h_) == Outcome::converged && nearness_ <= far;
        });
        if (stop().stop_requested()) return Outcome::stopped;
        if (hasArrived) return Outcome::converged;
        if (!wasFound) return outcome;
        // Short steps do not lead there: what was found may be another assembly.
        Y_ = found;
        return Outcome::lost;
    }

    /// The impulses of the multipliers at the start, of a step of this length.
    void guessImpulses(double h) {
        const int n = constraints();
        for (int j = 0; j < table_.unknowns(); ++j)
            impulses_.segment(j * n, n) = h * weight_[static_cast<std::size_t>(j)] * multipliers_;
    }

    bool startFresh(double h) {
        const int d = dimension(), m = table_.unknowns();
        const auto& L = mechanism_.mechanics();
        velocity_.setZero();
        if (!L.velocity(L.model.get(), start_, z_.data(), p0_.data(), velocity_.data())) return false;
        ++report_.cost.evaluations;
        ++report_.cost.linearSolves;
        if (!mechanism_.accelerate(start_, z_.data(), velocity_.data(), acceleration_, multipliers_))
            return false;
        for (int a = 0; a < m; ++a) {
            auto Y = Y_.segment(a * d, d);
            Y.setZero();
            for (int j = 0; j < m; ++j) {
                const double t = place_[static_cast<std::size_t>(j + 1)] * h;
                Y += fit_(a, j) * (t * velocity_ + t * t / 2 * acceleration_);
            }
        }
        guessImpulses(h);
        return true;
    }

    /// q(e_j) into the front of `node`.
    void placeAt(int j, Vector& node) const {
        const int d = dimension();
        node.head(d) = z_.head(d);
        for (int a = 0; a < table_.unknowns(); ++a)
            node.head(d) += atConstraints_(j, a) * Y_.segment(a * d, d);
    }
    /// (q, v) at node i of the rule.
    void curveAt(int i, double h, Vector& node) const {
        const int d = dimension();
        auto q = node.head(d), v = node.tail(d);
        q = z_.head(d);
        v.setZero();
        for (int a = 0; a < table_.unknowns(); ++a) {
            q += table_.value(i, a) * Y_.segment(a * d, d);
            v += table_.derivative(i, a) / h * Y_.segment(a * d, d);
        }
    }

    /// G by z = (q_0, Y), its derivatives by Y, and the constraints, at the present unknowns.
    bool evaluate(double h) {
        const int d = dimension(), m = table_.unknowns();
        z_.tail(m * d) = Y_;
        report_.cost.evaluations += table_.nodes();
        if (!kernel_.evaluate(start_, h, z_, DerivativeOrder::second, derivatives_)) return false;
        gradient_ = derivatives_.gradient;
        hessian_ = derivatives_.hessian;
        if (mechanism_.force()) addForces(h);
        if (mechanism_.constraint()) addConstraints(h);
        return gradient_.allFinite() && residual_.allFinite();
    }

    void addForces(double h) {
        const Force& force = *mechanism_.force();
        const int d = dimension(), m = table_.unknowns();
        for (int i = 0; i < table_.nodes(); ++i) {
            curveAt(i, h, motion_);
            force.first(force.model.get(), start_ + table_.node(i) * h, motion_.data(), motion_.data() + d,
                        forces_.data(), byState_.data());
            const double weight = h * table_.weight(i);
            for (int a = -1; a < m; ++a) {  // -1: q_0, whose function is 1
                const double test = weight * (a < 0 ? 1 : table_.value(i, a));
                gradient_.segment((a + 1) * d, d) += test * forces_;
                for (int b = 0; b < m; ++b)
                    hessian_.block((a + 1) * d, (b + 1) * d, d, d) +=
                        test * (table_.value(i, b) * byState_.leftCols(d) +
                                table_.derivative(i, b) / h * byState_.rightCols(d));
            }
        }
    }

    void addConstraints(double h) {
        const Constraint& g = *mechanism_.constraint();
        const int d = dimension(), m = table_.unknowns(), n = constraints();
        for (int j = 0; j <= m; ++j) {
            const double t = start_ + place_[static_cast<std::size_t>(j)] * h;
            placeAt(j, motion_);
            Rows& byPlace = byPlace_[static_cast<std::size_t>(j)];
            g.first(g.model.get(), t, motion_.data(), value_.data(), byPlace.data(), byTime_.data());
            if (j > 0) residual_.segment(m * d + (j - 1) * n, n) = value_;
            if (j == m) break;
            const auto impulse = impulses_.segment(j * n, n);
            forces_.noalias() = byPlace.transpose() * impulse;
            gradient_.head(d) += forces_;
            if (j == 0) continue;  // there the functions are 0
            curvature_.setZero();
            g.addCurvature(g.model.get(), t, motion_.data(), impulses_.data() + j * n, curvature_.data());
            for (int a = -1; a < m; ++a) {
                const double test = a < 0 ? 1 : atConstraints_(j, a);
                if (a >= 0) gradient_.segment((a + 1) * d, d) += test * forces_;
                for (int b = 0; b < m; ++b)
                    hessian_.block((a + 1) * d, (b + 1) * d, d, d) +=
                        test * atConstraints_(j, b) * curvature_;
            }
        }
    }

    /// The left-hand sides and their derivatives by (Y, Lambda), factorised.
    SmallLu<double>::Result factorise() {
        const int d = dimension(), m = table_.unknowns(), n = constraints(), last = (m - 1) * d;
        residual_.head(last) = gradient_.segment(d, last);
        residual_.segment(last, d) = p0_ + (gradient_.head(d) - gradient_.tail(d));
        const auto& H = hessian_;
        for (int c = 0; c < m * d; ++c) {
            double* const column = lu_.column(c);
            for (int r = 0; r < last; ++r) column[r] = H(d + r, d + c);
            for (int k = 0; k < d; ++k) column[last + k] = H(k, d + c) - H(m * d + k, d + c);
            const int a = c / d, i = c % d;
            for (int j = 1; j <= m; ++j)
                for (int k = 0; k < n; ++k)
                    column[m * d + (j - 1) * n + k] =
                        atConstraints_(j, a) * byPlace_[static_cast<std::size_t>(j)](k, i);
        }
        for (int j = 0; j < m; ++j)
            for (int k = 0; k < n; ++k) {
                double* const column = lu_.column(m * d + j * n + k);
                const Rows& byPlace = byPlace_[static_cast<std::size_t>(j)];
                for (int a = 0; a < m; ++a) {
                    const double test = (a == m - 1 ? 1 : 0) + (a == m - 1 ? -1 : 1) * atConstraints_(j, a);
                    for (int i = 0; i < d; ++i) column[a * d + i] = test * byPlace(k, i);
                }
                for (int r = 0; r < m * n; ++r) column[m * d + r] = 0;
            }
        return lu_.factorise();
    }

    /// The correction against the increments, all coordinates together: one that turns back has increments
    /// of almost nothing.
    double sizeInMassMetric() const {
        const int d = dimension();
        const double roundOff = std::numeric_limits<double>::epsilon();
        double change = 0, increments = 0;
        for (int k = 0; k < d; ++k) {
            const double root = std::sqrt(std::abs(mechanism_.mass(k)));
            for (int a = 0; a < table_.unknowns(); ++a) {
                change = std::max(change, root * std::abs(residual_(a * d + k)));
                increments = std::max(increments, root * std::abs(Y_(a * d + k)));
            }
            increments = std::max(increments, 100 * roundOff * root * std::abs(z_(k)));
        }
        return change > 0 ? change / increments : 0;
    }

    CoordinateCorrection<double> correctionOf(int k, double h) const {
        const int d = dimension();
        CoordinateCorrection<double> c{0, 0, z_(k), masses_(k), h * p0_(k)};
        for (int a = 0; a < table_.unknowns(); ++a) {
            c.change = std::max(c.change, std::abs(residual_(a * d + k)));
            c.increments = std::max(c.increments, std::abs(Y_(a * d + k)));
        }
        return c;
    }

    void findMasses(double h) {
        const int d = dimension();
        const auto& L = mechanism_.mechanics();
        double value = 0;
        velocity_ = Y_.tail(d) / h;
        Vector gradient(2 * d);
        L.jet(L.model.get(), start_, z_.data(), velocity_.data(), &value, gradient.data(),
              jetHessian_.data());
        masses_ = jetHessian_.diagonal().tail(d);
    }

    Outcome newton(double h) {
        using Verdict = NewtonPolicy<double>::Verdict;
        const int d = dimension(), m = table_.unknowns(), n = constraints();
        const auto limits = NewtonLimits<double>::elementStep(tolerance_);
        NewtonPolicy<double> policy(limits);
        for (int iteration = 0; iteration < policy_.maxIterations; ++iteration) {
            if (stop().stop_requested()) return Outcome::stopped;
            if (!evaluate(h)) return Outcome::notFinite;
            const auto factors = factorise();
            if (factors != SmallLu<double>::Result::regular)
                return factors == SmallLu<double>::Result::singular ? Outcome::singular : Outcome::notFinite;
            lu_.solve(residual_.data());
            report_.cost.linearSolves += 2;
            ++report_.cost.iterations;
            double size = 0;
            for (int k = 0; k < d; ++k) {
                const auto c = correctionOf(k, h);
                size = std::max(size, relativeCorrection(c.change, c.increments, c.value));
            }
            report_.residual = size;
            if (iteration == 0) nearness_ = sizeInMassMetric();
            const Verdict verdict = policy.judge(size, [&] {
                findMasses(h);
                return measureCorrection<double>(d, [&](int k) { return correctionOf(k, h); });
            });
            policy.jacobianIsNew();
            if (verdict == Verdict::converged) return Outcome::converged;
            if (verdict == Verdict::notFinite) return Outcome::notFinite;
            if (verdict == Verdict::diverged) return Outcome::diverged;
            Y_ -= residual_.head(m * d);
            impulses_ -= residual_.tail(m * n);
        }
        return Outcome::diverged;
    }

    /// (q_1, p_1) with what the last sums have lost, and the work.
    bool finish() {
        const int d = dimension(), m = table_.unknowns();
        const double end = start_ + h_;
        for (int k = 0; k < d; ++k) q1_(k) = addExactly(z_(k), Y_((m - 1) * d + k) + carryQ_(k), carryQ_(k));
        p1_ = p0_ + gradient_.head(d);
        if (constraints() > 0) {
            endVelocity_.setZero();
            for (int a = 0; a < m; ++a) endVelocity_ += endSlope_(0, a) / h_ * Y_.segment(a * d, d);
            if (!mechanism_.project(end, q1_.data(), p1_.data(), endVelocity_, kappa_, true)) return false;
            const Constraint& g = *mechanism_.constraint();
            Rows& byPlace = byPlace_.back();
            g.first(g.model.get(), end, q1_.data(), value_.data(), byPlace.data(), byTime_.data());
            forces_ = byPlace.transpose() * kappa_;
        } else {
            forces_.setZero();
        }
        for (int k = 0; k < d; ++k)
            p1_(k) = addExactly(p0_(k), gradient_(k) + forces_(k) + carryP_(k), carryP_(k));
        return q1_.allFinite() && p1_.allFinite();
    }

    /// h sum_i b_i F . v on the curve of the last step.
    double workOfForces() const {
        if (!mechanism_.force()) return 0;
        const Force& force = *mechanism_.force();
        const int d = dimension();
        Vector node(2 * d), F(d);
        double sum = 0;
        for (int i = 0; i < table_.nodes(); ++i) {
            curveAt(i, h_, node);
            force.value(force.model.get(), start_ + table_.node(i) * h_, node.data(), node.data() + d,
                        F.data());
            sum += h_ * table_.weight(i) * F.dot(node.tail(d));
        }
        return sum;
    }
    /// -sum_{j<m} Lambda_j . g_t - kappa . g_t at the end: what constraints that move with time do.
    double workOfConstraints() const {
        if (constraints() == 0 || !mechanism_.constraint()->isTimeDependent) return 0;
        const Constraint& g = *mechanism_.constraint();
        const int d = dimension(), m = table_.unknowns(), n = constraints();
        Vector q(d), value(n), byTime(n);
        Rows byPlace(n, d);
        double sum = 0;
        for (int j = 0; j <= m; ++j) {
            placeAt(j, q);
            g.first(g.model.get(), start_ + place_[static_cast<std::size_t>(j)] * h_, q.data(), value.data(),
                    byPlace.data(), byTime.data());
            sum -= byTime.dot(j < m ? Vector(impulses_.segment(j * n, n)) : kappa_);
        }
        return sum;
    }

    Mechanism mechanism_;
    Table<double> table_;
    ElementKernel<double> kernel_;
    ElementDerivatives<double> derivatives_;
    SolverPolicy policy_;
    double tolerance_, h_;
    std::vector<double> place_, weight_;   ///< e_j and w_j
    Eigen::MatrixXd endSlope_;             ///< (0, a): phi_a'(1)
    Eigen::MatrixXd atConstraints_, fit_;  ///< (j, a): phi_a(e_j); its inverse for j = 1..m
    SmallLu<double> lu_;
    Vector Y_, impulses_, residual_;  ///< impulses_: Lambda_j, j < m
    Vector z_, gradient_;             ///< (q_0, Y), and G by it
    Eigen::MatrixXd hessian_, curvature_;
    Vector p0_, q1_, p1_, carryQ_, carryP_;  ///< carries: lost to rounding in q_1 and p_1
    Vector velocity_, acceleration_, multipliers_, endVelocity_, kappa_, masses_;
    Vector forces_, motion_, value_, byTime_;  ///< motion_: (q, v) of one node
    Rows byState_, jetHessian_;
    std::vector<Rows> byPlace_;  ///< g_q at e_j
    double start_ = 0, nearness_ = 0;
    StepReport report_;
};

}  // namespace

std::unique_ptr<Integrator> makeMechanismStep(const Parts& parts, const Table<double>& table, double step,
                                              const SolverPolicy& policy) {
    return std::make_unique<MechanismStep>(parts, table, step, policy);
}

}  // namespace extremal
