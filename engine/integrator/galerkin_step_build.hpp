/// The definition of GalerkinStep for any scalar and dimension. Included where it is instantiated:
/// galerkin.cpp for double, the tests for quadruple precision.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "engine/integrator/galerkin_step.hpp"
#include "engine/integrator/galerkin_step_sums.hpp"
#include "engine/integrator/node_iteration_build.hpp"

namespace extremal {

template <class T, int D>
GalerkinStep<T, D>::GalerkinStep(Mechanics<T> mechanics, std::vector<Table<T>> tables, T step,
                                 SolverPolicy policy)
    : mechanics_(std::move(mechanics)), tables_(std::move(tables)), h_(step), policy_(policy) {
    const T epsilon = std::numeric_limits<T>::epsilon();
    tolerance_ = policy.tolerance > 0 ? std::max(T(policy.tolerance), epsilon) : epsilon;
    int size = 0, widest = 0;
    for (int k = 0; k < d(); ++k) {
        offset_.push_back(size);
        size += m(k);
        widest = std::max(widest, m(k));
    }
    isRich_ = std::is_same_v<T, double> && n() >= 16 && tables_.front().frequency != T(0);
    rows_ = isRich_ ? (n() + 7) / 8 * 8 : n();
    if (isRich_) sums_ = nodeSums();
    const auto padded = [&](const auto& column) {
        Flat all = Flat::Constant(rows(), column(n() - 1));
        all.head(n()) = column;
        return all;
    };
    for (const Table<T>& t : tables_) {
        const int own = t.unknowns(), height = isRich_ ? (own + 7) / 8 * 8 : own;
        Functions f;
        f.value = f.slope = Square::Zero(rows(), own);
        for (int a = 0; a < own; ++a) {
            f.value.col(a) = padded(t.value.col(a));
            f.slope.col(a) = padded(t.derivative.col(a)) / h_;
        }
        f.valueAt = f.slopeAt = Square::Zero(height, rows());
        f.valueAt.topRows(own) = f.value.transpose();
        f.slopeAt.topRows(own) = f.slope.transpose();
        f.kineticInverse = Square(t.testDerivative.transpose() * t.weight.asDiagonal() * t.derivative / h_)
                               .partialPivLu()
                               .inverse();
        functions_.push_back(std::move(f));
    }
    node_ = times_ = padded(tables_.front().node);
    weight_ = padded(tables_.front().weight) * h_;
    weight_.tail(rows() - n()).setZero();
    impulse_ = thrust_ = Flat::Zero(rows());
    for (Flat* f : {&Y_, &previousY_, &R_, &delta_}) *f = Flat::Zero(size);
    for (Columns* c : {&nodeQ_, &nodeV_}) *c = Columns::Zero(rows(), d());
    gradient_ = Square::Zero(rows(), 2 * d());
    for (Vector* v :
         {&q0_, &p0_, &v0_, &a0_, &dq_, &dp_, &carryQ_, &carryP_, &lastQ_, &lastP_, &placeQ_, &placeV_})
        *v = Vector::Zero(d());
    jetGradient_ = Flat::Zero(2 * d());
    jetHessian_ = Flat::Zero(4 * d() * d());
    curvature_ = Square::Zero(rows(), 4 * d() * d());
    isCurved_.assign(static_cast<std::size_t>(4 * d() * d()), false);
    bent_ = Square::Zero(rows(), widest);
    jacobian_ = Square::Zero(size, size);
    lu_ = Eigen::PartialPivLU<Square>(size);
    if (mechanics_.isSeparable && tables_.size() == 1 && tables_.front().frequency == T(0))
        together_.emplace(mechanics_, tables_.front(), h_, tolerance_);
}

/// v(q_0, p_0) and the acceleration there: L_vv a = L_q - L_vq v (explicit time dependence of L_v is left
/// out: it only matters for the quality of a guess).
template <class T, int D>
bool GalerkinStep<T, D>::startVelocity(const T& t) {
    if (!mechanics_.velocity(mechanics_.model.get(), t, q0_.data(), p0_.data(), v0_.data())) return false;
    T value;
    const int dim = d();
    mechanics_.jet(mechanics_.model.get(), t, q0_.data(), v0_.data(), &value, jetGradient_.data(),
                   jetHessian_.data());
    ++report_.evaluations;
    const Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> H(
        jetHessian_.data(), 2 * dim, 2 * dim);
    Square mass = H.bottomRightCorner(dim, dim);
    const Flat rhs = jetGradient_.head(dim) - H.bottomLeftCorner(dim, dim) * v0_;
    a0_ = mass.partialPivLu().solve(rhs);
    return a0_.allFinite();
}

/// Starting guess for Y: the previous curve continued, or its smoothest part; else q_0 + v_0 t + a_0 t^2 / 2
/// fitted in the space; where a step has many periods that says nothing, and it starts from rest.
template <class T, int D>
bool GalerkinStep<T, D>::guess(const T& t, Start start) {
    if (start != Start::fresh) {
        for (int k = 0; k < d(); ++k) {
            const auto& onward = start == Start::continued ? table(k).continuation : table(k).cautious;
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
        for (int a = 0; a < m(k); ++a) R(a) = -h_ * own.weight.dot(own.testValue.col(a)) * a0_(k);
        R(m(k) - 1) -= v0_(k);
        Y_.segment(offset(k), m(k)).noalias() = functions(k).kineticInverse.lazyProduct(R);
    }
    return true;
}

/// Solves J delta = R, Newton's correction being -delta; returns its size relative to the unknowns.
template <class T, int D>
T GalerkinStep<T, D>::correction() {
    using std::abs;
    delta_ = lu_.solve(R_);
    ++report_.linearSolves;
    // Each coordinate is measured against its own increments and the round-off of its own value.
    T worst(0);
    for (int k = 0; k < d(); ++k) {
        const T scale = Y_.segment(offset(k), m(k)).cwiseAbs().maxCoeff();
        const T roundOff = std::numeric_limits<T>::epsilon() * abs(q0_(k));
        const T size = delta_.segment(offset(k), m(k)).cwiseAbs().maxCoeff();
        if (!(size <= std::numeric_limits<T>::max())) return std::numeric_limits<T>::infinity();
        const T known = std::max(scale, roundOff);  // 0: at rest in 0 so far
        if (size > roundOff * T(0.01)) worst = std::max(worst, known > T(0) ? T(size / known) : T(1));
    }
    return worst;
}

template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::iterate(const T& t, Start start,
                                                                 const std::stop_token& stop) {
    const T stagnation = T(1e4) * std::numeric_limits<T>::epsilon();
    const int limit = policy_.maxIterations;
    T last = std::numeric_limits<T>::infinity();
    int growing = 0, stalls = 0, sinceJacobian = 0;
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
        if (iteration == 0 && start != Start::fresh && size > T(1))
            return Attempt::failed;  // rich curves swing far beyond their step
        // At round-off, or no longer shrinking within a few digits of it: the forces at hand are those of the
        // solution.
        if (size <= tolerance_ || (size < stagnation && size >= last * T(0.25))) return Attempt::solved;
        // An ill-conditioned step stays further from round-off, whatever the Jacobian.
        if (size < 100 * stagnation && size >= last * T(0.25) && ++stalls >= 3) return Attempt::solved;
        Y_ -= delta_;
        placeNodes();
        ++sinceJacobian;
        growing = size >= last ? growing + 1 : 0;
        if (growing >= 4) return Attempt::failed;
        if (size > T(0.1) || (size > last * T(0.1) && sinceJacobian >= 2 && size > stagnation)) {
            if (!assembleJacobian(t)) return Attempt::singular;
            sinceJacobian = 0;
        }
        last = size;
    }
    return Attempt::failed;
}

template <class T, int D>
typename GalerkinStep<T, D>::Start GalerkinStep<T, D>::next(Start start) const {
    return start == Start::continued && tables_.front().cautious.size() > 0 ? Start::cautious : Start::fresh;
}

/// Guess and iterate; where the continued curve was a poor guess (large steps), once more from a more
/// cautious one.
template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::newton(const T& t, const std::stop_token& stop) {
    if (waryFor_ > 0 && --waryFor_ == 0) boldest_ = Start::continued;
    for (Start start = hasCurve_ ? boldest_ : Start::fresh;; start = next(start)) {
        if (!guess(t, start)) return Attempt::singular;
        const Attempt result = iterate(t, start, stop);
        if (result == Attempt::solved && together_) together_->remember(gradient_.leftCols(d()));
        if (result == Attempt::solved || result == Attempt::stopped || start == Start::fresh) return result;
        boldest_ = next(start);
        waryFor_ = 16;
    }
}

template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::fixedPoint(const T& t, const std::stop_token& stop) {
    using Result = typename NodeIteration<T>::Result;
    switch (together_->solve(t, q0_.data(), p0_.data(), carryQ_.data(), carryP_.data(), policy_.maxIterations,
                             stop, report_)) {
        case Result::solved: {
            together_->increments(dq_.data(), dp_.data(), carryQ_.data(), carryP_.data());
            return dq_.allFinite() && dp_.allFinite() ? Attempt::solved : Attempt::notFinite;
        }
        case Result::stopped:
            return Attempt::stopped;
        case Result::notFinite:
            return Attempt::notFinite;
        case Result::slow:
            break;
    }
    return Attempt::failed;
}

template <class T, int D>
typename GalerkinStep<T, D>::Attempt GalerkinStep<T, D>::solve(const T& t, const std::stop_token& stop) {
    isTogether_ = false;
    if (together_ && policy_.method != SolverMethod::newton && newtonSteps_ == 0) {
        Attempt result = fixedPoint(t, stop);
        // Forces continued from the step before may be a poor start where steps are large.
        if (policy_.method == SolverMethod::fixedPoint && result != Attempt::solved &&
            result != Attempt::stopped)
            result = fixedPoint(t, stop);
        isTogether_ = result == Attempt::solved;
        hasCurve_ = false;
        if (isTogether_ || result == Attempt::stopped || policy_.method == SolverMethod::fixedPoint)
            return result;
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
            // Stiff forces nearly cancel in this sum.
            Wide impulse(0);
            for (int i = 0; i < n(); ++i) impulse += Wide(weight_(i)) * Wide(gradient_(i, k));
            dp_(k) = static_cast<T>(impulse);
            dq_(k) = Y_(offset(k) + m(k) - 1);
        }
        previousY_ = Y_;
    }
    const auto sum = [](const T& a, const T& b, T& lost) {
        const T s = a + b, back = s - a;
        lost = (a - (s - back)) + (b - back);
        return s;
    };
    for (int k = 0; k < d(); ++k) {
        q[k] = lastQ_(k) = sum(q0_(k), dq_(k) + carryQ_(k), carryQ_(k));
        p[k] = lastP_(k) = sum(p0_(k), dp_(k) + carryP_(k), carryP_(k));
    }
}

template <class T, int D>
StepReport GalerkinStep<T, D>::advance(const T& t, T* q, T* p, const std::stop_token& stop) {
    report_ = StepReport{};
    report_.step = static_cast<double>(h_);
    takeUp(q, p);
    const Attempt result = solve(t, stop);
    switch (result) {
        case Attempt::solved:
            break;
        case Attempt::failed:
            report_.outcome = Outcome::diverged;
            break;
        case Attempt::notFinite:
            report_.outcome = Outcome::notFinite;
            break;
        case Attempt::singular:
            report_.outcome = Outcome::singular;
            break;
        case Attempt::stopped:
            report_.outcome = Outcome::stopped;
            break;
    }
    hasCurve_ = result == Attempt::solved && !isTogether_;
    if (result == Attempt::solved) add(q, p);
    return report_;
}

template <class T, int D>
void GalerkinStep<T, D>::curve(const T& tau, T* q, T* p) const {
    Square Y, forces = gradient_.leftCols(d());
    if (isTogether_) {
        Y.resize(m(0), d());
        together_->coefficients(Y, forces);
    }
    std::vector<T> value, slope;
    for (int k = 0; k < d(); ++k) {
        const Table<T>& own = table(k);
        value.resize(static_cast<std::size_t>(own.space.size));
        slope.resize(value.size());
        own.space.evaluate(tau, value, slope);
        const Eigen::Map<const Flat> phi(value.data(), own.space.size);
        const Flat y = own.change.transpose() * phi;
        q[k] = q0_(k) + (isTogether_ ? Flat(Y.col(k)) : Flat(Y_.segment(offset(k), m(k)))).dot(y);
        p[k] = p0_(k);
    }
    // p(tau) = p_0 + h int_0^tau of what the rule takes L_q for, from its values at the nodes: at tau = 1 the
    // rule itself.
    const std::vector<T> share = weightsUpTo(tables_.front(), tau);
    for (int k = 0; k < d(); ++k)
        for (int i = 0; i < n(); ++i) p[k] += h_ * share[static_cast<std::size_t>(i)] * forces(i, k);
}

}  // namespace extremal
