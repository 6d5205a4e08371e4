// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/energy_momentum/element_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/solve/step_continuation.hpp"

namespace extremal {

ElementStep::ElementStep(Mechanics<double> mechanics, Table<double> table, const SolverPolicy& policy)
    : mechanics_(std::move(mechanics)),
      table_(std::move(table)),
      kernel_(mechanics_, table_, ElementBasis::increments),
      policy_(policy),
      tolerance_(toleranceOf<double>(policy)) {
    const int d = dimension(), unknowns = table_.unknowns() * d;
    lu_ = SmallLu<double>(unknowns);
    for (Vector* v : {&Y_, &byStep_, &residual_}) *v = Vector::Zero(unknowns);
    z_ = Vector::Zero(unknowns + d);
    p0_ = velocity_ = Vector::Zero(d);
    masses_ = Vector::Zero(d);
    gradient_ = Vector::Zero(2 * d);
    hessian_ = Vector::Zero(4 * d * d);
}

void ElementStep::startAt(const double* q, const double* p) {
    isSolved_ = false;
    for (int k = 0; k < dimension(); ++k) {
        z_(k) = q[k];
        p0_(k) = p[k];
    }
}

bool ElementStep::startAfresh(double t, double h) {
    if (!mechanics_.velocity(mechanics_.model.get(), t, z_.data(), p0_.data(), velocity_.data()))
        return false;
    Y_.setZero();
    Y_.tail(dimension()) = h * velocity_;
    return true;
}

/// S and all its derivatives, and the left-hand sides of the equations, at the present Y.
bool ElementStep::evaluate(double t, double h, StepReport& report) {
    const int d = dimension(), n = unknowns();
    z_.tail(n) = Y_;
    report.cost.evaluations += table_.nodes();
    if (!kernel_.evaluate(t, h, z_, DerivativeOrder::second, derivatives_)) return false;
    const auto& S = derivatives_.gradient;
    residual_ = S.tail(n);
    for (int k = 0; k < d; ++k) residual_(n - d + k) = p0_(k) + (S(k) - S(n + k));
    return true;
}

/// L_vv(k, k) at the start of the step and its mean velocity.
void ElementStep::findMasses(double t, double h) {
    const int d = dimension();
    double value = 0;
    velocity_ = Y_.tail(d) / h;
    mechanics_.jet(mechanics_.model.get(), t, z_.data(), velocity_.data(), &value, gradient_.data(),
                   hessian_.data());
    for (int k = 0; k < d; ++k) masses_(k) = hessian_((d + k) * (2 * d + 1));
}

/// Takes half of the last correction back until S is finite: no Newton step leads out of the domain of L.
bool ElementStep::retreat(double t, double h, StepReport& report) {
    for (int halvings = 0; halvings < mostRetreats; ++halvings) {
        residual_ /= 2;
        Y_ += residual_;
        if (evaluate(t, h, report)) return true;
    }
    return false;
}

Outcome ElementStep::newton(double t, double h, const std::stop_token& stop, StepReport& report) {
    const int d = dimension(), n = unknowns(), m = table_.unknowns();
    const auto limits = NewtonLimits<double>::elementStep(tolerance_);
    NewtonPolicy<double> policy(limits);
    for (int iteration = 0; iteration < policy_.maxIterations; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        if (!evaluate(t, h, report)) {
            hasLeftDomain_ = true;
            if (iteration == 0 || !retreat(t, h, report)) return Outcome::notFinite;
            policy = NewtonPolicy<double>(limits);  // the last correction was cut short
        }
        const auto& H = derivatives_.hessian;
        for (int j = 0; j < n; ++j) {
            double* const column = lu_.column(j);
            for (int i = 0; i < n - d; ++i) column[i] = H(d + i, d + j);
            for (int k = 0; k < d; ++k) column[n - d + k] = H(k, d + j) - H(n + k, d + j);
        }
        if (const Outcome factors = lu_.factorise(); factors != Outcome::converged) return factors;
        lu_.solve(residual_.data());
        report.cost.linearSolves += 2;
        ++report.cost.iterations;
        const auto coordinate = [&](int k) {
            CoordinateCorrection<double> c{0, 0, z_(k), masses_(k), h * p0_(k)};
            for (int a = 0; a < m; ++a) {
                c.change = std::max(c.change, std::abs(residual_(a * d + k)));
                c.increments = std::max(c.increments, std::abs(Y_(a * d + k)));
            }
            return c;
        };
        double size = 0;
        for (int k = 0; k < d; ++k) {
            const CoordinateCorrection<double> c = coordinate(k);
            size = std::max(size, relativeCorrection(c.change, c.increments, c.value));
        }
        report.residual = size;
        const auto end = endOf(policy.judge(size, [&] {
            findMasses(t, h);
            return measureCorrection<double>(d, coordinate);
        }));
        policy.jacobianIsNew();
        if (end) return *end;
        Y_ -= residual_;
    }
    return Outcome::diverged;
}

Outcome ElementStep::solve(double t, double h, const std::stop_token& stop, StepReport& report) {
    if (isSolved_ && h == h_) return Outcome::converged;
    Outcome outcome = Outcome::diverged;
    hasLeftDomain_ = false;
    if (isSolved_) {
        Y_ += (h - h_) * byStep_;
        outcome = newton(t, h, stop, report);
    }
    if (outcome != Outcome::converged && outcome != Outcome::stopped)
        outcome = startAfresh(t, h) ? newton(t, h, stop, report) : Outcome::singular;
    if (outcome != Outcome::converged && outcome != Outcome::stopped && hasLeftDomain_) {
        const bool hasArrived = StepContinuation<double>().follow(Y_, [&](double part, bool isFresh) {
            return !stop.stop_requested() && (!isFresh || startAfresh(t, part * h)) &&
                   newton(t, part * h, stop, report) == Outcome::converged;
        });
        if (hasArrived) outcome = Outcome::converged;
        if (stop.stop_requested()) outcome = Outcome::stopped;
    }
    h_ = h;
    isSolved_ = outcome == Outcome::converged;
    if (isSolved_) followStep();
    return outcome;
}

/// dY/dh with the factors of the last iteration, and dE_d/dh.
void ElementStep::followStep() {
    const int d = dimension(), n = unknowns();
    const auto& c = derivatives_.gradientByStep;
    byStep_ = -c.tail(n);
    for (int k = 0; k < d; ++k) byStep_(n - d + k) = c(n + k) - c(k);
    lu_.solve(byStep_.data());
    energyByStep_ = -derivatives_.byStepTwice - c.tail(n).dot(byStep_);
}

bool ElementStep::applyTangent(double* W, int columns) {
    const int d = dimension(), n = unknowns();
    const auto& H = derivatives_.hessian;
    const auto& c = derivatives_.gradientByStep;
    if (moved_.size() == 0) {
        moved_ = Vector::Zero(n + d + 1);
        extended_ = SmallLu<double>(n + 1);
    }
    const auto start = [&](int k, int column) { return H(k, column) - H(n + k, column); };
    for (int j = 0; j <= n; ++j) {
        double* const column = extended_.column(j);
        for (int i = 0; i < n - d; ++i) column[i] = j < n ? H(d + i, d + j) : c(d + i);
        for (int k = 0; k < d; ++k) column[n - d + k] = j < n ? start(k, d + j) : c(k) - c(n + k);
        column[n] = j < n ? -c(d + j) : -derivatives_.byStepTwice;
    }
    if (extended_.factorise() != Outcome::converged) return false;
    for (double* w = W; columns > 0; --columns, w += 2 * d + 2) {
        const Eigen::Map<const Vector> dq(w + 1, d);
        Eigen::Map<Vector> dp(w + d + 2, d);
        for (int i = 0; i < n - d; ++i) moved_(i) = -H.row(d + i).head(d).dot(dq);
        for (int k = 0; k < d; ++k)
            moved_(n - d + k) = H.row(n + k).head(d).dot(dq) - H.row(k).head(d).dot(dq) - dp(k);
        moved_(n) = -w[d + 1] + c.head(d).dot(dq);
        extended_.solve(moved_.data());
        const double dh = moved_(n);
        for (int i = n; i-- > 0;) moved_(d + i) = moved_(i);
        moved_.head(d) = dq;
        for (int k = 0; k < d; ++k) {
            dp(k) += H.row(k).dot(moved_.head(n + d)) + c(k) * dh;
            w[1 + k] += moved_(n + k);
        }
        w[0] += dh;
    }
    return true;
}

double ElementStep::energyScale() const {
    const double lagrangian = derivatives_.action / h_;
    return std::abs(lagrangian) + std::abs(lagrangian + discreteEnergy());
}

void ElementStep::denseOutput(double t, double tau, std::span<double> x) const {
    const int d = dimension(), m = table_.unknowns();
    std::vector<double> value(static_cast<std::size_t>(table_.space.size)), slope(value.size());
    table_.space.evaluate(tau, value, slope);
    const Vector phi = table_.change.transpose() * Eigen::Map<const Vector>(value.data(), table_.space.size);
    const auto at = [](int k) { return static_cast<std::size_t>(k); };
    for (int k = 0; k < d; ++k) {
        x[at(k)] = z_(k);
        x[at(d + k)] = p0_(k);
        for (int a = 0; a < m; ++a) x[at(k)] += phi(a) * Y_(a * d + k);
    }
    const std::vector<double> share = weightsUpTo(table_, tau);
    Vector q(d), v(d), gradient(2 * d);
    for (int i = 0; i < table_.nodes(); ++i) {
        q = z_.head(d);
        v.setZero();
        for (int a = 0; a < m; ++a) {
            q += table_.value(i, a) * Y_.segment(a * d, d);
            v += table_.derivative(i, a) / h_ * Y_.segment(a * d, d);
        }
        mechanics_.gradient(mechanics_.model.get(), t + table_.node(i) * h_, q.data(), v.data(),
                            gradient.data());
        for (int k = 0; k < d; ++k) x[at(d + k)] += h_ * share[static_cast<std::size_t>(i)] * gradient(k);
    }
}

}  // namespace extremal
