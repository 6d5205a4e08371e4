// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/moving_mesh/multiplier_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/solve/newton_policy.hpp"

namespace extremal {
namespace {

/// Starting values from an eighth of the step at the least.
constexpr int mostHalvings = 3;

/// The Jacobian of the first iteration is kept while it contracts. What is ill-conditioned, where u is nearly
/// linear across a node and only the constraint says where it stands, leaves corrections above round-off.
NewtonLimits<double> limitsOf(double tolerance) {
    NewtonLimits<double> l = NewtonLimits<double>::elementStep(tolerance);
    l.illConditioned = 1e-9;
    l.mostGrowing = 6;
    l.refreshAbove = 0.05;
    l.patience = 1;
    return l;
}

}  // namespace

MultiplierStep::MultiplierStep(const NodeSpace& space, const Monitor& monitor, double tolerance,
                               int maxIterations)
    : space_(space),
      constraint_(monitor, space.n),
      tolerance_(tolerance),
      maxIterations_(maxIterations),
      action_(space) {
    const std::size_t n = space_.n;
    const int reach = 3 * static_cast<int>(constraint_.width()) + 2;
    lu_ = BandLu(static_cast<int>(3 * n), reach);
    massLu_ = BandLu(static_cast<int>(3 * n), reach);
    for (auto* each : {&z1_, &v1_, &p0_, &p1_}) each->assign(2 * n, 0);
    residual_.assign(3 * n, 0);
    for (auto* each : {&g_, &lambda_, &mu_}) each->assign(n, 0);
    Dg0_.resize(n);
    Dg1_.resize(n);
}

void MultiplierStep::fixEnds(BandLu& lu, std::vector<double>& right) const {
    forEachHeld([&](std::size_t k) { lu.fix(static_cast<int>(k)); });
    fixEnds(right);
}

void MultiplierStep::fixEnds(std::vector<double>& right) const {
    forEachHeld([&](std::size_t k) { right[k] = 0; });
}

/// Free nodes have no equation of their own where u is linear across them.
bool MultiplierStep::isRegular(const BandLu& lu) const {
    constexpr double singular = 1e-14;
    return !isFree_ || lu.pivotRatio() > singular;
}

/// Rows Dg of the equations g = 0, and the columns of the multipliers.
void MultiplierStep::addConstraint(BandLu& lu, const std::vector<MeshConstraint::Row>& columns) const {
    if (isFree_) return;
    const std::size_t n = space_.n, width = constraint_.width(), most = MeshConstraint::mostWidth;
    for (std::size_t i = 1; i + 1 < n; ++i)
        for (std::size_t k = most - width; k <= most + width; ++k) {
            if (i + k < most || i + k - most >= n) continue;
            const std::size_t j = i + k - most;
            for (std::size_t part = 0; part < 2; ++part) {
                lu.add(static_cast<int>(row(i, 2)), static_cast<int>(row(j, part)), Dg1_[i][2 * k + part]);
                lu.add(static_cast<int>(row(j, part)), static_cast<int>(row(i, 2)), columns[i][2 * k + part]);
            }
        }
}

void MultiplierStep::evaluate(const std::vector<double>& z0, double h, bool withJacobian, Cost& cost) {
    const std::size_t n = space_.n;
    if (withJacobian) lu_.clear();
    action_.evaluate(
        z0, z1_, h, withJacobian, cost, [this](std::size_t e, std::size_t a, std::size_t b, double value) {
            lu_.add(static_cast<int>(row(e + a / 2, a % 2)), static_cast<int>(row(e + b / 2, b % 2)), value);
        });
    action_.addNodeMass(meshMass_);
    constraint_.evaluate(z1_.data(), g_, Dg1_);
    // the residual, with the force of the multipliers
    std::vector<double>& force = p1_;
    for (std::size_t i = 0; i < n && withJacobian; ++i)
        lu_.add(static_cast<int>(row(i, 1)), static_cast<int>(row(i, 1)), -meshMass_ / h);
    for (std::size_t k = 0; k < 2 * n; ++k) force[k] = p0_[k] + action_.atStart(k, h);
    if (!isFree_) constraint_.addTransposed(Dg0_, lambda_, 1, force);
    for (std::size_t i = 0; i < n; ++i) {
        residual_[row(i, 0)] = force[2 * i];
        residual_[row(i, 1)] = force[2 * i + 1];
        residual_[row(i, 2)] = g_[i];
    }
    if (withJacobian) addConstraint(lu_, Dg0_);
}

double MultiplierStep::correct(const std::vector<double>& z0) {
    const std::size_t n = space_.n;
    lu_.solve(residual_.data());
    // No element may shrink to less than a tenth of the smallest one: nodes keep their order.
    const double least = 0.1 * space_.smallestElement(z0.data());
    double part = 1;
    for (int halvings = 0; halvings < 30 && !isFree_; ++halvings, part /= 2) {
        bool isSafe = true;
        for (std::size_t e = 0; e + 1 < n && isSafe; ++e) {
            const double now = z1_[2 * e + 3] - z1_[2 * e + 1],
                         next = now - part * (residual_[row(e + 1, 1)] - residual_[row(e, 1)]);
            isSafe = next >= least;
        }
        if (isSafe) break;
    }
    double largest = 0, increments = 0, value = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < 2; ++k) {
            const double delta = part * residual_[row(i, k)];
            double& z = z1_[2 * i + k];
            z -= delta;
            if (!(std::abs(delta) <= largest)) largest = std::abs(delta);
            increments = std::max(increments, std::abs(z - z0[2 * i + k]));
            value = std::max(value, std::abs(z));
        }
        lambda_[i] -= part * residual_[row(i, 2)];
    }
    const double size = relativeCorrection(largest, increments, value);
    return part < 1 ? std::max(size, 1.0) : size;
}

Outcome MultiplierStep::solve(const std::vector<double>& z0, double h, StepReport& report,
                              const std::stop_token& stop) {
    NewtonPolicy<double> policy(limitsOf(std::max(tolerance_, std::numeric_limits<double>::epsilon())));
    bool hasJacobian = false;
    for (int iteration = 0; iteration < maxIterations_; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        evaluate(z0, h, !hasJacobian, report.cost);
        if (!hasJacobian) {
            fixEnds(lu_, residual_);
            if (!lu_.factorise() || !isRegular(lu_)) return Outcome::singular;
            policy.jacobianIsNew();
            ++report.cost.linearSolves;
            hasJacobian = true;
        } else {
            fixEnds(residual_);
        }
        const double size = correct(z0);
        ++report.cost.iterations;
        ++report.cost.linearSolves;
        report.residual = size;
        const NewtonVerdict verdict = policy.judge(size);
        if (const auto end = endOf(verdict))
            return *end == Outcome::converged && !space_.isOrdered(z1_.data()) ? Outcome::lost : *end;
        hasJacobian = verdict != NewtonVerdict::slow;
    }
    return Outcome::diverged;
}

/// From z + h v, or, where Newton's method does not get to the end of the step from there, from twice the
/// change in half of the step, which is found in the same way.
Outcome MultiplierStep::solveFrom(const std::vector<double>& z, const std::vector<double>& v, double h,
                                  int halvings, StepReport& report, const std::stop_token& stop) {
    const auto keepOrdered = [&] {
        if (!space_.isOrdered(z1_.data())) z1_ = z;
    };
    for (std::size_t k = 0; k < z.size(); ++k) z1_[k] = z[k] + h * v[k];
    keepOrdered();
    std::fill(lambda_.begin(), lambda_.end(), 0.0);
    Outcome outcome = solve(z, h, report, stop);
    if (outcome == Outcome::converged || outcome == Outcome::stopped || halvings == 0) return outcome;
    outcome = solveFrom(z, v, h / 2, halvings - 1, report, stop);
    if (outcome != Outcome::converged) return outcome;
    for (std::size_t k = 0; k < z.size(); ++k) z1_[k] += z1_[k] - z[k];
    keepOrdered();
    for (double& each : lambda_) each *= 2;
    return solve(z, h, report, stop);
}

/// M(z) v + Dg^T mu = p, Dg v = 0; Dg1_ is that of z.
Outcome MultiplierStep::tangent(const std::vector<double>& z, const std::vector<double>& p,
                                std::vector<double>& v, Cost& cost) {
    const std::size_t n = space_.n;
    massLu_.clear();
    ElementDerivatives::Matrix mass;
    for (std::size_t e = 0; e + 1 < n; ++e) {
        elementMass(z.data() + 2 * e, mass);
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = 0; b < 4; ++b)
                massLu_.add(static_cast<int>(row(e + a / 2, a % 2)), static_cast<int>(row(e + b / 2, b % 2)),
                            mass[a][b]);
    }
    addConstraint(massLu_, Dg1_);
    for (std::size_t i = 0; i < n; ++i)
        massLu_.add(static_cast<int>(row(i, 1)), static_cast<int>(row(i, 1)), meshMass_);
    for (std::size_t i = 0; i < n; ++i) {
        residual_[row(i, 0)] = p[2 * i];
        residual_[row(i, 1)] = p[2 * i + 1];
        residual_[row(i, 2)] = 0;
    }
    fixEnds(massLu_, residual_);
    cost.linearSolves += 2;
    if (!massLu_.factorise() || !isRegular(massLu_)) return Outcome::singular;
    massLu_.solve(residual_.data());
    for (std::size_t i = 0; i < n; ++i) {
        v[2 * i] = residual_[row(i, 0)];
        v[2 * i + 1] = residual_[row(i, 1)];
        mu_[i] = residual_[row(i, 2)];
    }
    return Outcome::converged;
}

Outcome MultiplierStep::project(const std::vector<double>& z, std::vector<double>& v, Cost& cost) {
    constraint_.evaluate(z.data(), g_, Dg1_);
    space_.momentum(z.data(), v.data(), p1_);
    const Outcome outcome = tangent(z, p1_, v, cost);
    std::fill(mu_.begin(), mu_.end(), 0.0);
    return outcome;
}

double MultiplierStep::smallestMass(const std::vector<double>& z) {
    constexpr int iterations = 20;
    constraint_.evaluate(z.data(), g_, Dg1_);
    const std::size_t size = 2 * space_.n;
    std::vector<double> v(size), next(size);
    for (std::size_t k = 0; k < size; ++k) v[k] = std::sin(1 + 2.7 * static_cast<double>(k));  // any
    double norm = 0;
    Cost cost;
    for (int i = 0; i < iterations; ++i) {  // by the inverse
        if (tangent(z, v, next, cost) != Outcome::converged) return 0;
        norm = 0;
        for (const double each : next) norm += each * each;
        norm = std::sqrt(norm);
        if (!(norm > 0)) return 0;
        for (std::size_t k = 0; k < size; ++k) v[k] = next[k] / norm;
    }
    std::fill(mu_.begin(), mu_.end(), 0.0);
    return 1 / norm / (space_.problem->mesh.length() / static_cast<double>(space_.elements()));
}

Outcome MultiplierStep::advance(std::vector<double>& z, std::vector<double>& v, double h, StepReport& report,
                                const std::stop_token& stop) {
    const std::size_t n = space_.n;
    space_.momentum(z.data(), v.data(), p0_);
    for (std::size_t i = 0; i < n; ++i) p0_[2 * i + 1] += meshMass_ * v[2 * i + 1];
    constraint_.evaluate(z.data(), g_, Dg0_);
    Outcome outcome = solveFrom(z, v, h, mostHalvings, report, stop);
    if (outcome != Outcome::converged) return outcome;
    largestMultiplier_ = 0;
    for (std::size_t i = 0; i < n; ++i)
        largestMultiplier_ = std::max(largestMultiplier_, std::abs(lambda_[i] - mu_[i]));
    evaluate(z, h, false, report.cost);
    for (std::size_t k = 0; k < 2 * n; ++k) p1_[k] = action_.atEnd(k, h);
    outcome = tangent(z1_, p1_, v1_, report.cost);
    if (outcome != Outcome::converged) return outcome;
    slabEnergy_ = action_.energy();
    z.swap(z1_);
    v.swap(v1_);
    return Outcome::converged;
}

}  // namespace extremal
