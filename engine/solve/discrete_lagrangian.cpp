// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/discrete_lagrangian.hpp"

#include <boost/multiprecision/float128.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/algebra/dense.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/solve/newton.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal {

template <class T>
ActionBetween<T> DiscreteLagrangian<T>::operator()(const T& t0, const T& h, const Vector& q0,
                                                   const Vector& q1, const Vector* guess) const {
    const int d = kernel_.dimension(), inner = interior() * d;
    // A straight line has no interior: the interior functions are orthogonal to it in the velocities.
    Vector x = guess ? *guess : Vector(Vector::Zero(inner)), z(kernel_.size());
    ElementDerivatives<T> element;
    ActionBetween<T> result;
    result.outcome = solveNewton<T>(
        x,
        [&](const Vector& Y, Vector& F, Matrix* J) {
            z << q0, Y, q1;
            const auto order = J ? DerivativeOrder::second : DerivativeOrder::first;
            if (!kernel_.evaluate(t0, h, z, order, element)) return false;
            F = element.gradient.segment(d, inner);
            if (J) *J = element.hessian.block(d, d, inner, inner);
            return true;
        },
        std::max(T(q0.cwiseAbs().maxCoeff()), T(q1.cwiseAbs().maxCoeff())));
    z << q0, x, q1;
    if (!kernel_.evaluate(t0, h, z, DerivativeOrder::second, element)) result.outcome = Outcome::notFinite;
    const Matrix& hessian = element.hessian;
    result.action = element.action;
    result.startMomentum = -element.gradient.head(d);
    result.endMomentum = element.gradient.tail(d);
    result.nodes.resize(d, 2);
    result.nodes << q0, q1;
    result.interior = x;
    // Second derivatives of the stationary value: the Schur complement of the interior.
    Matrix ends(2 * d, 2 * d), coupling(inner, 2 * d);
    ends << hessian.topLeftCorner(d, d), hessian.topRightCorner(d, d), hessian.bottomLeftCorner(d, d),
        hessian.bottomRightCorner(d, d);
    if (inner > 0) {
        coupling << hessian.block(d, 0, inner, d), hessian.block(d, d + inner, inner, d);
        ends -= dense::product<T>(coupling.transpose(),
                                  dense::solve<T>(hessian.block(d, d, inner, inner), coupling));
    }
    result.hessian = ends;
    return result;
}

template <class T>
ActionBetween<T> DiscreteLagrangian<T>::between(const T& t0, const T& h, const Matrix& guess,
                                                const std::stop_token& stop) const {
    const int d = kernel_.dimension(), N = static_cast<int>(guess.cols()) - 1, inner = interior() * d;
    ActionBetween<T> result;
    result.interior = Matrix::Zero(inner, N);
    result.nodes = guess;
    Matrix start = result.interior;
    bool isSolved = true;
    // Each evaluation solves the interiors of all elements, from those of the last point where that
    // succeeded.
    auto assemble = [&](const Vector& x, Vector& F, Matrix* J) {
        if (N > 1) result.nodes.middleCols(1, N - 1) = Eigen::Map<const Matrix>(x.data(), d, N - 1);
        F = Vector::Zero((N - 1) * d);
        if (J) *J = Matrix::Zero((N - 1) * d, (N - 1) * d);
        result.action = T(0);
        isSolved = true;
        for (int k = 0; k < N && isSolved; ++k) {
            if (stop.stop_requested()) return isSolved = false;
            const Vector last = start.col(k);
            const auto element = (*this)(t0 + h * k, h, result.nodes.col(k), result.nodes.col(k + 1), &last);
            isSolved = element.outcome == Outcome::converged;
            result.interior.col(k) = element.interior;
            result.action += element.action;
            if (k == 0) result.startMomentum = element.startMomentum;
            if (k == N - 1) result.endMomentum = element.endMomentum;
            if (k > 0) F.segment((k - 1) * d, d) -= element.startMomentum;
            if (k < N - 1) F.segment(k * d, d) += element.endMomentum;
            if (!J) continue;
            const Matrix& H = element.hessian;
            if (k > 0) J->block((k - 1) * d, (k - 1) * d, d, d) += H.topLeftCorner(d, d);
            if (k < N - 1) J->block(k * d, k * d, d, d) += H.bottomRightCorner(d, d);
            if (k > 0 && k < N - 1) {
                J->block((k - 1) * d, k * d, d, d) += H.topRightCorner(d, d);
                J->block(k * d, (k - 1) * d, d, d) += H.bottomLeftCorner(d, d);
            }
        }
        if (isSolved && J) start = result.interior;
        return isSolved;
    };
    Vector x = Eigen::Map<const Vector>(guess.data() + d, (N - 1) * d);
    result.outcome = solveNewton<T>(x, assemble, guess.cwiseAbs().maxCoeff());
    Vector F;
    if (result.outcome == Outcome::converged && !assemble(x, F, nullptr)) result.outcome = Outcome::diverged;
    if (stop.stop_requested()) result.outcome = Outcome::stopped;
    return result;
}

template <class T>
typename DiscreteLagrangian<T>::Matrix DiscreteLagrangian<T>::eulerLagrange(const T& t0, const T& h,
                                                                            const Matrix& nodes) const {
    const int d = kernel_.dimension(), N = static_cast<int>(nodes.cols()) - 1;
    Matrix residual = Matrix::Zero(d, N - 1);
    for (int k = 0; k < N; ++k) {
        const auto element = (*this)(t0 + h * k, h, nodes.col(k), nodes.col(k + 1));
        if (element.outcome != Outcome::converged) return {};
        if (k > 0) residual.col(k - 1) -= element.startMomentum;
        if (k < N - 1) residual.col(k) += element.endMomentum;
    }
    return residual;
}

namespace {

/// N + 1 nodes on the broken line through the columns of a coarser path.
template <class Matrix>
Matrix refined(const Matrix& path, int N) {
    using T = typename Matrix::Scalar;
    Matrix nodes(path.rows(), N + 1);
    const auto pieces = static_cast<int>(path.cols()) - 1;
    for (int k = 0; k <= N; ++k) {
        const int piece = std::min(pieces - 1, k * pieces / N);
        const T part = T(k * pieces - piece * N) / T(N);
        nodes.col(k) = (T(1) - part) * path.col(piece) + part * path.col(piece + 1);
    }
    return nodes;
}

}  // namespace

template <class T>
ActionBetween<T> exactDiscreteLagrangian(const Mechanics<T>& mechanics, const T& t0, const T& h,
                                         const typename ActionBetween<T>::Matrix& guess, double tolerance,
                                         const std::stop_token& stop) {
    constexpr int degree = 12, mostElements = 256, mostWithoutSolution = 32;
    static const Table<T> table =
        makeTable(polynomialSpace<T>(degree, PolynomialBasis::lobatto), gauss<T>(degree));
    const DiscreteLagrangian<T> Ld(mechanics, table);
    ActionBetween<T> result;
    auto path = guess;
    double last = std::numeric_limits<double>::infinity();
    bool hasCoarse = false;
    T coarse{};
    for (int N = 2; N <= mostElements; N *= 2) {
        ActionBetween<T> fine = Ld.between(t0, h / T(N), refined(path, N), stop);
        if (fine.outcome == Outcome::stopped) return fine;
        if (fine.outcome != Outcome::converged) {
            // A coarse path may not be solvable where a finer one is; from a solved one on, this is the end.
            if (hasCoarse || N >= mostWithoutSolution) break;
            result = std::move(fine);
            continue;
        }
        using std::abs;
        const double difference = hasCoarse ? static_cast<double>(abs(fine.action - coarse))
                                            : std::numeric_limits<double>::infinity();
        // The size of the terms of which the action is the sum, against cancellation.
        double size = 0;
        for (int k = 0; k < N; ++k)
            size += static_cast<double>(
                abs(Ld(t0 + h * k / T(N), h / T(N), fine.nodes.col(k), fine.nodes.col(k + 1)).action));
        const bool isStagnant = difference >= last && difference < 1e-10 * size;
        coarse = fine.action;
        path = fine.nodes;
        hasCoarse = true;
        result = std::move(fine);
        result.estimatedError = difference;
        if (difference <= tolerance * size || isStagnant) return result;
        last = difference;
    }
    if (hasCoarse) result.outcome = Outcome::diverged;
    return result;
}

template class DiscreteLagrangian<double>;
template class DiscreteLagrangian<boost::multiprecision::float128>;
template ActionBetween<double> exactDiscreteLagrangian(const Mechanics<double>&, const double&, const double&,
                                                       const ActionBetween<double>::Matrix&, double,
                                                       const std::stop_token&);
template ActionBetween<boost::multiprecision::float128> exactDiscreteLagrangian(
    const Mechanics<boost::multiprecision::float128>&, const boost::multiprecision::float128&,
    const boost::multiprecision::float128&, const ActionBetween<boost::multiprecision::float128>::Matrix&,
    double, const std::stop_token&);

}  // namespace extremal
