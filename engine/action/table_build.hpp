/// How a table is made: the definition of makeTable for any scalar. Included where it is instantiated: table.cpp for
/// double, the tests for quadruple precision.
#pragma once

#include <Eigen/LU>
#include <Eigen/QR>

#include <string>

#include "engine/action/table.hpp"
#include "engine/core/problem.hpp"

namespace extremal {
namespace detail {

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

/// Smallest over largest pivot of a rank-revealing factorisation: 0 where columns are dependent.
template <class T>
double condition(const typename Table<T>::Matrix& m) {
    const Eigen::MatrixXd d = m.template cast<double>();
    const Eigen::VectorXd r = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(d).matrixQR().diagonal().cwiseAbs();
    return r(r.size() - 1) / r(0);
}

/// Coefficients of the function 1, by least squares on more points than the space has functions.
template <class T>
typename Table<T>::Vector coefficientsOfOne(const Space<T>& space) {
    const std::vector<T> points = clenshawCurtis<T>(2 * space.size + 1).c;
    const Samples<T> samples(space, points);
    using Vector = typename Table<T>::Vector;
    const Vector ones = Vector::Ones(samples.value.rows());
    Vector z = Eigen::HouseholderQR<typename Table<T>::Matrix>(samples.value).solve(ones);
    const Vector defect = samples.value * z - ones;
    if (static_cast<double>(defect.norm()) > 1e-8)
        throw InvalidScene("/space", "does not contain the constants, so the curve cannot start at rest",
                           "add the constant function");
    return z;
}

}  // namespace detail

template <class T>
Table<T> makeTable(const Space<T>& space, const Rule<T>& rule) {
    using Matrix = typename Table<T>::Matrix;
    using Vector = typename Table<T>::Vector;
    const int n = space.size, m = n - 1;
    Table<T> t;
    t.space = space;
    t.rule = rule;
    t.node = Eigen::Map<const Vector>(rule.c.data(), rule.size());
    t.weight = Eigen::Map<const Vector>(rule.b.data(), rule.size());
    t.lift = detail::coefficientsOfOne(space);

    // Traces, and an orthonormal basis of the coefficient space: the first two vectors span them, the others vanish
    // at both ends. Nodal bases with control points at the ends come out as themselves.
    const detail::Samples<T> ends(space, {T(0), T(1)});
    const Matrix traces = ends.value.transpose();  // n x 2
    const Eigen::HouseholderQR<Matrix> qr(traces);
    const Matrix q = qr.householderQ() * Matrix::Identity(n, n);
    // Minimal-norm coefficients of the function with traces (0, 1).
    const Eigen::Matrix<T, 2, 2> gram = traces.transpose() * traces;
    using std::abs;
    if (static_cast<double>(abs(gram.determinant())) < 1e-12)
        throw InvalidScene("/space", "the end points do not determine two independent functions", "raise the degree");
    const Eigen::Matrix<T, 2, 1> toEnd = gram.inverse() * Eigen::Matrix<T, 2, 1>(T(0), T(1));
    t.change = Matrix(n, m);
    t.change.leftCols(m - 1) = q.rightCols(m - 1);
    t.change.col(m - 1) = traces * toEnd;

    const detail::Samples<T> at(space, rule.c);
    t.value = at.value * t.change;
    t.derivative = at.derivative * t.change;
    if (rule.size() < m || detail::condition<T>(t.derivative) < 1e-9)
        throw InvalidScene("/quadrature",
                           "has too few nodes for a space of degree " + std::to_string(space.degree) +
                               ": the step would be singular for every step size",
                           "use at least " + std::to_string(m) + " nodes");
    t.testValue = t.value;
    t.testDerivative = t.derivative;
    t.testValue.col(m - 1) = Vector::Ones(rule.size()) - t.value.col(m - 1);
    t.testDerivative.col(m - 1) = -t.derivative.col(m - 1);

    // Continue the curve: match it at m points of the next step, relative to the value at its start.
    std::vector<T> here, beyond;
    for (const T& c : lobatto<T>(m + 1).c) {
        if (here.empty() && beyond.empty() && c == T(0)) continue;
        here.push_back(c);
        beyond.push_back(T(1) + c);
    }
    const Matrix local = detail::Samples<T>(space, here).value * t.change;
    Matrix next = detail::Samples<T>(space, beyond).value * t.change;
    next.col(m - 1).array() -= T(1);  // the new step starts at q_1 = q_0 + Y_{m-1}
    t.continuation = Eigen::HouseholderQR<Matrix>(local).solve(next);
    return t;
}

template <class T>
std::vector<T> weightsUpTo(const Table<T>& table, const T& tau) {
    const int n = table.nodes();
    std::vector<T> weights(static_cast<std::size_t>(n));
    const Rule<T> inner = gauss<T>(n / 2 + 1);
    for (int i = 0; i < n; ++i) {
        T& w = weights[static_cast<std::size_t>(i)];
        if (!table.rule.isInterpolatory) {
            w = table.node(i) <= tau ? table.weight(i) : T(0);
            continue;
        }
        w = T(0);
        for (int j = 0; j < inner.size(); ++j) {
            T cardinal(1);
            for (int k = 0; k < n; ++k)
                if (k != i)
                    cardinal *= (inner.c[static_cast<std::size_t>(j)] * tau - table.node(k)) /
                                (table.node(i) - table.node(k));
            w += tau * inner.b[static_cast<std::size_t>(j)] * cardinal;
        }
    }
    return weights;
}

}  // namespace extremal
