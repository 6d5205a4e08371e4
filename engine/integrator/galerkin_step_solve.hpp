// SPDX-License-Identifier: GPL-3.0-or-later
/// How GalerkinStep finds its unknowns: the two equations, starting values, Newton's method and the fixed
/// point. Included by galerkin_step_build.hpp.
#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "engine/core/algebra/elimination.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/solve/step_continuation.hpp"

namespace extremal {

/// R(Y), the step as the two equations it is: stationarity of the discrete action inside the step and at its
/// start. Only sums over the nodes are behind actionGradient.
template <class T, int D>
void GalerkinStep<T, D>::residual() {
    R_.setZero();
    for (int k = 0; k < d(); ++k) {
        T* const R = R_.data() + offset(k);
        // Inside, a < m - 1:  dS/dY_a = sum_i w_i [ L_q(i) phi_a(c_i) + L_v(i) phi_a'(c_i) ] = 0.
        const Accumulator impulse = actionGradient(k, R);
        // At the start:  p_0 + sum_i w_i [ L_q(i) psi(c_i) + L_v(i) psi'(c_i) ] = 0,  psi = 1 - phi_{m-1}.
        // On a fast motion the two sums are far larger than their difference.
        T& last = R[m(k) - 1];
        last = isVectorised_ ? static_cast<T>(Accumulator(p0_(k)) + (impulse - Accumulator(last)))
                             : p0_(k) + (static_cast<T>(impulse) - last);
    }
}

/// v(q_0, p_0) and the acceleration there: L_vv a = L_q - L_vq v (explicit time dependence of L_v is left
/// out: it only matters for the quality of a guess).
template <class T, int D>
bool GalerkinStep<T, D>::startVelocity(const T& t) {
    if (!mechanics_.velocity(mechanics_.model.get(), t, q0_.data(), p0_.data(), v0_.data())) return false;
    if (sparse_) {  // its matrix of masses is not solved for the sake of a guess
        a0_.setZero();
        if (!mechanics_.isSeparable) return true;
        mechanics_.force(mechanics_.model.get(), t, q0_.data(), a0_.data());
        ++report_.cost.evaluations;
        for (int k = 0; k < d(); ++k) a0_(k) /= mechanics_.masses[k];
        return a0_.allFinite();
    }
    T value;
    const int dim = d();
    roomForNewton();
    mechanics_.jet(mechanics_.model.get(), t, q0_.data(), v0_.data(), &value, jetGradient_.data(),
                   jetHessian_.data());
    ++report_.cost.evaluations;
    const Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> H(
        jetHessian_.data(), 2 * dim, 2 * dim);
    mass_ = H.bottomRightCorner(dim, dim);
    a0_ = jetGradient_.head(dim) - H.bottomLeftCorner(dim, dim).lazyProduct(v0_);
    eliminate(dim, mass_.data(), a0_.data());
    return a0_.allFinite();
}

/// Sets Y to a starting value. The fallback is q_0 + v_0 t + a_0 t^2 / 2 fitted in the space; where a step
/// has many periods that says nothing, and it starts from rest.
template <class T, int D>
bool GalerkinStep<T, D>::startFrom(const T& t, StartingValue start) {
    if (start != StartingValue::fallback) {
        for (int k = 0; k < d(); ++k) {
            const auto& onward =
                start == StartingValue::extrapolated ? table(k).extrapolation : table(k).smoothExtrapolation;
            Y_.segment(offset(k), m(k)).noalias() = onward.lazyProduct(previousY_.segment(offset(k), m(k)));
        }
        return true;
    }
    if (tables_.front().frequency != T(0)) {
        Y_.setZero();
        return true;
    }
    if (!startVelocity(t)) return false;
    // Galerkin projection of the second derivative: K Y = sum_i b_i psi(c_i) (-a_0) h ... for unit mass, with
    // p_0 -> v_0.
    for (int k = 0; k < d(); ++k) {
        const Table<T>& own = table(k);
        auto R = R_.segment(offset(k), m(k));
        for (int a = 0; a < m(k); ++a)
            R(a) = -h_ * detail::ofKineticEnergy(own).dot(own.testValue.col(a)) * a0_(k);
        R(m(k) - 1) -= v0_(k);
        Y_.segment(offset(k), m(k)).noalias() = functions(k).kineticInverse.lazyProduct(R);
        Y_.segment(offset(k), m(k)) *= kineticScale_;
    }
    return true;
}

/// Sets Y to the motion from (q_0, p_0) in explicit steps, fitted at the nodes.
template <class T, int D>
bool GalerkinStep<T, D>::startFromMotion(const T& t) {
    constexpr int pieces = 64;
    if (!mechanics_.flow) return false;
    const int dim = d(), width = 2 * dim;
    auto x = motion_.segment(0, width), at = motion_.segment(width, width),
         k = motion_.segment(2 * width, width), all = motion_.segment(3 * width, width);
    x << q0_, p0_;
    const T part = h_ / T(pieces);
    Columns places(n(), dim);
    int next = 0;
    const auto rate = [&](const T& time) {
        ++report_.cost.evaluations;
        return mechanics_.flow(mechanics_.model.get(), time, at.data(), at.data() + dim, k.data(),
                               k.data() + dim);
    };
    // Nodes are in order; each takes the place at the end of the piece that it is in, moved back linearly.
    for (int piece = 0; piece < pieces; ++piece) {
        const T begin = t + part * T(piece);
        all.setZero();
        at = x;
        for (int stage = 0; stage < 4; ++stage) {
            const T ahead = stage == 0 ? T(0) : stage == 3 ? T(1) : T(0.5);
            if (stage > 0) at = x + part * ahead * k;
            if (!rate(begin + part * ahead)) return false;
            all += (stage == 1 || stage == 2 ? T(2) : T(1)) * k / T(6);
        }
        for (; next < n() && tables_.front().node(next) * T(pieces) <= T(piece + 1); ++next) {
            const T inside = tables_.front().node(next) * T(pieces) - T(piece);
            places.row(next) = (x.head(dim) + part * inside * all.head(dim) - q0_).transpose();
        }
        x += part * all;
    }
    if (!x.allFinite() || next < n()) return false;
    for (int c = 0; c < dim; ++c) {
        const Square value = functions(c).value.topRows(n());
        Y_.segment(offset(c), m(c)) =
            Square(value.transpose() * value).partialPivLu().solve(Flat(value.transpose() * places.col(c)));
    }
    return Y_.allFinite() && shortenIntoDomain(t);
}

/// Makes the increments in Y smaller until L has a gradient at all nodes: where velocities are bounded, a
/// fitted curve may be slightly too fast.
template <class T, int D>
bool GalerkinStep<T, D>::shortenIntoDomain(const T& t) {
    constexpr int mostDoublings = 20;
    T part = T(1e-6);
    for (int doublings = 0; doublings <= mostDoublings; ++doublings, part *= T(2)) {
        placeNodes();
        evaluateGradients(t);
        if (gradient_.allFinite()) return true;
        Y_ *= T(1) - std::min(part, T(0.5));
    }
    return false;
}

/// Solves J delta = R, Newton's correction being -delta; returns its size relative to the unknowns.
template <class T, int D>
T GalerkinStep<T, D>::correction() {
    if constexpr (std::is_same_v<T, double>) {
        if (sparse_) {
            delta_ = R_;
            sparse_->solve(delta_.data());
        }
    }
    if (!sparse_) delta_ = lu_.solve(R_);
    ++report_.cost.linearSolves;
    T worst(0);
    for (int k = 0; k < d(); ++k) {
        const T increments = Y_.segment(offset(k), m(k)).cwiseAbs().maxCoeff();
        const T change = delta_.segment(offset(k), m(k)).cwiseAbs().maxCoeff();
        worst = std::max(worst, relativeCorrection(change, increments, T(q0_(k))));
    }
    return worst;
}

/// The largest L_vv(k, k) of the nodes, where the Jacobian was assembled last.
template <class T, int D>
T GalerkinStep<T, D>::massAt(int k) const {
    if (sparse_) return T(sparse_->massAt(k));
    return hessians_.col((d() + k) * 2 * d() + d() + k).head(n()).cwiseAbs().maxCoeff();
}

/// The size of the correction at hand, apart from that of buried coordinates.
template <class T, int D>
CorrectionSize<T> GalerkinStep<T, D>::measured() const {
    return measureCorrection<T>(d(), [&](int k) {
        return CoordinateCorrection<T>{delta_.segment(offset(k), m(k)).cwiseAbs().maxCoeff(),
                                       Y_.segment(offset(k), m(k)).cwiseAbs().maxCoeff(), q0_(k), massAt(k),
                                       h_ * p0_(k)};
    });
}

/// Takes half of the last correction back, as often as it is needed, until the residual is finite: no Newton
/// step leads out of the domain of L, such as beyond the speed of light or into a wall.
template <class T, int D>
bool GalerkinStep<T, D>::retreat(const T& t) {
    for (int halvings = 0; halvings < mostRetreats && delta_.allFinite(); ++halvings) {
        delta_ /= T(2);
        Y_ += delta_;
        placeNodes();
        evaluateGradients(t);
        residual();
        if (R_.allFinite()) return true;
    }
    return false;
}

/// Newton's method from the starting value in Y. At its end the forces at hand are those of the solution.
template <class T, int D>
Outcome GalerkinStep<T, D>::iterate(const T& t, StartingValue start, const std::stop_token& stop) {
    const auto limits = NewtonLimits<T>::condensedStep(tolerance_, start == StartingValue::fallback);
    NewtonPolicy<T> policy(limits);
    bool needsJacobian = true;
    placeNodes();
    for (int iteration = 0; iteration < policy_.maxIterations; ++iteration) {
        if (stop.stop_requested()) return Outcome::stopped;
        evaluateGradients(t);
        residual();
        if (iteration > 0 && !R_.allFinite()) {
            hasLeftDomain_ = true;
            if (!retreat(t)) return Outcome::notFinite;
            // A correction that was cut short says nothing of how the next ones should shrink.
            policy = NewtonPolicy<T>(limits);
            needsJacobian = true;
        }
        if (needsJacobian) {
            if (!assembleJacobian(t)) return Outcome::singular;
            policy.jacobianIsNew();
            needsJacobian = false;
        }
        const T size = correction();
        ++report_.cost.iterations;
        report_.residual = static_cast<double>(size);
        if (iteration == 0) nearness_ = size;
        const NewtonVerdict verdict = policy.judge(size, [&] { return measured(); });
        if (const auto end = endOf(verdict)) return *end;
        Y_ -= delta_;
        placeNodes();
        needsJacobian = verdict == NewtonVerdict::slow;
    }
    return Outcome::diverged;
}

/// Newton's method down the ladder of starting values.
template <class T, int D>
Outcome GalerkinStep<T, D>::newton(const T& t, StartingValue start, const std::stop_token& stop) {
    for (;;) {
        if (!startFrom(t, start)) return Outcome::singular;
        const Outcome result = iterate(t, start, stop);
        if (result == Outcome::converged) rememberNodes();
        if (result == Outcome::converged || result == Outcome::stopped || start == StartingValue::fallback)
            return result;
        start = ladder_.below(start, tables_.front().smoothExtrapolation.size() > 0);
    }
}

/// What the fixed point goes on from after a step of Newton's method.
template <class T, int D>
void GalerkinStep<T, D>::rememberNodes() {
    withFixedPoint([&](auto& solver) {
        if constexpr (std::is_same_v<std::decay_t<decltype(solver)>, NodeIteration<T>>)
            solver.remember(gradient_.leftCols(d()));
        else
            solver.remember(nodeV_.topRows(n()));
    });
}

template <class T, int D>
Outcome GalerkinStep<T, D>::fixedPoint(const T& t, const std::stop_token& stop) {
    Outcome result = Outcome::diverged;
    withFixedPoint([&](auto& solver) {
        result = solver.solve(t, q0_.data(), p0_.data(), carryQ_.data(), carryP_.data(),
                              policy_.maxIterations, stop, report_);
        if (result != Outcome::converged) return;
        solver.increments(dq_.data(), dp_.data(), carryQ_.data(), carryP_.data());
        nearness_ = solver.nearness();
        if (!dq_.allFinite() || !dp_.allFinite()) result = Outcome::notFinite;
    });
    return result;
}

template <class T, int D>
Outcome GalerkinStep<T, D>::solve(const T& t, const std::stop_token& stop) {
    /// A root this far from its starting value, against the increments of the step, may be another one than
    /// that of the motion.
    constexpr double far = 0.25;
    hasLeftDomain_ = false;
    Outcome result = anyRoot(t, stop);
    // A parabola may leave the domain of L, such as velocities below that of light; and with spaces of their
    // own some coordinates have many periods in a step, which no parabola follows.
    const bool isOutside = result == Outcome::notFinite || result == Outcome::singular,
               hasNoRoot = isOutside || (result == Outcome::diverged && tables_.size() > 1);
    if (hasNoRoot && defect_ && startFromMotion(t)) result = iterate(t, StartingValue::fallback, stop);
    if (result != Outcome::converged && result != Outcome::stopped && defect_ &&
        (isOutside || hasLeftDomain_)) {
        const Outcome followed = fromShorterSteps(t, stop);
        return followed == Outcome::converged || followed == Outcome::stopped ? followed : result;
    }
    if (result != Outcome::converged || !defect_ || !(nearness_ > T(far)) || followsForces(t)) return result;
    return fromElsewhere(t, stop);
}

/// Whether the curve at hand, of the last attempt, is one of the motion.
template <class T, int D>
bool GalerkinStep<T, D>::followsForces(const T& t) {
    coefficients(delta_.data());
    return defect_->isFollowing(t, h_, q0_.data(), p0_.data(), delta_.data());
}

/// Newton's method from starting values that do not continue the last step.
template <class T, int D>
Outcome GalerkinStep<T, D>::fromElsewhere(const T& t, const std::stop_token& stop) {
    isSolvedByFixedPoint_ = false;
    withFixedPoint([](auto& solver) { solver.forget(); });
    carryQ_.setZero();
    carryP_.setZero();
    newtonSteps_ = stepsWithNewton;
    Outcome result = newton(t, StartingValue::fallback, stop);
    if (result == Outcome::converged && followsForces(t)) return result;
    if (result == Outcome::stopped) return result;
    if (!startFromMotion(t)) return Outcome::lost;
    result = iterate(t, StartingValue::fallback, stop);
    if (result == Outcome::stopped || (result == Outcome::converged && followsForces(t))) return result;
    return Outcome::lost;
}

/// The root of short steps, followed to the whole one (solve/step_continuation.hpp).
template <class T, int D>
Outcome GalerkinStep<T, D>::fromShorterSteps(const T& t, const std::stop_token& stop) {
    const T whole = h_, scale = kineticScale_;
    isSolvedByFixedPoint_ = false;
    const bool hasArrived = StepContinuation<T>().follow(Y_, [&](const T& part, bool isFresh) {
        setStep(part * whole);
        return !stop.stop_requested() && (!isFresh || startFrom(t, StartingValue::fallback)) &&
               iterate(t, StartingValue::fallback, stop) == Outcome::converged;
    });
    setStep(whole);
    kineticScale_ = scale;  // to the last bit
    if (stop.stop_requested()) return Outcome::stopped;
    if (!hasArrived || !followsForces(t)) return Outcome::diverged;
    rememberNodes();
    return Outcome::converged;
}

template <class T, int D>
Outcome GalerkinStep<T, D>::anyRoot(const T& t, const std::stop_token& stop) {
    isSolvedByFixedPoint_ = false;
    if (hasFixedPoint() && policy_.method != SolverMethod::newton && newtonSteps_ == 0) {
        Outcome result = fixedPoint(t, stop);
        // Forces continued from the step before may be a poor start where steps are large.
        if (policy_.method == SolverMethod::fixedPoint && result != Outcome::converged &&
            result != Outcome::stopped)
            result = fixedPoint(t, stop);
        isSolvedByFixedPoint_ = result == Outcome::converged;
        hasPrevious_ = false;
        if (isSolvedByFixedPoint_ || result == Outcome::stopped || policy_.method == SolverMethod::fixedPoint)
            return result;
        newtonSteps_ = stepsWithNewton;
    } else if (newtonSteps_ > 0) {
        --newtonSteps_;
    }
    return newton(t, ladder_.begin(hasPrevious_), stop);
}

}  // namespace extremal
