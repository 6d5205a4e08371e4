/// The definition of GalerkinStep for any scalar and dimension. Included where it is instantiated: galerkin.cpp for
/// double, the tests for quadruple precision.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "engine/integrator/galerkin_step.hpp"
#include "engine/integrator/node_iteration_build.hpp"

namespace extremal {

template <class T, int D>
GalerkinStep<T, D>::GalerkinStep(Mechanics<T> mechanics, Table<T> table, T step, SolverPolicy policy)
    : mechanics_(std::move(mechanics)), table_(std::move(table)), h_(step), policy_(policy) {
    const T epsilon = std::numeric_limits<T>::epsilon();
    tolerance_ = policy.tolerance > 0 ? std::max(T(policy.tolerance), epsilon) : epsilon;
    for (Columns* c : {&Y_, &previousY_, &R_, &delta_, &trial_}) *c = Columns::Zero(d(), m());
    for (Columns* c : {&nodeQ_, &nodeV_, &Lq_, &Lv_}) *c = Columns::Zero(d(), n());
    for (Vector* v : {&q0_, &p0_, &v0_, &a0_, &dq_, &dp_, &carryQ_, &carryP_, &lastQ_, &lastP_}) *v = Vector::Zero(d());
    jetGradient_ = Flat::Zero(2 * d());
    jetHessian_ = Flat::Zero(4 * d() * d());
    const int size = m() * d();
    jacobian_ = Square::Zero(size, size);
    block_ = Square::Zero(size, size);
    flatR_ = flatDelta_ = Flat::Zero(size);
    lu_ = Eigen::PartialPivLU<Square>(size);
    // Kinetic part of the Jacobian for unit mass: K_ab = sum_i b_i psi_a'(c_i) phi_b'(c_i) / h.
    const Square kinetic =
        table_.testDerivative.transpose() * table_.weight.asDiagonal() * table_.derivative / h_;
    kineticInverse_ = kinetic.partialPivLu().inverse();
    if (mechanics_.isSeparable) together_.emplace(mechanics_, table_, h_, tolerance_);
}

/// q(c_i) and v(c_i) from Y.
template <class T, int D>
void GalerkinStep<T, D>::placeNodes() {
    nodeQ_.noalias() = Y_.lazyProduct(table_.value.transpose());
    nodeQ_.colwise() += q0_;
    nodeV_.noalias() = Y_.lazyProduct(table_.derivative.transpose());
    nodeV_ /= h_;
}

/// L_q and L_v at all nodes.
template <class T, int D>
void GalerkinStep<T, D>::evaluateForces(const T& t) {
    for (int i = 0; i < n(); ++i) {
        mechanics_.gradient(mechanics_.model.get(), t + table_.node(i) * h_, nodeQ_.col(i).data(), nodeV_.col(i).data(),
                            jetGradient_.data());
        for (int k = 0; k < d(); ++k) {
            Lq_(k, i) = jetGradient_(k);
            Lv_(k, i) = jetGradient_(d() + k);
        }
    }
    report_.evaluations += n();
}

/// R from L_q, L_v; column a is the equation of test function a.
template <class T, int D>
void GalerkinStep<T, D>::residual() {
    for (int a = 0; a < m(); ++a) {
        for (int k = 0; k < d(); ++k) R_(k, a) = a == m() - 1 ? p0_(k) : T(0);
        for (int i = 0; i < n(); ++i) {
            const T bv = table_.weight(i) * h_ * table_.testValue(i, a);
            const T bd = table_.weight(i) * table_.testDerivative(i, a);
            for (int k = 0; k < d(); ++k) R_(k, a) += bv * Lq_(k, i) + bd * Lv_(k, i);
        }
    }
}

/// dR/dY at the present Y, from the Hessians of L at the nodes, and its factorisation.
template <class T, int D>
bool GalerkinStep<T, D>::assembleJacobian(const T& t) {
    const int dim = d();
    jacobian_.setZero();
    T value;
    for (int i = 0; i < n(); ++i) {
        mechanics_.jet(mechanics_.model.get(), t + table_.node(i) * h_, nodeQ_.col(i).data(), nodeV_.col(i).data(),
                       &value, jetGradient_.data(), jetHessian_.data());
        const T* H = jetHessian_.data();
        const T b = table_.weight(i);
        for (int k = 0; k < dim; ++k)
            for (int l = 0; l < dim; ++l) {
                const T qq = b * h_ * H[k * 2 * dim + l], qv = b * H[k * 2 * dim + dim + l];
                const T vq = b * H[(dim + k) * 2 * dim + l], vv = b / h_ * H[(dim + k) * 2 * dim + dim + l];
                for (int a = 0; a < m(); ++a) {
                    const T forValue = table_.testValue(i, a) * qq + table_.testDerivative(i, a) * vq;
                    const T forSlope = table_.testValue(i, a) * qv + table_.testDerivative(i, a) * vv;
                    for (int c = 0; c < m(); ++c)
                        jacobian_(a * dim + k, c * dim + l) +=
                            forValue * table_.value(i, c) + forSlope * table_.derivative(i, c);
                }
            }
    }
    report_.evaluations += n();
    lu_.compute(jacobian_);
    ++report_.linearSolves;
    using std::abs;
    T smallest = abs(lu_.matrixLU()(0, 0)), largest = smallest;
    for (int k = 1; k < lu_.matrixLU().rows(); ++k) {
        const T pivot = abs(lu_.matrixLU()(k, k));
        if (!(pivot >= smallest)) smallest = pivot;
        if (pivot > largest) largest = pivot;
    }
    return smallest > std::numeric_limits<T>::epsilon() * T(1e-3) * largest;
}

/// v(q_0, p_0) and the acceleration there: L_vv a = L_q - L_vq v (explicit time dependence of L_v is left out: it only
/// matters for the quality of a guess).
template <class T, int D>
bool GalerkinStep<T, D>::startVelocity(const T& t) {
    if (!mechanics_.velocity(mechanics_.model.get(), t, q0_.data(), p0_.data(), v0_.data())) return false;
    T value;
    const int dim = d();
    mechanics_.jet(mechanics_.model.get(), t, q0_.data(), v0_.data(), &value, jetGradient_.data(), jetHessian_.data());
    ++report_.evaluations;
    const Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> H(jetHessian_.data(),
                                                                                               2 * dim, 2 * dim);
    Square mass = H.bottomRightCorner(dim, dim);
    const Flat rhs = jetGradient_.head(dim) - H.bottomLeftCorner(dim, dim) * v0_;
    a0_ = mass.partialPivLu().solve(rhs);
    return a0_.allFinite();
}

/// Starting guess for Y: the previous curve continued, else q_0 + v_0 t + a_0 t^2 / 2 fitted in the space.
template <class T, int D>
bool GalerkinStep<T, D>::guess(const T& t) {
    if (hasCurve_) {
        Y_.noalias() = previousY_.lazyProduct(table_.continuation.transpose());
        return true;
    }
    if (!startVelocity(t)) return false;
    // Galerkin projection of the second derivative: K Y = sum_i b_i psi(c_i) (-a_0) h ... for unit mass, with p_0 -> v_0.
    for (int a = 0; a < m(); ++a) {
        T moment(0);
        for (int i = 0; i < n(); ++i) moment += table_.weight(i) * h_ * table_.testValue(i, a);
        R_.col(a) = moment * a0_;
        if (a == m() - 1) R_.col(a) += v0_;
    }
    Y_.noalias() = -R_.lazyProduct(kineticInverse_.transpose());
    return true;
}

/// Solves for the correction of Y from R; returns its size relative to the unknowns.
template <class T, int D>
T GalerkinStep<T, D>::correction() {
    using std::abs;
    for (int a = 0; a < m(); ++a)
        for (int k = 0; k < d(); ++k) flatR_(a * d() + k) = -R_(k, a);
    flatDelta_ = lu_.solve(flatR_);
    for (int a = 0; a < m(); ++a)
        for (int k = 0; k < d(); ++k) delta_(k, a) = flatDelta_(a * d() + k);
    ++report_.linearSolves;
    // Each coordinate is measured against its own increments and the round-off of its own value.
    T worst(0);
    for (int k = 0; k < d(); ++k) {
        const T scale = Y_.row(k).cwiseAbs().maxCoeff();
        const T roundOff = std::numeric_limits<T>::epsilon() * abs(q0_(k));
        const T size = delta_.row(k).cwiseAbs().maxCoeff();
        if (!(size <= std::numeric_limits<T>::max())) return std::numeric_limits<T>::infinity();
        const T known = std::max(scale, roundOff);  // 0: at rest in 0 so far
        if (size > roundOff * T(0.01)) worst = std::max(worst, known > T(0) ? T(size / known) : T(1));
    }
    return worst;
}

template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::iterate(const T& t, const std::stop_token& stop) {
    const T stagnation = T(1e4) * std::numeric_limits<T>::epsilon();
    const int limit = policy_.maxIterations;
    T last = std::numeric_limits<T>::infinity();
    int growing = 0, sinceJacobian = 0;
    placeNodes();
    if (!assembleJacobian(t)) return Attempt::singular;
    for (int iteration = 0; iteration < limit; ++iteration) {
        if (stop.stop_requested()) return Attempt::stopped;
        evaluateForces(t);
        residual();
        const T size = correction();
        ++report_.iterations;
        report_.residual = static_cast<double>(size);
        if (!(size < std::numeric_limits<T>::infinity())) return Attempt::notFinite;
        // At round-off, or no longer shrinking within a few digits of it: the forces at hand are those of the solution.
        if (size <= tolerance_ || (size < stagnation && size >= last * T(0.25))) return Attempt::solved;
        Y_ += delta_;
        placeNodes();
        ++sinceJacobian;
        growing = size >= last ? growing + 1 : 0;
        if (growing >= 4) return Attempt::failed;
        if (size > last * T(0.1) && sinceJacobian >= 2 && size > stagnation) {
            if (!assembleJacobian(t)) return Attempt::singular;
            sinceJacobian = 0;
        }
        last = size;
    }
    return Attempt::failed;
}

/// Guess and iterate; where the continued curve was a poor guess (large steps), once more from the Taylor guess.
template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::newton(const T& t, const std::stop_token& stop) {
    for (;;) {
        if (!guess(t)) return Attempt::singular;
        const Attempt result = iterate(t, stop);
        if (result == Attempt::solved || result == Attempt::stopped || !hasCurve_) {
            if (result == Attempt::solved && together_) together_->remember(Lq_);
            return result;
        }
        hasCurve_ = false;
    }
}

template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::fixedPoint(const T& t, const std::stop_token& stop) {
    using Result = typename NodeIteration<T>::Result;
    switch (together_->solve(t, q0_.data(), p0_.data(), carryQ_.data(), carryP_.data(), policy_.maxIterations, stop,
                             report_)) {
        case Result::solved: {
            together_->increments(dq_.data(), dp_.data(), carryQ_.data(), carryP_.data());
            return dq_.allFinite() && dp_.allFinite() ? Attempt::solved : Attempt::notFinite;
        }
        case Result::stopped: return Attempt::stopped;
        case Result::notFinite: return Attempt::notFinite;
        case Result::slow: break;
    }
    return Attempt::failed;
}

template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::solve(const T& t, const std::stop_token& stop) {
    isTogether_ = false;
    if (together_ && policy_.method != SolverMethod::newton && newtonSteps_ == 0) {
        Attempt result = fixedPoint(t, stop);
        // Forces continued from the step before may be a poor start where steps are large.
        if (policy_.method == SolverMethod::fixedPoint && result != Attempt::solved && result != Attempt::stopped)
            result = fixedPoint(t, stop);
        isTogether_ = result == Attempt::solved;
        hasCurve_ = false;
        if (isTogether_ || result == Attempt::stopped || policy_.method == SolverMethod::fixedPoint) return result;
        newtonSteps_ = 32;  // the fixed point is slow here: stay with Newton for a while
    } else if (newtonSteps_ > 0) {
        --newtonSteps_;
    }
    return newton(t, stop);
}

/// Starts from (q, p), and from what the last step could not add if this is where it ended.
template <class T, int D>
void GalerkinStep<T, D>::takeUp(const T* q, const T* p) {
    bool isNext = true;
    for (int k = 0; k < d(); ++k) {
        isNext = isNext && q[k] == lastQ_(k) && p[k] == lastP_(k);
        q0_(k) = q[k];
        p0_(k) = p[k];
    }
    if (isNext) return;
    carryQ_.setZero();
    carryP_.setZero();
}

/// Adds the increments to (q, p); the carries keep what is lost (Knuth's exact sum).
template <class T, int D>
void GalerkinStep<T, D>::add(T* q, T* p) {
    if (!isTogether_) {
        for (int k = 0; k < d(); ++k) {
            T impulse(0);
            for (int i = 0; i < n(); ++i) impulse += table_.weight(i) * Lq_(k, i);
            dp_(k) = h_ * impulse;
            dq_(k) = Y_(k, m() - 1);
        }
        previousY_ = Y_;
    }
    const auto sum = [](const T& a, const T& b, T& lost) {
        const T s = a + b, back = s - a;
        lost = (a - (s - back)) + (b - back);
        return s;
    };
    const auto step = [&](const T& from, const T& increment, T& carry) {
        T lost;
        const T to = sum(from, increment, lost);
        return sum(to, lost + carry, carry);
    };
    for (int k = 0; k < d(); ++k) {
        q[k] = lastQ_(k) = step(q0_(k), dq_(k), carryQ_(k));
        p[k] = lastP_(k) = step(p0_(k), dp_(k), carryP_(k));
    }
}

template <class T, int D>
StepReport GalerkinStep<T, D>::advance(const T& t, T* q, T* p, const std::stop_token& stop) {
    report_ = StepReport{};
    report_.step = static_cast<double>(h_);
    takeUp(q, p);
    const Attempt result = solve(t, stop);
    switch (result) {
        case Attempt::solved: break;
        case Attempt::failed: report_.outcome = Outcome::diverged; break;
        case Attempt::notFinite: report_.outcome = Outcome::notFinite; break;
        case Attempt::singular: report_.outcome = Outcome::singular; break;
        case Attempt::stopped: report_.outcome = Outcome::stopped; break;
    }
    hasCurve_ = result == Attempt::solved && !isTogether_;
    if (result == Attempt::solved) add(q, p);
    return report_;
}

template <class T, int D>
void GalerkinStep<T, D>::curve(const T& tau, T* q, T* p) const {
    const auto size = static_cast<std::size_t>(table_.space.size);
    std::vector<T> value(size), slope(size);
    table_.space.evaluate(tau, value, slope);
    const Eigen::Map<const Flat> phi(value.data(), table_.space.size);
    const Flat y = table_.change.transpose() * phi;
    Square Y = Y_, forces = Lq_;
    if (isTogether_) together_->coefficients(Y, forces);
    for (int k = 0; k < d(); ++k) {
        q[k] = q0_(k) + Y.row(k).dot(y.transpose());
        p[k] = p0_(k);
    }
    // p(tau) = p_0 + h int_0^tau of the polynomials through the L_q(i) of each panel: at tau = 1 the rule itself.
    const std::vector<T> share = weightsUpTo(table_, tau);
    for (int k = 0; k < d(); ++k)
        for (int i = 0; i < n(); ++i) p[k] += h_ * share[static_cast<std::size_t>(i)] * forces(k, i);
}

}  // namespace extremal
