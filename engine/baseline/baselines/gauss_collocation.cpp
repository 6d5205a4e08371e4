// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss collocation with s stages on Hamilton's equations, by fixed-point iteration (Hairer, Lubich, Wanner
/// 2006, II.1.3 and VIII.6).
///
/// With nodes c_i, weights b_i and a_ij the integral over [0, c_i] of the cardinal polynomial l_j:
///     K_i = f(t + c_i h, x_0 + h sum_j a_ij K_j),   x_1 = x_0 + h sum_i b_i K_i.
/// For separable systems it is an iteration for the forces alone, which contracts with h^2 instead of h:
///     F_i = f(t + c_i h, q_0 + c_i h v_0 + h^2 sum_j (a a)_ij F_j / m),
///     q_1 = q_0 + h v_0 + h^2 sum_i b_i (1 - c_i) F_i / m,   p_1 = p_0 + h sum_i b_i F_i.
/// Starting values continue the polynomial through the previous step's F or K. The update is compensated:
/// what rounding takes away is added to the next step.
///
/// Written on the Hamiltonian side, independently of the Galerkin step, whose discretization (degree s,
/// Gauss(s)) it must equal to round-off. Arrays: node i, coordinate k at (i, k).
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/gauss_tableau.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/correction_size.hpp"
#include "engine/step/flow_method.hpp"

namespace extremal::baselines {
namespace {

/// l_j(x) of the nodes c.
double cardinal(const std::vector<double>& c, std::size_t j, double x) {
    double l = 1;
    for (std::size_t k = 0; k < c.size(); ++k)
        if (k != j) l *= (x - c[k]) / (c[j] - c[k]);
    return l;
}

/// The integral of l_j over [0, x], exactly: the rule has degree 2s - 1.
double cardinalIntegral(const Rule<double>& rule, std::size_t j, double x) {
    double sum = 0;
    for (std::size_t k = 0; k < rule.c.size(); ++k) sum += rule.b[k] * cardinal(rule.c, j, rule.c[k] * x);
    return x * sum;
}

template <int D>
class GaussCollocation final : public FlowMethod<D> {
    using Base = FlowMethod<D>;
    using Vector = typename Base::Vector;
    using Nodes = Eigen::Matrix<double, Eigen::Dynamic, D>;
    using Square = Eigen::MatrixXd;

public:
    GaussCollocation(const Mechanics<double>& mechanics, double step, int stages)
        : Base(mechanics, step), rule_(gauss<double>(stages)), s_(stages) {
        a_ = continuation_ = Square::Zero(s_, s_);
        for (int i = 0; i < s_; ++i)
            for (int j = 0; j < s_; ++j) {
                const auto node = static_cast<std::size_t>(i), of = static_cast<std::size_t>(j);
                a_(i, j) = cardinalIntegral(rule_, of, rule_.c[node]);
                continuation_(i, j) = cardinal(rule_.c, of, 1 + rule_.c[node]);
            }
        aa_ = a_ * a_;
        const int d = this->d();
        for (Nodes* n : {&Kq_, &Kp_, &newKq_, &newKp_, &Q_, &P_}) *n = Nodes::Zero(s_, d);
        for (Vector* v :
             {&q_, &p_, &dq_, &dp_, &endQ_, &endP_, &lostQ_, &lostP_, &inverseMass_, &changeQ_, &changeP_})
            *v = Vector::Zero(d);
        gradient_ = Eigen::VectorXd::Zero(2 * d);
        hessian_ = Square::Zero(2 * d, 2 * d);
        if (mechanics.isSeparable)
            inverseMass_ = Eigen::Map<const Vector>(mechanics.masses, d).cwiseInverse();
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<GaussCollocation>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(Kq_, Kp_, endQ_, endP_, lostQ_, lostP_, hasCurve_);
        return true;
    }
    void begin(State& state) override {
        state.memory.clear();
        hasCurve_ = false;
    }

    /// The collocation polynomial.
    void denseOutput(double tau, std::span<double> x) const override {
        const double h = this->h();
        for (int k = 0; k < this->d(); ++k) {
            double q = this->q0_(k), p = this->p0_(k);
            for (int i = 0; i < s_; ++i) {
                const double w = h * cardinalIntegral(rule_, static_cast<std::size_t>(i), tau);
                q += w * (isSeparable() ? inverseMass_(k) * (this->p0_(k) + h * a_.row(i).dot(Kp_.col(k)))
                                        : Kq_(i, k));
                p += w * Kp_(i, k);
            }
            x[static_cast<std::size_t>(k)] = q;
            x[static_cast<std::size_t>(this->d() + k)] = p;
        }
    }

private:
    bool isSeparable() const { return this->mechanics_.isSeparable; }

    void step(double t) override {
        const bool isContinued = hasCurve_ && this->q0_ == endQ_ && this->p0_ == endP_;
        if (!isContinued) {
            lostQ_.setZero();
            lostP_.setZero();
        }
        hasCurve_ = false;
        Outcome result = Outcome::diverged;
        if (isContinued) {
            newKq_.noalias() = continuation_.lazyProduct(Kq_);
            newKp_.noalias() = continuation_.lazyProduct(Kp_);
            result = iterate(t);
        }
        // Far away, continued polynomials are poor: once more from a constant field.
        if (result == Outcome::diverged || result == Outcome::notFinite || result == Outcome::singular) {
            this->report_.outcome = Outcome::converged;
            this->flow(t, this->q0_, this->p0_, dq_, dp_);
            newKq_.rowwise() = dq_.transpose();
            newKp_.rowwise() = dp_.transpose();
            result = iterate(t);
        }
        this->report_.outcome = result;
        if (result == Outcome::converged) finish();
    }

    /// Fixed-point iteration from newKq_, newKp_; ends in Kq_, Kp_.
    Outcome iterate(double t) {
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        constexpr double infinity = std::numeric_limits<double>::infinity();
        constexpr int usual = 100;  // iterations after which some coordinates may be buried
        double before = infinity, earlier = infinity;
        int growing = 0;
        bool hasBuried = false;
        BuriedWatch<double> buried;
        for (int iteration = 0; iteration < 200; ++iteration) {
            if (this->stop().stop_requested()) return Outcome::stopped;
            Kq_.swap(newKq_);
            Kp_.swap(newKp_);
            if (!evaluate(t)) return Outcome::singular;
            ++this->report_.cost.iterations;
            double size = change();
            this->report_.residual = size;
            if (!hasBuried && (growing >= 3 || iteration >= usual)) {
                hasBuried = true;
                before = earlier = infinity;  // what was seen so far has another meaning
            }
            bool isSettled = true;
            if (hasBuried) {
                const CorrectionSize<double> apart = measured(t);
                size = apart.size;
                isSettled = buried.hasSettled(apart) || apart.buried <= epsilon;
            }
            if (!(size < infinity)) return Outcome::notFinite;
            // At round-off; or so close that what is left to come, by the contraction seen, is below it; or
            // no longer shrinking (over two iterations, as oscillations make it shrink by turns). A
            // correction beyond the increments, of a coordinate near zero, says nothing of the contraction.
            const double rate = size / before;
            const bool isSolved =
                size <= epsilon ||
                (before < 1 && rate > 0 && rate < 0.5 && size * rate / (1 - rate) < 0.1 * epsilon) ||
                (size < roundOffOfSums<double>() && size >= earlier);
            if (isSolved && isSettled) {
                Kq_.swap(newKq_);
                Kp_.swap(newKp_);
                return Outcome::converged;
            }
            growing = size >= before && !isSolved ? growing + 1 : 0;
            if (growing >= 4) return Outcome::diverged;
            earlier = before;
            before = size;
        }
        return Outcome::diverged;
    }

    /// newK from K.
    bool evaluate(double t) {
        const double h = this->h();
        const auto& m = this->mechanics_;
        if (isSeparable()) {
            Q_.noalias() = aa_.lazyProduct(Kp_);
            for (int k = 0; k < this->d(); ++k)
                for (int i = 0; i < s_; ++i)
                    Q_(i, k) = this->q0_(k) + h * inverseMass_(k) * (c(i) * this->p0_(k) + h * Q_(i, k));
        } else {
            Q_.noalias() = a_.lazyProduct(Kq_);
            P_.noalias() = a_.lazyProduct(Kp_);
            Q_ *= h;
            P_ *= h;
            Q_.rowwise() += this->q0_.transpose();
            P_.rowwise() += this->p0_.transpose();
        }
        for (int i = 0; i < s_; ++i) {
            q_ = Q_.row(i).transpose();
            if (isSeparable()) {
                m.force(m.model.get(), t + c(i) * h, q_.data(), dp_.data());
                ++this->report_.cost.evaluations;
            } else {
                p_ = P_.row(i).transpose();
                this->flow(t + c(i) * h, q_, p_, dq_, dp_);
                if (this->report_.outcome != Outcome::converged) return false;
                newKq_.row(i) = dq_.transpose();
            }
            newKp_.row(i) = dp_.transpose();
        }
        return true;
    }

    /// The stages of the variational equation, all together:
    ///     L_i = f'(x_i) (W + h sum_j a_ij L_j),   W <- W + h sum_i b_i L_i.
    bool tangent(double t, typename Base::Columns W) override {
        const int n = 2 * this->d();
        const double h = this->h();
        if (stages_.rows() != s_ * n) {
            stages_ = Square::Zero(s_ * n, s_ * n);
            stagesLu_ = Eigen::PartialPivLU<Square>(s_ * n);
        }
        slopes_.resize(s_ * n, W.cols());
        stages_.setIdentity();
        for (int i = 0; i < s_; ++i) {
            placeStage(i);
            const Square* const jacobian = this->flowJacobian(t + c(i) * h, q_, p_);
            if (!jacobian) return false;
            slopes_.middleRows(i * n, n).noalias() = jacobian->lazyProduct(W);
            for (int j = 0; j < s_; ++j) stages_.block(i * n, j * n, n, n) -= h * a_(i, j) * *jacobian;
        }
        stagesLu_.compute(stages_);
        slopes_ = stagesLu_.solve(slopes_);
        for (int i = 0; i < s_; ++i)
            W += h * rule_.b[static_cast<std::size_t>(i)] * slopes_.middleRows(i * n, n);
        return true;
    }
    /// (q_, p_) of stage i, from the K of the last step.
    void placeStage(int i) {
        const double h = this->h();
        for (int k = 0; k < this->d(); ++k) {
            p_(k) = this->p0_(k) + h * a_.row(i).dot(Kp_.col(k));
            q_(k) = this->q0_(k) + (isSeparable() ? h * inverseMass_(k) *
                                                        (c(i) * this->p0_(k) + h * aa_.row(i).dot(Kp_.col(k)))
                                                  : h * a_.row(i).dot(Kq_.col(k)));
        }
    }

    /// What the last evaluation changed, each coordinate against its own increments and the round-off of its
    /// value.
    double change() const {
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        const double h = std::abs(this->h());
        double worst = 0;
        const auto look = [&](const auto& now, const auto& then, double value) {
            // The new increments alone are 0 where forces vanish that did not at the start.
            const double size = h * (now - then).cwiseAbs().maxCoeff(),
                         scale = h * std::max(now.cwiseAbs().maxCoeff(), then.cwiseAbs().maxCoeff());
            const double roundOff = epsilon * std::abs(value);
            if (!(size < std::numeric_limits<double>::infinity()))
                worst = std::numeric_limits<double>::infinity();
            if (size > 0.01 * roundOff) worst = std::max(worst, size / std::max(scale, roundOff));
        };
        for (int k = 0; k < this->d(); ++k) {
            look(newKp_.col(k), Kp_.col(k), this->p0_(k));
            if (!isSeparable()) look(newKq_.col(k), Kq_.col(k), this->q0_(k));
        }
        return worst;
    }

    /// The same apart from that of buried coordinates: momenta first, then, where they are iterated,
    /// positions.
    CorrectionSize<double> measured(double t) {
        const int d = this->d();
        const double h = std::abs(this->h());
        if (!isSeparable()) findMasses(t);
        return measureCorrection<double>(isSeparable() ? d : 2 * d, [&](int j) {
            const bool isMomentum = j < d;
            const int k = isMomentum ? j : j - d;
            const auto now = isMomentum ? newKp_.col(k) : newKq_.col(k),
                       then = isMomentum ? Kp_.col(k) : Kq_.col(k);
            const double mass = isMomentum ? h * h * inverseMass_(k) : 1 / inverseMass_(k);
            return CoordinateCorrection<double>{
                h * (now - then).cwiseAbs().maxCoeff(), h * now.cwiseAbs().maxCoeff(),
                isMomentum ? this->p0_(k) : this->q0_(k), std::isfinite(mass) ? mass : 0,
                isMomentum ? 0 : h * this->p0_(k)};
        });
    }

    /// 1/L_vv(k, k) at the start of the step, or H_pp(k, k).
    void findMasses(double t) {
        double value = 0;
        const auto& m = this->mechanics_;
        if (const PhaseMechanics* const H = hamiltonianOf(m)) {
            H->hessian(H->model.get(), t, this->q0_.data(), this->p0_.data(), hessian_.data());
            inverseMass_ = hessian_.diagonal().tail(this->d());
            return;
        }
        if (!m.jet) return;  // of a one-form: unknown
        if (!m.velocity(m.model.get(), t, this->q0_.data(), this->p0_.data(), dq_.data())) return;
        m.jet(m.model.get(), t, this->q0_.data(), dq_.data(), &value, gradient_.data(), hessian_.data());
        for (int k = 0; k < this->d(); ++k) inverseMass_(k) = 1 / hessian_(this->d() + k, this->d() + k);
    }

    void finish() {
        const double h = this->h();
        for (int k = 0; k < this->d(); ++k) {
            double q = 0, p = 0;
            for (int i = 0; i < s_; ++i) {
                const double b = rule_.b[static_cast<std::size_t>(i)];
                p += b * Kp_(i, k);
                q += isSeparable() ? b * (1 - c(i)) * Kp_(i, k) : b * Kq_(i, k);
            }
            if (isSeparable()) q = inverseMass_(k) * (this->p0_(k) + h * q);
            changeQ_(k) = h * q;
            changeP_(k) = h * p;
        }
        add(this->q0_, changeQ_, lostQ_, this->q1_);
        add(this->p0_, changeP_, lostP_, this->p1_);
        endQ_ = this->q1_;
        endP_ = this->p1_;
        hasCurve_ = true;
    }
    /// end = start + change, with what earlier roundings lost; keeps what this one loses.
    static void add(const Vector& start, const Vector& change, Vector& lost, Vector& end) {
        for (Eigen::Index k = 0; k < start.size(); ++k) {
            const double whole = change(k) + lost(k);
            end(k) = start(k) + whole;
            lost(k) = (start(k) - end(k)) + whole;
        }
    }

    double c(int i) const { return rule_.c[static_cast<std::size_t>(i)]; }

    Rule<double> rule_;
    int s_;
    Square a_, aa_, continuation_;
    Square stages_, slopes_;  ///< of the tangent map
    Eigen::PartialPivLU<Square> stagesLu_;
    Nodes Kq_, Kp_, newKq_, newKp_, Q_, P_;
    Vector q_, p_, dq_, dp_, endQ_, endP_, lostQ_, lostP_, inverseMass_, changeQ_, changeP_;
    Eigen::VectorXd gradient_;  ///< of L at the start of a step, as is the Hessian
    Square hessian_;
    bool hasCurve_ = false;
};

Claims claims(int stages) { return {2 * stages, true, true, {"momentum", "quadratic invariants"}}; }

}  // namespace

BaselineEntry gauss_collocation() {
    constexpr int usual = 4;
    const FieldInfo stages =
        integerField("stages", "s", 1, 16, usual, "Collocation points; the order is twice their number.");
    BaselineEntry e;
    e.item = {"gauss-collocation",
              "Gauss collocation",
              "Collocation at Gauss points of Hamilton's equations by fixed-point iteration.",
              {stages},
              claims(usual),
              ""};
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) { return claims(settings.integer("stages")); }});
    e.parts.set(
        BaselineTableau{[](const Settings& settings) { return gaussTableau(settings.integer("stages")); }});
    e.takes = firstOrderProblems().with<Spins, LieGroup, Spheres>();
    e.parts.set(ClaimsWithoutCoordinates{[](const Settings& settings) {
        return Claims{2 * settings.integer("stages"), true, false, {}};
    }});
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeFlowMethod<GaussCollocation>(flowOf(system), options.step,
                                                options.settings.integer("stages"));
    };
    return e;
}

}  // namespace extremal::baselines
