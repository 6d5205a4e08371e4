// SPDX-License-Identifier: GPL-3.0-or-later
/// The implicit midpoint rule in a fictitious time in which it needs equal steps: a symplectic scheme of
/// variable steps, with the density of the local action error as its step function.
///
/// With dt = sigma(z) dtau the motions of energy E are those of K(z) = sigma(z) (H(z) - E), at K = 0. With
/// constant steps epsilon in tau
///     z_1 = z_0 + epsilon J grad K(z),   t_1 = t_0 + epsilon sigma(z),   z = (z_0 + z_1) / 2,
/// J grad K = sigma X_H + (H - E) J grad sigma, is symplectic in z. As for symplectic-energy-momentum schemes
/// of degree 1 the step goes with the density of the midpoint rule,
///     sigma = (density / density(z_0))^(-1/3),    24 density = p' . q'' - q' . p''
/// with derivatives along the motion, but nothing is solved for it: there is a step wherever the density is
/// not zero. The order over the mean step is 4, not the 2 of the midpoint rule: the leading correction of K,
/// epsilon^2/24 K''(X_K, X_K) = epsilon^2 sigma^3 density at K = 0, is a constant there by the choice of
/// sigma, and what it is off K = 0 is a multiple of H - E, which changes the fictitious time alone.
/// The gradient of sigma, which the small H - E multiplies, needs X_H'' along the motion: differences of
/// order 6 of X_H' along it. Sources: Hairer 1997; Reich 1999; Hairer, Lubich, Wanner 2006, VIII.2.1.
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/coordinate_watch.hpp"
#include "engine/baseline/flow_jacobian.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/energy_momentum/density.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/corrections.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::baselines {
namespace {

class TimeTransformed final : public Integrator {
    using Vector = Eigen::VectorXd;
    using Square = Eigen::MatrixXd;

public:
    TimeTransformed(const Mechanics<double>& mechanics, double step)
        : mechanics_(mechanics), d_(mechanics.dimension), first_(step), jacobian_(mechanics) {
        for (Vector* v : {&z0_, &z1_, &z_, &shifted_, &flow_, &flowThere_, &second_, &gradSigma_,
                          &turnedFlow_, &turned_, &residual_})
            *v = Vector::Zero(2 * d_);
        system_ = A_ = B_ = Square::Zero(2 * d_, 2 * d_);
        lu_ = Eigen::PartialPivLU<Square>(2 * d_);
    }

    TimeGrid grid() const override { return TimeGrid::free; }
    std::vector<MemoryPart> memoryParts() const override {
        return {{"energy", 1}, {"density at the start", 1}};
    }
    void begin(State& state) override {
        const Eigen::Map<const Vector> z(state.x.data(), 2 * d_);
        state.memory = {energyAt(z), density(z)};
    }

    StepReport advance(State& state, double) override {
        if (state.memory.empty()) begin(state);
        report_ = StepReport{};
        energy_ = state.memory[0];
        scale_ = state.memory[1];
        if (!(std::abs(scale_) > 0) || !std::isfinite(scale_)) {
            report_.outcome = Outcome::refused;
            return report_;
        }
        z0_ = Eigen::Map<const Vector>(state.x.data(), 2 * d_);
        solve();
        if (report_.outcome != Outcome::converged) return report_;
        Eigen::Map<Vector>(state.x.data(), 2 * d_) = z1_;
        report_.step = step_ = first_ * sigma_;
        state.t += step_;
        ++state.node;
        return report_;
    }

    std::span<const Quantity> quantities() const override {
        static const std::array<Quantity, 2> all = {{{"density", "", "ℓ", ""}, {"monitor", "", "", ""}}};
        return all;
    }
    void measure(const State&, double* values) const override {
        values[0] = lastDensity_;
        values[1] = std::abs(step_) * std::cbrt(std::abs(lastDensity_));
    }

    /// The cubic Hermite interpolant in physical time.
    void denseOutput(double tau, std::span<double> x) const override {
        Vector f0(2 * d_), f1(2 * d_);
        hamiltonianFlow(z0_, f0);
        hamiltonianFlow(z1_, f1);
        const double a = (1 + 2 * tau) * (1 - tau) * (1 - tau), b = tau * (1 - tau) * (1 - tau) * step_;
        const double c = tau * tau * (3 - 2 * tau), e = tau * tau * (tau - 1) * step_;
        Eigen::Map<Vector>(x.data(), 2 * d_) = a * z0_ + b * f0 + c * z1_ + e * f1;
    }
    std::string tangentProblem() const override {
        return "its length of step is a function of the state, whose second derivatives are not known";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<TimeTransformed>(*this); }

private:
    template <class Z>
    double energyAt(const Z& z) const {
        return mechanics_.energy(mechanics_.model.get(), 0, z.data(), z.data() + d_);
    }
    template <class Z>
    bool hamiltonianFlow(const Z& z, Vector& f) const {
        return mechanics_.flow(mechanics_.model.get(), 0, z.data(), z.data() + d_, f.data(), f.data() + d_);
    }
    /// X_H in f, and its Jacobian.
    template <class Z>
    const Square* derivatives(const Z& z, Vector& f) {
        report_.cost.evaluations += 2;
        return hamiltonianFlow(z, f) ? &jacobian_.evaluate(0, z.data(), z.data() + d_, f.data()) : nullptr;
    }
    /// K v, where u . K v = u_p . v_q - u_q . v_p.
    void turn(const Vector& v, Vector& turned) const { turned << -v.tail(d_), v.head(d_); }
    template <class Z>
    double density(const Z& z) {
        const Square* const A = derivatives(z, flow_);
        if (!A) return std::numeric_limits<double>::quiet_NaN();
        second_.noalias() = A->lazyProduct(flow_);
        return (flow_.tail(d_).dot(second_.head(d_)) - flow_.head(d_).dot(second_.tail(d_))) / 24;
    }
    /// The gradient of the density at z_ into gradSigma_: with f = X_H, A = X_H' and B = X_H''(f, .)
    ///     24 density' = A^T K A f - A^T A^T K f - B^T K f.
    void densityGradient() {
        constexpr std::array<double, 3> weights = {45. / 60, -9. / 60, 1. / 60};
        constexpr double relativeShift = 2e-3;
        lastDensity_ = density(z_);
        A_ = jacobian_.matrix();
        turn(flow_, turnedFlow_);
        turn(second_, turned_);
        turned_.noalias() -= A_.transpose().lazyProduct(turnedFlow_);
        gradSigma_.noalias() = A_.transpose().lazyProduct(turned_);
        // A time in which neither the coordinates nor the momenta change by more than a small part of their
        // size.
        double rate = 0;
        for (int from = 0; from < 2 * d_; from += d_) {
            const double size = z_.segment(from, d_).cwiseAbs().maxCoeff();
            rate = std::max(rate, flow_.segment(from, d_).cwiseAbs().maxCoeff() / (size > 0 ? size : 1));
        }
        if (rate > 0) {
            const double shift = relativeShift / rate;
            B_.setZero();
            for (int k = 1; k <= 3; ++k)
                for (const int sign : {1, -1}) {
                    shifted_ = z_ + (sign * k * shift) * flow_;
                    if (const Square* const there = derivatives(shifted_, flowThere_))
                        B_ += (sign * weights[static_cast<std::size_t>(k - 1)] / shift) * *there;
                    else
                        B_.setConstant(std::numeric_limits<double>::quiet_NaN());
                }
            gradSigma_.noalias() -= B_.transpose().lazyProduct(turnedFlow_);
        }
        gradSigma_ /= 24;
    }
    /// At z_: sigma, its gradient, and I - epsilon/2 D(J grad K) without the second derivatives of sigma,
    /// which H - E multiplies; the right-hand side in turned_. False where the density is of the other sign.
    bool linearise() {
        const double half = first_ / 2;
        densityGradient();
        const double ratio = lastDensity_ / scale_;
        if (!(ratio > 0)) return false;
        sigma_ = 1 / std::cbrt(ratio);
        gradSigma_ *= -sigma_ / (3 * lastDensity_);
        turned_ << gradSigma_.tail(d_), -gradSigma_.head(d_);
        system_.setIdentity();
        system_ -= (half * sigma_) * A_;
        system_ -= half * flow_ * gradSigma_.transpose();
        system_ -= half * turned_ * turnedFlow_.transpose();
        lu_.compute(system_);
        turned_ = sigma_ * flow_ + (energyAt(z_) - energy_) * turned_;
        return true;
    }
    void solve() {
        z_ = z0_;
        CoordinateWatch watch;
        report_.outcome =
            solveByCorrections(CorrectionLimits{.most = 60}, stop(), report_, [&](int iteration, double) {
                if (iteration > 0) z_ += residual_;
                if (!linearise()) return Correction{.outcome = Outcome::singular};
                residual_ = z0_ + first_ / 2 * turned_ - z_;
                residual_ = lu_.solve(residual_);
                ++report_.cost.linearSolves;
                for (int k = 0; k < z_.size(); ++k) watch.add(residual_(k), z_(k) - z0_(k), z0_(k));
                return Correction{residual_.cwiseAbs().maxCoeff(), z_.cwiseAbs().maxCoeff(),
                                  watch.isSettled()};
            });
        if (report_.outcome == Outcome::converged) z1_ = z0_ + first_ * turned_;
    }

    Mechanics<double> mechanics_;
    int d_;
    double first_;  ///< epsilon: the first step, as sigma is 1 at the start
    FlowJacobian jacobian_;
    double energy_ = 0, scale_ = 0, sigma_ = 1, step_ = 0, lastDensity_ = 0;
    Vector z0_, z1_, z_, shifted_, flow_, flowThere_, second_, gradSigma_, turnedFlow_, turned_, residual_;
    Square system_, A_, B_;
    Eigen::PartialPivLU<Square> lu_;
    StepReport report_;
};

/// Follows the motion, as the schemes with moving times do: the density is that of degree 1.
void checkDensity(const SchemeCase& scheme, Findings& findings) {
    constexpr int orderOfMidpoint = 2;
    const Table<double> midpoint =
        makeTable(polynomialSpace<double>(1, PolynomialBasis::lobatto), gauss<double>(1));
    const auto forecast = [&](double h) {
        return forecastSolvability(scheme.system.mechanics(), midpoint, orderOfMidpoint, scheme.initial, h,
                                   scheme.end);
    };
    // A first step that is long where the density is large says little of it there.
    constexpr double shorter = 0.1;
    auto found = forecast(scheme.step);
    if (!found || (!found->vanishes && found->signChanges.empty())) found = forecast(shorter * scheme.step);
    if (!found) return;
    const char* const remedy = "a fixed step, or an adaptive code such as dopri5";
    if (found->vanishes)
        findings.warning("",
                         "will be refused: the density of the local action error, which its steps follow, "
                         "is 0 to round-off",
                         remedy, {}, "solvability");
    else if (!found->signChanges.empty())
        findings.warning("",
                         "will end near t = " + formatNumber(found->signChanges.front(), 3) +
                             ": its steps follow the density of the local action error, which changes its "
                             "sign there, and no step passes that, however short the first one",
                         remedy, {}, "solvability");
}

}  // namespace

BaselineEntry time_transformed() {
    BaselineEntry e;
    e.item = {
        "time-transformed",
        "time-transformed midpoint",
        "Symplectic with variable steps, order 4: the midpoint rule in a time in which the density of the "
        "local action error is constant. The step is the first one.",
        {},
        Claims{4, true, true, {"momentum"}, false},
        "a Lagrangian without explicit time"};
    e.grid = TimeGrid::free;
    e.parts.set(SystemCondition{[](const System& system) { return !system.mechanics().isTimeDependent; }});
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.parts.set(StepCheck{checkDensity});
    e.make = [](const System& system, const BaselineOptions& options) {
        return std::make_unique<TimeTransformed>(system.mechanics(), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
