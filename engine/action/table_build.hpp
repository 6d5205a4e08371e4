/// How a table is made: the definition of makeTable for any scalar. Included by table.cpp alone.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/dense.hpp"
#include "engine/core/problem.hpp"

namespace extremal::detail {

/// phi_a(tau) and phi_a'(tau) as rows, one per given tau.
template <class T>
struct Samples {
    typename Table<T>::Matrix value, derivative;
    Samples(const Space<T>& space, const std::vector<T>& taus)
        : value(taus.size(), space.size), derivative(taus.size(), space.size) {
        for (std::size_t i = 0; i < taus.size(); ++i) {
            const auto n = static_cast<std::size_t>(space.size);
            const auto row = static_cast<Eigen::Index>(i);
            space.evaluate(taus[i], {value.row(row).data(), n}, {derivative.row(row).data(), n});
        }
    }
};

/// Points denser than the space has functions, cosine-spaced, with weights: int f ~ sum_i weight_i
/// f(point_i).
template <class T>
struct Probe {
    std::vector<T> point;
    typename Table<T>::Vector weight;
    explicit Probe(int size) : weight(4 * size) {
        using std::acos;
        using std::cos;
        using std::sin;
        const int n = 4 * size;
        const T pi = acos(T(-1));
        for (int i = 0; i < n; ++i) {
            const T angle = pi * (2 * i + 1) / (2 * n);
            point.push_back((1 - cos(angle)) / 2);
            weight(i) = pi * sin(angle) / (2 * n);
        }
    }
};

/// Coefficients of the function 1, by least squares.
template <class T>
typename Table<T>::Vector coefficientsOfOne(const Samples<T>& samples) {
    using Vector = typename Table<T>::Vector;
    const Vector ones = Vector::Ones(samples.value.rows());
    Vector z = dense::leastSquares<T>(samples.value, ones);
    const Vector defect = samples.value * z - ones;
    if (static_cast<double>(defect.norm()) > 1e-8)
        throw InvalidScene("/space", "does not contain the constants, so the curve cannot start at rest",
                           "add the constant function");
    return z;
}

/// The change to functions Y_a whose traces are trivial (see table.hpp). The interior ones are orthonormal in
/// int phi_a' phi_b', and orthogonal to the last: the step is as well conditioned as its space, whatever the
/// basis.
template <class T>
typename Table<T>::Matrix changeOfBasis(const Space<T>& space, const Samples<T>& samples,
                                        const Probe<T>& probe) {
    using Matrix = typename Table<T>::Matrix;
    const int n = space.size, m = n - 1;
    // The first two vectors of an orthonormal basis of the coefficients span the traces; the others vanish at
    // both ends.
    const Samples<T> ends(space, {T(0), T(1)});
    const Matrix traces = ends.value.transpose();  // n x 2
    const Eigen::Matrix<T, 2, 2> gram = traces.transpose() * traces;
    const T determinant = gram(0, 0) * gram(1, 1) - gram(0, 1) * gram(1, 0);
    if (!(static_cast<double>(determinant) >= 1e-12))
        throw InvalidScene("/space", "the end points do not determine two independent functions",
                           "raise the degree");
    // Minimal-norm coefficients of a function with traces (0, 1).
    Matrix change(n, m);
    change.col(m - 1) = (traces.col(1) * gram(0, 0) - traces.col(0) * gram(0, 1)) / determinant;
    if (m == 1) return change;
    change.leftCols(m - 1) = dense::qr<T>(traces).Q.rightCols(m - 1);
    const Matrix slopes =
        probe.weight.cwiseSqrt().asDiagonal() * dense::product<T>(samples.derivative, change);
    const auto [Q, R] = dense::qr<T>(slopes.leftCols(m - 1));
    const auto pivots = R.diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > pivots.maxCoeff() * T(1e-12)))
        throw InvalidScene("/space", "has functions that are not independent",
                           "leave out those that follow from others");
    const dense::Lu<T> upper(R);
    const Matrix along = upper.solve(dense::product<T>(Q.leftCols(m - 1).transpose(), slopes.col(m - 1)));
    change.col(m - 1) -= dense::product<T>(change.leftCols(m - 1), along);
    change.leftCols(m - 1) =
        dense::product<T>(change.leftCols(m - 1), upper.solve(Matrix::Identity(m - 1, m - 1)));
    return change;
}

/// Smallest k for which the rule is not exact for all (P_k phi_a)', P_k Legendre's polynomials and phi_a the
/// interior functions, whose integrals vanish; at most degree + 1, as more does not matter.
template <class T>
int consistencyOf(const Table<T>& t) {
    using std::abs;
    const int most = t.space.degree + 1;
    typename Table<T>::Vector P = Table<T>::Vector::Ones(t.nodes()),
                              lower = Table<T>::Vector::Zero(t.nodes());
    auto dP = lower, dLower = lower;
    for (int k = 0; k < most; ++k) {
        for (int a = 0; a < t.unknowns() - 1; ++a) {
            T sum(0), size(0);
            for (int i = 0; i < t.nodes(); ++i) {
                sum += t.weight(i) * (dP(i) * t.value(i, a) + P(i) * t.derivative(i, a));
                size += abs(t.weight(i) * P(i) * t.derivative(i, a));
            }
            if (abs(static_cast<double>(sum)) > 1e-11 * static_cast<double>(size + T(1))) return k;
        }
        for (int i = 0; i < t.nodes(); ++i) {
            const T x = 2 * t.node(i) - 1;
            const T next = (T(2 * k + 1) * x * P(i) - T(k) * lower(i)) / T(k + 1);
            const T dNext = dLower(i) + 2 * T(2 * k + 1) * P(i);
            lower(i) = P(i);
            dLower(i) = dP(i);
            P(i) = next;
            dP(i) = dNext;
        }
    }
    return most;
}

template <class T>
void checkRank(const Table<T>& t) {
    const int m = t.unknowns();
    if (tellsFunctionsApart(t)) return;
    throw InvalidScene(
        "/quadrature",
        (t.nodes() < m ? "has too few nodes (" : "has nodes in the wrong places (") +
            std::to_string(t.nodes()) + ") for the " + std::to_string(m + 1) +
            " functions of the space: some motions inside a step would cost no action, and the step would "
            "be singular for every step size",
        "use at least " + std::to_string(m) + " nodes, spread over the step");
}

template <class T>
Table<T> buildTable(const Space<T>& space, const Rule<T>& rule) {
    using Matrix = typename Table<T>::Matrix;
    using Vector = typename Table<T>::Vector;
    const int m = space.size - 1;
    Table<T> t;
    t.space = space;
    t.rule = space.hasKinks ? rule : merged(rule);
    t.node = Eigen::Map<const Vector>(t.rule.c.data(), t.rule.size());
    t.weight = Eigen::Map<const Vector>(t.rule.b.data(), t.rule.size());
    const Probe<T> probe(space.size);
    const Samples<T> samples(space, probe.point);
    t.lift = coefficientsOfOne(samples);
    t.change = changeOfBasis(space, samples, probe);
    const Samples<T> at(space, t.rule.c);
    t.value = dense::product<T>(at.value, t.change);
    t.derivative = dense::product<T>(at.derivative, t.change);
    checkRank(t);
    t.consistency = consistencyOf(t);
    t.testValue = t.value;
    t.testDerivative = t.derivative;
    t.testValue.col(m - 1) = Vector::Ones(t.nodes()) - t.value.col(m - 1);
    t.testDerivative.col(m - 1) = -t.derivative.col(m - 1);

    // Continue the curve: match it at points of the next step, relative to the value at its start.
    std::vector<T> beyond;
    for (const T& c : probe.point) beyond.push_back(T(1) + c);
    Matrix next = dense::product<T>(Samples<T>(space, beyond).value, t.change);
    next.col(m - 1).array() -= T(1);  // the new step starts at q_1 = q_0 + Y_{m-1}
    t.extrapolation = dense::leastSquares<T>(dense::product<T>(samples.value, t.change), next);
    return t;
}

}  // namespace extremal::detail
