// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/sweep/null_space_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/solve/fixed_point_policy.hpp"

namespace extremal {
namespace {

using Matrix = Eigen::MatrixXd;
constexpr double roundOff = std::numeric_limits<double>::epsilon();

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

using Array = std::vector<Lanes>;
double* numbers(Array& of) { return of.empty() ? nullptr : of.front().lane.data(); }
const double* numbers(const Array& of) { return of.empty() ? nullptr : of.front().lane.data(); }

/// Entries of `stride` nodes, which is a multiple of eight.
Array room(Eigen::Index entries, Eigen::Index stride) {
    return Array(at(entries * stride) / Lanes::size, Lanes(0.0));
}

/// By columns, padded with rows of zeros or of the last one.
Array byColumns(const Matrix& matrix, bool repeatsLast = false) {
    const Eigen::Index rows = matrix.rows(), stride = inWholeLanes(rows);
    Array made = room(matrix.cols(), stride);
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        for (Eigen::Index i = 0; i < (repeatsLast ? stride : rows); ++i)
            numbers(made)[j * stride + i] = matrix(std::min(i, rows - 1), j);
    return made;
}

/// Multiples of one unit, of which sums are exact as long as they are not much larger than their terms.
Matrix onGrid(const Matrix& given) {
    constexpr int bitsForSums = 1;
    const double unit = std::ldexp(roundOff, std::ilogb(1 + given.cwiseAbs().maxCoeff()) + bitsForSums);
    return (given / unit).array().round() * unit;
}

/// by * from + offset.
void scale(const Array& from, double by, double offset, Array& to) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) to[i] = Lanes(by) * from[i] + Lanes(offset);
}

}  // namespace

NullSpaceIteration::Gradients NullSpaceIteration::gradientsOf(const Mechanism& mechanism) {
    const auto& L = mechanism.mechanics();
    const std::optional<Force>& force = mechanism.force();
    if (!force) return {L.gradients, L.model.get()};
    const Force::WithLagrangian* const both = force->withLagrangian.get();
    if (!both || both->lagrangian != L.model.get()) return {};
    return {both->gradients, force->model.get()};
}

std::optional<NullSpaceIteration> NullSpaceIteration::of(const Mechanism& mechanism,
                                                         const MechanismCurve& curve,
                                                         const SolverPolicy& policy) {
    const std::optional<Constraint>& constraint = mechanism.constraint();
    const int freedoms = mechanism.dimension() - mechanism.constraints();
    if (policy.method == SolverMethod::newton || mechanism.linked() || mechanism.rolling()) return {};
    if (!constraint || !constraint->dependence || constraint->isTimeDependent) return {};
    if (freedoms < 1 || freedoms > SharedCoordinates::mostFree || !gradientsOf(mechanism).call) return {};
    if (mechanism.force() && !curve.areForcesInside()) return {};
    // Of many tests, one for each place, rounding adds up to more than of those of Newton's method.
    constexpr int mostToRoundOff = 6;
    if (toleranceOf<double>(policy) <= 10 * roundOff && curve.unknowns() > mostToRoundOff) return {};
    NullSpaceIteration made(mechanism, curve, policy);
    return made.inverse_.empty() ? std::nullopt : std::optional(std::move(made));
}

NullSpaceIteration::NullSpaceIteration(const Mechanism& mechanism, const MechanismCurve& curve,
                                       const SolverPolicy& policy)
    : mechanics_(mechanism.mechanics()),
      constraint_(*mechanism.constraint()),
      sharing_(mechanics_, constraint_),
      force_(mechanism.force()),
      gradients_(gradientsOf(mechanism)),
      policy_(policy),
      tolerance_(toleranceOf<double>(policy)),
      isExact_(tolerance_ <= 10 * roundOff),
      isTimeDependent_(mechanics_.isTimeDependent || (force_ && force_->isTimeDependent)),
      d_(mechanism.dimension()),
      n_(mechanism.constraints()),
      m_(curve.unknowns()),
      nodes_(curve.atLagrangian.nodes()),
      places_(inWholeLanes(m_)),
      inside_(inWholeLanes(nodes_)),
      fit_(curve.fit),
      toPlaces_(curve.atPlaces.bottomRows(m_)) {
    // Functions l_b, b = 1..m, and tests l_a, a = 0..m-1, are the same numbers, whose sums are exact: what a
    // symmetry keeps is then kept but for rounding without a bias.
    const Matrix value = onGrid(curve.atLagrangian.at.value * fit_),
                 slope = onGrid(curve.atLagrangian.at.slope * fit_);
    Matrix testValue(m_, nodes_), testSlope(m_, nodes_);
    testValue << (Vector::Ones(nodes_) - value.rowwise().sum()).transpose(),
        value.leftCols(m_ - 1).transpose();
    testSlope << -slope.rowwise().sum().transpose(), slope.leftCols(m_ - 1).transpose();
    const Vector weights = Eigen::Map<const Vector>(curve.atLagrangian.rule.b.data(), nodes_);
    const Matrix K = testSlope * weights.asDiagonal() * slope;
    if (!(dense::Lu<double>(K).pivotRatio() > 1e-10)) return;
    inverse_ = byColumns(dense::inverse<double>(K));
    value_ = byColumns(value, true);
    slope_ = byColumns(slope, true);
    testValue_ = byColumns(testValue);
    testSlope_ = byColumns(testSlope);
    weight_ = byColumns(weights);
    if (curve.table.extrapolation.size() > 0)
        onward_ = byColumns(toPlaces_ * curve.table.extrapolation * fit_);
    constexpr double apart = 1e-3;
    const MechanismCurve::Samples before = curve.samples({1 - apart});
    velocityAtEnd_ = (curve.endSlope * fit_).transpose();
    accelerationAtEnd_ = ((curve.endSlope - before.slope) / apart * fit_).transpose();
    v_ = a_ = Vector::Zero(d_);
    const auto timesOf = [](const std::vector<double>& c, std::size_t first) {
        return byColumns(
            Eigen::Map<const Vector>(c.data() + first, static_cast<Eigen::Index>(c.size() - first)), true);
    };
    nodeTime_ = times_ = timesOf(curve.atLagrangian.rule.c, 0);
    placeTime_ = placeTimes_ = timesOf(curve.places, 1);
    ends_.assign(curve.places.begin() + 1, curve.places.end());

    const int f = freedoms(), factors = f * (f + 1) / 2;
    U_ = previousU_ = P_ = R_ = start_ = change_ = lastChange_ = room(d_, places_);
    Q_ = V_ = room(d_, inside_);
    gradient_ = room(2 * d_, inside_);
    N_ = room(n_ * (f + 1), places_);
    factor_ = room(factors, places_);
    E_ = S_ = lastS_ = room(f, places_);
    perSize_.assign(at(d_), 0.0);
    least_ = perSize_;
    size_.resize(at(d_));
}

void NullSpaceIteration::setStep(double h) {
    h_ = h;
    scale(slope_, 1 / h, 0, slopeOverH_);
    scale(weight_, h, 0, weightH_);
    scale(inverse_, -h, 0, inverseH_);
}

bool NullSpaceIteration::startFromMotion(const From& from, const Vector& v, const Vector& a) {
    for (int k = 0; k < d_; ++k)
        for (int j = 0; j < m_; ++j) {
            const double t = ends_[at(j)] * from.h;
            numbers(U_)[k * places_ + j] = t * (v(k) + t / 2 * a(k));
        }
    return start(from, v);
}

/// Velocity and acceleration as the last curve has them at its end: where a curve that goes on swings far,
/// these do not.
bool NullSpaceIteration::startFromEnd(const From& from) {
    if (!std::exchange(hasLast_, false)) return false;
    const Array& last = previousU_;
    for (int k = 0; k < d_; ++k) {
        double v = 0, a = 0;
        for (int j = 0; j < m_; ++j) {
            v += velocityAtEnd_(j) * numbers(last)[k * places_ + j];
            a += accelerationAtEnd_(j) * numbers(last)[k * places_ + j];
        }
        v_(k) = v / h_;
        a_(k) = a / (h_ * h_);
    }
    return startFromMotion(from, v_, a_);
}

bool NullSpaceIteration::startFromCurve(const From& from, const Vector& v, const Vector& Y) {
    const Matrix U = toPlaces_.lazyProduct(Eigen::Map<const Mechanism::Rows>(Y.data(), m_, d_));
    for (int k = 0; k < d_; ++k)
        for (int j = 0; j < m_; ++j) numbers(U_)[k * places_ + j] = U(j, k);
    return start(from, v);
}

/// With increments in U.
bool NullSpaceIteration::start(const From& from, const Vector& v) {
    hasCurve_ = isGoingOn_ = false;
    prepare(from);
    for (int k = 0; k < d_; ++k)
        for (int j = 0; j < places_; ++j) {
            const int entry = k * places_ + j;
            double& U = numbers(U_)[entry];
            if (j >= m_) U = 0;
            numbers(P_)[entry] = from.q[k] + U;
        }
    sharing_.takeMasses(from.t, from.q, v.data());
    return share(from);
}

/// Shares the coordinates out for the curve at hand.
bool NullSpaceIteration::share(const From& from) {
    for (int k = 0; k < d_; ++k) v_(k) = numbers(P_)[k * places_ + m_ - 1];
    if (!sharing_.share(from.t, from.q, v_.data())) return false;
    sharing_.factorise();
    return true;
}

bool NullSpaceIteration::goOn(const From& from) {
    hasLast_ = false;
    constexpr double poor = 1.5, slow = 0.1;
    if (!std::exchange(hasCurve_, false) || onward_.empty() || from.h != h_) return false;
    std::swap(previousU_, U_);
    hasLast_ = true;
    prepare(from);
    kernel_.extrapolate(sweep_, numbers(onward_), numbers(previousU_));
    const double *const now = numbers(U_) + m_ - 1, *const before = numbers(previousU_) + m_ - 1;
    double turned = 0, moved = 0;
    for (int k = 0; k < d_; ++k) {
        const double last = before[k * places_], next = now[k * places_];
        turned += std::abs(sharing_.mass(k)) * (next - last) * (next - last);
        moved += std::abs(sharing_.mass(k)) * last * last;
        countBy(k, 0.5 * m_ * std::max(std::abs(last), std::abs(next)));  // as a sum over the places
    }
    if (!(turned <= moved)) return false;
    const bool isPoor = sharing_.largest() > poor, isSlow = contraction_ > slow && !mechanics_.isSeparable;
    if (isSlow) {
        if (!mechanics_.velocity(mechanics_.model.get(), from.t, from.q, from.p, v_.data())) return false;
        sharing_.takeMasses(from.t, from.q, v_.data());
        sharing_.factorise();
    }
    return isGoingOn_ = !isPoor || share(from);
}

/// What all kernels of a step are handed.
void NullSpaceIteration::prepare(const From& from) {
    if (from.h != h_) setStep(from.h);
    if (isTimeDependent_) {
        scale(nodeTime_, h_, from.t, times_);
        scale(placeTime_, h_, from.t, placeTimes_);
    }
    stop_ = &from.stop;
    NullSpaceSweep& s = sweep_;
    s.shared = sharing_.shared();
    s.functions = m_;
    s.nodes = nodes_;
    s.places = places_;
    s.inside = inside_;
    s.value = numbers(value_);
    s.slope = numbers(slopeOverH_);
    s.testValue = numbers(testValue_);
    s.testSlope = numbers(testSlope_);
    s.weightOfValue = numbers(weightH_);
    s.weightOfSlope = numbers(weight_);
    s.inverse = numbers(inverseH_);
    s.q = from.q;
    s.p = from.p;
    s.start = numbers(start_);
    for (int k = 0; k < d_; ++k) numbers(start_)[k * places_] = from.p[k];
    s.U = numbers(U_);
    s.P = numbers(P_);
    s.Q = numbers(Q_);
    s.V = numbers(V_);
    s.gradient = numbers(gradient_);
    s.N = numbers(N_);
    s.back = s.N + n_ * freedoms() * places_;
    s.startN = sharing_.N().data();
    s.factor = numbers(factor_);
    s.startFactor = sharing_.factor().data();
    s.R = numbers(R_);
    s.E = numbers(E_);
    s.perSize = perSize_.data();
    s.least = least_.data();
}

void NullSpaceIteration::evaluate() {
    const Constraint::AtNodes& dependence = sharing_.dependence();
    dependence.call(dependence.model.get(), numbers(placeTimes_), places_, sweep_.P, numbers(N_));
    kernel_.move(sweep_);
    gradients_.call(gradients_.model, numbers(times_), inside_, sweep_.Q, sweep_.V, numbers(gradient_));
}

/// Changes of a coordinate count relative to its increments in the step, or to the round-off of its value, as
/// relativeCorrection() has it.
void NullSpaceIteration::countBy(int k, double increments) {
    const double rounded = roundOff * std::abs(sweep_.q[k]), known = std::max(increments, rounded);
    least_[at(k)] = 0.01 * rounded;
    perSize_[at(k)] = known > 0 ? 1 / known : 1;
}

/// The last change and what it counts by, with increments as they are now; the nearness is that of all
/// coordinates together in the metric of the masses.
double NullSpaceIteration::measureAgain() {
    kernel_.measure(sweep_, size_.data());
    double largest = 0, change = 0, increments = 0;
    for (int k = 0; k < d_; ++k) {
        const ChangeSize& size = size_[at(k)];
        const double root = std::sqrt(std::abs(sharing_.mass(k))),
                     least = 100 * roundOff * std::abs(sweep_.q[k]);
        countBy(k, size.scale);
        largest = std::max(largest, relativeCorrection(size.change, size.scale, sweep_.q[k]));
        change = std::max(change, root * size.change);
        increments = std::max(increments, root * std::max(size.scale, least));
    }
    nearness_ = change > 0 ? change / increments : 0;
    return largest;
}

CorrectionSize<double> NullSpaceIteration::measured() {
    kernel_.measure(sweep_, size_.data());
    return measureCorrection<double>(d_, [&](int k) {
        const ChangeSize& size = size_[at(k)];
        return CoordinateCorrection<double>{size.change, size.scale, sweep_.q[k], sharing_.mass(k),
                                            h_ * sweep_.p[k]};
    });
}

Outcome NullSpaceIteration::solve(StepReport& report) {
    using Verdict = FixedPointPolicy<double>::Verdict;
    NullSpaceSweep& s = sweep_;
    constexpr int worth = 21;
    constexpr double noise = 1e3 * roundOff;  // of sums with slopes of tests that cancel
    FixedPointPolicy<double> policy(tolerance_ / 10, worth, noise);
    constexpr double slow = 0.03, linear = 0.25;
    double before = 1;
    contraction_ = 0;
    for (int iteration = 0; iteration < policy_.maxIterations; ++iteration) {
        if (stop_->stop_requested()) return Outcome::stopped;
        std::swap(S_, lastS_);
        std::swap(change_, lastChange_);
        s.S = numbers(S_);
        s.lastS = numbers(lastS_);
        s.change = numbers(change_);
        s.lastChange = numbers(lastChange_);
        evaluate();
        double size = 0;
        s.isFirst = iteration == 0;
        kernel_.balance(s, &size);
        // Where the first change is a small part of what the last increments promise, it is so of all
        // together.
        if (s.isFirst) {
            nearness_ = size;
            if (!isGoingOn_ || !(size <= farFromRoot)) size = measureAgain();
            if (isGoingOn_ && nearness_ > 1) return Outcome::diverged;
        }
        ++report.cost.iterations;
        report.cost.evaluations += nodes_;
        report.residual = size;
        if (iteration > 0 && size > roundOffOfSums<double>())
            contraction_ = std::max(contraction_, size / before);
        const bool isSlow = iteration > 0 && size > slow * before;
        before = std::min(size, 1.0);
        const Verdict verdict = policy.judge(size, [&] { return measured(); });
        if (verdict == Verdict::notFinite) return Outcome::notFinite;
        if (verdict == Verdict::slow) return Outcome::diverged;
        if (verdict == Verdict::proceed) {
            if (isSlow) kernel_.accelerate(s);
            kernel_.apply(s);
            continue;
        }
        if (!isOneRoot(nearness_, size, iteration, linear)) return Outcome::diverged;
        if (isExact_) {
            kernel_.apply(s);
            evaluate();
            kernel_.balance(s, &size);
            report.cost.evaluations += nodes_;
        }
        hasCurve_ = true;
        return Outcome::converged;
    }
    return Outcome::diverged;
}

void NullSpaceIteration::curve(Eigen::Ref<Vector> Y) const {
    for (int k = 0; k < d_; ++k)
        for (int a = 0; a < m_; ++a) {
            double sum = 0;
            for (int j = 0; j < m_; ++j) sum += fit_(a, j) * numbers(U_)[k * places_ + j];
            Y(a * d_ + k) = sum;
        }
}

/// G_D^T Lambda = -R_D at each place.
void NullSpaceIteration::multipliers(double t, const double* q, Vector& Lambda) const {
    Vector value(n_), byTime(n_), R(n_), place = Eigen::Map<const Vector>(q, d_);
    Mechanism::Rows G(n_, d_);
    Matrix GD(n_, n_);
    for (int a = 0; a < m_; ++a) {
        for (int k = 0; a > 0 && k < d_; ++k) place(k) = q[k] + numbers(U_)[k * places_ + a - 1];
        constraint_.first(constraint_.model.get(), t, place.data(), value.data(), G.data(), byTime.data());
        for (int c = 0; c < n_; ++c) {
            const int k = sharing_.dependent(c);
            R(c) = -numbers(R_)[k * places_ + a];
            GD.row(c) = G.col(k).transpose();
        }
        Lambda.segment(a * n_, n_) = dense::solve<double>(GD, Matrix(R));
    }
}

void NullSpaceIteration::increments(Vector& dq, Vector& dp) {
    const int last = m_ - 1;
    for (int k = 0; k < d_; ++k) dq(k) = numbers(U_)[k * places_ + last];
    kernel_.impulse(sweep_, dp.data());
    sharing_.moveTo(numbers(N_) + last, places_);
}

bool NullSpaceIteration::project(const Vector& p, Vector& impulse) const {
    if (!mechanics_.isSeparable) return false;
    sharing_.project(p, impulse);
    return true;
}

void NullSpaceIteration::checkpoint(Archive& archive) {
    archive(U_, sharing_, hasCurve_, contraction_, h_);
    if (archive.isReading() && hasCurve_) setStep(h_);
}

}  // namespace extremal
