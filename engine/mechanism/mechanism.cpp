// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/mechanism.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/corrections.hpp"

namespace extremal {
namespace {

/// Of equations for velocities, in which those of the whole motion are subtracted.
constexpr CorrectionLimits ofVelocities{.most = 30, .last = 4 * CorrectionLimits::epsilon, .roundOff = 1e-10};

template <class Part>
std::optional<Part> copyOf(const Parts& parts) {
    const Part* const part = parts.find<Part>();
    return part ? std::optional<Part>(*part) : std::nullopt;
}

std::unique_ptr<StateEquations> makeState(const Mechanics<double>& mechanics, const Conditions& conditions,
                                          const std::optional<Force>& force,
                                          const std::optional<LinkedParts>& linked) {
    return linked ? linkedState(*linked) : denseState(mechanics, conditions, force);
}

}  // namespace

std::optional<LinkedParts> linkedParts(const Parts& parts, LinkedAlgebra algebra) {
    if (algebra == LinkedAlgebra::never) return {};
    std::optional<LinkedParts> linked = LinkedParts::of(parts);
    if (linked && algebra == LinkedAlgebra::automatic && !Linkage(*linked).isWorthwhile()) linked.reset();
    return linked;
}

Mechanism::Mechanism(const Parts& parts, LinkedAlgebra algebra)
    : mechanics_(*parts.find<Mechanics<double>>()),
      conditions_(copyOf<Constraint>(parts), copyOf<Rolling>(parts), mechanics_.dimension),
      force_(copyOf<Force>(parts)),
      linked_(linkedParts(parts, algebra)),
      state_(makeState(mechanics_, conditions_, force_, linked_)) {
    const int d = dimension(), n = constraints();
    byTimeOfMomentum_ = sum_ = Vector::Zero(d);
    rates_ = rate_ = Vector::Zero(n);
    rhs_ = Vector::Zero(d + n);
    ahead_ = Vector::Zero(2 * d);
}

bool Mechanism::accelerate(double t, const double* q, const double* v, Vector& acceleration,
                           Vector& multipliers, double feedback) {
    const int d = dimension(), n = constraints();
    byTimeOfMomentum_.setZero();
    if (mechanics_.isTimeDependent) {
        const double apart = 1e-6 * std::max(1.0, std::abs(t));
        mechanics_.gradient(mechanics_.model.get(), t + apart, q, v, ahead_.data());
        byTimeOfMomentum_ = ahead_.tail(d);
        mechanics_.gradient(mechanics_.model.get(), t - apart, q, v, ahead_.data());
        byTimeOfMomentum_ = (byTimeOfMomentum_ - ahead_.tail(d)) / (2 * apart);
    }
    state_->evaluate(t, q, v);
    state_->rates(t, q, v, rates_);
    state_->massRate(v, sum_);
    rhs_.head(d) = state_->gradient().head(d) + state_->forces() - sum_ - byTimeOfMomentum_;
    rhs_.tail(n) = -rates_;
    if (feedback > 0) {
        state_->rate(v, rate_);
        rhs_.tail(n) -= 2 * feedback * (rate_ + state_->byTime()) + feedback * feedback * state_->value();
    }
    const bool isSolved = solveForState();
    acceleration = rhs_.head(d);
    multipliers = rhs_.tail(n);
    return isSolved;
}

bool Mechanism::project(double t, const double* q, double* p, Vector& v, Vector& kappa, bool knowsVelocity) {
    const int d = dimension(), n = constraints();
    kappa = Vector::Zero(n);
    if (v.size() != d) v = Vector::Zero(d);
    if (!knowsVelocity && !mechanics_.velocity(mechanics_.model.get(), t, q, p, v.data())) return false;
    if (n == 0) return true;
    given_ = Eigen::Map<const Vector>(p, d);
    // Of the velocities on the way: where they end at 0, their round-off is that of those before.
    double scale = v.cwiseAbs().maxCoeff();
    StepReport report;
    const Outcome solved = solveByCorrections(ofVelocities, {}, report, [&](int, double) {
        state_->evaluate(t, q, v.data());
        state_->reaction(kappa, sum_);
        state_->rate(v.data(), rate_);
        rhs_.head(d) = given_ + sum_ - state_->gradient().tail(d);
        rhs_.tail(n) = -(rate_ + state_->byTime());
        if (!solveForState()) return Correction{.outcome = Outcome::singular};
        v += rhs_.head(d);
        kappa += rhs_.tail(n);
        scale = std::max(scale, v.cwiseAbs().maxCoeff());
        return Correction{rhs_.head(d).cwiseAbs().maxCoeff(), scale};
    });
    if (solved != Outcome::converged) return false;
    state_->reaction(kappa, sum_);
    for (int i = 0; i < d; ++i) p[i] = given_(i) + sum_(i);
    return true;
}

std::optional<double> Mechanism::strike(double t, const double* q, double* p, const double* normal,
                                        double target) {
    const int d = dimension(), n = constraints();
    const Vector given = Eigen::Map<const Vector>(p, d);
    const Eigen::Map<const Vector> along(normal, d);
    Vector v(d);
    if (!mechanics_.velocity(mechanics_.model.get(), t, q, p, v.data())) return {};
    Vector reactions = Vector::Zero(n), byImpulse(d + n);
    double impulse = 0;
    StepReport report;
    const Outcome solved = solveByCorrections(ofVelocities, {}, report, [&](int, double) {
        state_->evaluate(t, q, v.data());
        state_->reaction(reactions, sum_);
        state_->rate(v.data(), rate_);
        rhs_.head(d) = given + sum_ + impulse * along - state_->gradient().tail(d);
        rhs_.tail(n) = -(rate_ + state_->byTime());
        byImpulse.head(d) = along;
        byImpulse.tail(n).setZero();
        if (!solveForState()) return Correction{.outcome = Outcome::singular};
        state_->solve(byImpulse);
        // The impulse that is missing, from the one row more.
        const double more = (target - along.dot(v) - along.dot(rhs_.head(d))) / along.dot(byImpulse.head(d));
        rhs_ += more * byImpulse;
        v += rhs_.head(d);
        reactions += rhs_.tail(n);
        impulse += more;
        return Correction{rhs_.head(d).cwiseAbs().maxCoeff(), v.cwiseAbs().maxCoeff(), true,
                          rhs_.allFinite() ? Outcome::converged : Outcome::notFinite};
    });
    if (solved != Outcome::converged) return {};
    state_->reaction(reactions, sum_);
    for (int i = 0; i < d; ++i) p[i] = given(i) + impulse * along(i) + sum_(i);
    return impulse;
}

bool Mechanism::projectPlace(double t, double* q) {
    const int d = dimension(), n = constraints();
    if (n == 0) return true;
    const Vector atRest = Vector::Zero(d);
    Eigen::Map<Vector> place(q, d);
    StepReport report;
    const CorrectionLimits limits{.roundOff = 1e-12};
    return solveByCorrections(limits, {}, report, [&](int, double) {
               state_->evaluate(t, q, atRest.data());
               rhs_.head(d).setZero();
               rhs_.tail(n) = -state_->value();
               if (!solveForState()) return Correction{.outcome = Outcome::singular};
               place += rhs_.head(d);
               return Correction{rhs_.head(d).cwiseAbs().maxCoeff(), place.cwiseAbs().maxCoeff()};
           }) == Outcome::converged;
}

bool Mechanism::solveForState() {
    if (!state_->factorise()) return false;
    state_->solve(rhs_);
    return rhs_.allFinite();
}

bool Mechanism::flow(double t, const double* q, const double* p, double* qdot, double* pdot,
                     double feedback) {
    const int d = dimension();
    if (!mechanics_.velocity(mechanics_.model.get(), t, q, p, qdot)) return false;
    if (constraints() == 0) {
        mechanics_.gradient(mechanics_.model.get(), t, q, qdot, ahead_.data());
        if (force_) force_->value(force_->model.get(), t, q, qdot, sum_.data());
        for (int i = 0; i < d; ++i) pdot[i] = ahead_(i) + (force_ ? sum_(i) : 0);
        return true;
    }
    if (!accelerate(t, q, qdot, acceleration_, multipliers_, feedback)) return false;
    state_->reaction(multipliers_, sum_);
    Eigen::Map<Vector>(pdot, d) = state_->gradient().head(d) + state_->forces() + sum_;
    return true;
}

const Mechanism::Vector& Mechanism::byTime(double t, const double* q) {
    state_->evaluateConstraint(t, q);
    return state_->byTime();
}

void Mechanism::reaction(double t, const double* q, const Vector& lambda, Vector& to) {
    state_->evaluateConstraint(t, q);
    state_->reaction(lambda, to);
}

double Mechanism::largestValue(double t, const double* q) {
    if (!constraint()) return 0;
    state_->evaluateConstraint(t, q);
    return state_->value().cwiseAbs().maxCoeff();
}

double Mechanism::largestRate(double t, const double* q, const double* v) {
    if (constraints() == 0) return 0;
    state_->evaluateConstraint(t, q);
    state_->rate(v, rate_);
    return (rate_ + state_->byTime()).cwiseAbs().maxCoeff();
}

Mechanism::Rank Mechanism::rank(double t, const double* q) {
    Rank found;
    if (constraints() == 0) return found;
    const Vector atRest = Vector::Zero(dimension());
    state_->evaluate(t, q, atRest.data());
    // Rows of unit length in the metric of the mass: then the last pivot that is left of each row, once those
    // before it are taken out, tells how much of it is its own.
    const Vector own = state_->ownParts();
    for (int k = 0; k < constraints(); ++k)
        if (own(k) < found.ratio) found = {own(k), k};
    return found;
}

}  // namespace extremal
