// SPDX-License-Identifier: GPL-3.0-or-later
/// How a table is made: the definition of makeTable for any scalar. Included by table.cpp alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/work.hpp"

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

/// Points denser than the space has functions, with weights: int f ~ sum_i weight_i f(point_i). Gauss's in
/// each of several cells, exact for products of slopes of splines; else cosine-spaced.
template <class T>
struct Probe {
    std::vector<T> point;
    typename Table<T>::Vector weight;
    explicit Probe(const Space<T>& space) {
        using std::acos;
        using std::cos;
        using std::sin;
        const bool areEqual = space.cells.empty();
        const int cells = areEqual ? space.equalCells : static_cast<int>(space.cells.size()) - 1;
        if (cells > 1) {
            const int perCell = std::max(space.degree + 1, (4 * space.size + cells - 1) / cells);
            const Rule<T> inner =
                areEqual ? composite(gauss<T>(perCell), cells) : composite(gauss<T>(perCell), space.cells);
            point = inner.c;
            weight = Eigen::Map<const typename Table<T>::Vector>(inner.b.data(), inner.size());
            return;
        }
        const int n = 4 * space.size;
        weight.resize(n);
        const T pi = acos(T(-1));
        for (int i = 0; i < n; ++i) {
            const T angle = pi * (2 * i + 1) / (2 * n);
            point.push_back((1 - cos(angle)) / 2);
            weight(i) = pi * sin(angle) / (2 * n);
        }
    }
};

/// Whether the functions are those of cells, most of which vanish at most points: normal equations then cost
/// a thousandth of an orthogonal factorisation, and B-splines are independent enough for them.
template <class T>
bool hasCells(const Space<T>& space) {
    return space.equalCells > 1 || space.cells.size() > 2;
}

/// sum_i weight_i A(i, a) B(i, b) over the points, without the zeros.
template <class T>
typename Table<T>::Matrix integrals(const typename Table<T>::Vector& weight,
                                    const typename Table<T>::Matrix& A, const typename Table<T>::Matrix& B) {
    typename Table<T>::Matrix sum = Table<T>::Matrix::Zero(A.cols(), B.cols());
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        for (Eigen::Index a = 0; a < A.cols(); ++a) {
            if (A(i, a) == T(0)) continue;
            const T factor = weight(i) * A(i, a);
            int products = 1;
            for (Eigen::Index b = 0; b < B.cols(); ++b) {
                if (B(i, b) == T(0)) continue;
                sum(a, b) += factor * B(i, b);
                ++products;
            }
            work::spend(work::quadruple * products + static_cast<double>(B.cols()));
        }
    return sum;
}

/// z of samples.value z = 1 by normal equations. Their error is the square of the condition of the basis
/// times round-off; two corrections by the defect take it away.
template <class T>
typename Table<T>::Vector oneByNormalEquations(const Samples<T>& samples, const Probe<T>& probe) {
    using Vector = typename Table<T>::Vector;
    const typename Table<T>::Matrix& value = samples.value;
    const dense::Lu<T> normal(integrals<T>(probe.weight, value, value));
    Vector z = Vector::Zero(value.cols());
    for (int pass = 0; pass < 3; ++pass) {
        const Vector defect = Vector::Ones(value.rows()) - Vector(dense::product<T>(value, z));
        z += normal.solve(integrals<T>(probe.weight, value, defect));
    }
    return z;
}

/// Coefficients of the function 1, by least squares.
template <class T>
typename Table<T>::Vector coefficientsOfOne(const Space<T>& space, const Samples<T>& samples,
                                            const Probe<T>& probe) {
    using Vector = typename Table<T>::Vector;
    const Vector ones = Vector::Ones(samples.value.rows());
    const Vector z = hasCells(space) ? oneByNormalEquations(samples, probe)
                                     : Vector(dense::leastSquares<T>(samples.value, ones));
    const Vector defect = Vector(dense::product<T>(samples.value, z)) - ones;
    if (static_cast<double>(defect.norm()) > 1e-8)
        throw InvalidScene("/space", "does not contain the constants, so the curve cannot start at rest",
                           "add the constant function");
    return z;
}

/// The slopes of functions, all but the last as Q R with orthonormal columns of Q, and Q^T of the last.
template <class T>
struct SlopeFactors {
    typename Table<T>::Matrix R, last;
};

template <class T>
SlopeFactors<T> slopesByRotations(const Samples<T>& samples, const Probe<T>& probe,
                                  const typename Table<T>::Matrix& change) {
    using Matrix = typename Table<T>::Matrix;
    const Eigen::Index interior = change.cols() - 1;
    const Matrix slopes =
        probe.weight.cwiseSqrt().asDiagonal() * dense::product<T>(samples.derivative, change);
    const auto [Q, R] = dense::qr<T>(slopes.leftCols(interior));
    return {R, dense::product<T>(Q.leftCols(interior).transpose(), slopes.col(interior))};
}

/// Cholesky's factor of int phi_a' phi_b'; as B-splines of degree s have a condition of about s 2^s, it is
/// known to 1e-17 at degree 24, and what is missing to orthonormality is below round-off.
template <class T>
SlopeFactors<T> slopesByCells(const Samples<T>& samples, const Probe<T>& probe,
                              const typename Table<T>::Matrix& change) {
    using std::sqrt;
    using Matrix = typename Table<T>::Matrix;
    const Eigen::Index interior = change.cols() - 1;
    const Matrix raw = integrals<T>(probe.weight, samples.derivative, samples.derivative);
    const Matrix K = dense::product<T>(change.transpose(), dense::product<T>(raw, change));
    Matrix R = Matrix::Zero(interior, interior), last = Matrix::Zero(interior, 1);
    for (Eigen::Index k = 0; k < interior; ++k) {
        const auto above = [&](Eigen::Index j) {
            T sum(0);
            for (Eigen::Index l = 0; l < k; ++l) sum += R(l, k) * (j < interior ? R(l, j) : last(l, 0));
            return sum;
        };
        const T square = K(k, k) - above(k);
        R(k, k) = square > 0 ? T(sqrt(square)) : T(0);
        if (R(k, k) == 0) break;
        for (Eigen::Index j = k + 1; j < interior; ++j) R(k, j) = (K(k, j) - above(j)) / R(k, k);
        last(k, 0) = (K(k, interior) - above(interior)) / R(k, k);
    }
    return {R, last};
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
    const SlopeFactors<T> slopes =
        hasCells(space) ? slopesByCells(samples, probe, change) : slopesByRotations(samples, probe, change);
    const auto pivots = slopes.R.diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > pivots.maxCoeff() * T(1e-12)))
        throw InvalidScene("/space", "has functions that are not independent",
                           "leave out those that follow from others");
    const dense::Lu<T> upper(slopes.R);
    change.col(m - 1) -= dense::product<T>(change.leftCols(m - 1), upper.solve(slopes.last));
    change.leftCols(m - 1) =
        dense::product<T>(change.leftCols(m - 1), upper.solve(Matrix::Identity(m - 1, m - 1)));
    return change;
}

/// Smallest k for which the rule is not exact; at most degree + 1, as more does not matter. The limit is far
/// above the round-off of double precision.
template <class T>
int consistencyOf(const Table<T>& t) {
    Table<double> narrow;
    narrow.node = t.node.template cast<double>();
    narrow.weight = t.weight.template cast<double>();
    narrow.value = t.value.template cast<double>();
    narrow.derivative = t.derivative.template cast<double>();
    const std::vector<double> defect = consistencyDefects(narrow, t.space.degree + 1);
    return static_cast<int>(std::find_if(defect.begin(), defect.end(), [](double d) { return d > 1e-9; }) -
                            defect.begin());
}

/// Nodes that would do, and why these do not: a symmetric rule with u nodes sees floor(u/2) odd slopes of a
/// symmetric space, and ceil(u/2) even ones. 0: it does.
struct ParityFault {
    int nodes = 0;
    std::string message;
};
template <class T>
ParityFault parityFaultOf(const Table<T>& t, const Samples<T>& samples) {
    const Eigen::Index n = samples.derivative.rows();
    const Eigen::MatrixXd slope = dense::product<T>(samples.derivative, t.change).template cast<double>();
    const auto rank = [&](double sign) {
        const Eigen::VectorXd pivots =
            dense::rankPivots(Eigen::MatrixXd(slope + sign * slope.colwise().reverse()));
        return static_cast<int>((pivots.array() > 1e-8 * std::sqrt(static_cast<double>(n))).count());
    };
    const int nodes = t.nodes(), odd = rank(-1), even = rank(1);
    if (!t.space.isSymmetric || !t.rule.isSymmetric || odd + even != t.unknowns()) return {};
    const auto words = [](int count, const char* kind) {
        static const char* const small[] = {"no", "one", "two", "three", "four", "five", "six"};
        return (count < 7 ? std::string(small[count]) : std::to_string(count)) + " " + kind +
               (count == 1 ? " slope" : " slopes");
    };
    const bool lacksOdd = odd > nodes / 2;
    if (!lacksOdd && even <= (nodes + 1) / 2) return {};
    return {std::max(2 * odd, 2 * even - 1),
            std::to_string(nodes) + (nodes == 1 ? " node sees " : " nodes see ") +
                (lacksOdd ? words(nodes / 2, "odd") + ", the space has " + words(odd, "odd")
                          : words((nodes + 1) / 2, "even") + ", the space has " + words(even, "even"))};
}

template <class T>
void checkRank(const Table<T>& t, const Samples<T>& samples) {
    const int m = t.unknowns();
    if (tellsFunctionsApart(t) && kineticValues(t).cwiseAbs().minCoeff() > 1e-8) return;
    const ParityFault parity = parityFaultOf(t, samples);
    const int enough = std::max(m, parity.nodes);
    throw InvalidScene(
        "/quadrature",
        (t.nodes() < m ? "has too few nodes (" : "has nodes in the wrong places (") +
            std::to_string(t.nodes()) + ") for the " + std::to_string(m + 1) +
            " functions of the space: " + (parity.nodes > t.nodes() ? parity.message + ", and " : "") +
            "some motions inside a step would cost no action, and the step would be singular for every step "
            "size",
        "use at least " + std::to_string(enough) + " nodes, spread over the step");
}

/// A polynomial of degree s on one of n cells, continued over a whole step, amplifies round-off by up to
/// (4 n)^s / 2: beyond 1e16 the starting values would have no digit of the solution.
template <class T>
bool continuesUsefully(const Space<T>& space) {
    double shortest = 1.0 / space.equalCells;
    if (!space.cells.empty()) shortest = 1 - static_cast<double>(space.cells[space.cells.size() - 2]);
    return space.continues && (!hasCells(space) || std::pow(4 / shortest, space.degree) / 2 < 1e16);
}

/// Continues the curve: matches it at points of the next step, relative to the value at its start.
template <class T>
typename Table<T>::Matrix extrapolated(const Space<T>& space, const Samples<T>& samples,
                                       const Probe<T>& probe, const typename Table<T>::Matrix& change) {
    using Matrix = typename Table<T>::Matrix;
    const Eigen::Index m = change.cols();
    std::vector<T> beyond;
    for (const T& c : probe.point) beyond.push_back(T(1) + c);
    Matrix next = dense::product<T>(Samples<T>(space, beyond).value, change);
    next.col(m - 1).array() -= T(1);  // the new step starts at q_1 = q_0 + Y_{m-1}
    const Matrix own = dense::product<T>(samples.value, change);
    if (!hasCells(space)) return dense::leastSquares<T>(own, next);
    // The functions have orthonormal slopes: normal equations lose the square of some thousands.
    return dense::solve<T>(integrals<T>(probe.weight, own, own), integrals<T>(probe.weight, own, next));
}

template <class T>
Table<T> buildTable(const Space<T>& space, const Rule<T>& rule, bool mustTellApart = true) {
    using Matrix = typename Table<T>::Matrix;
    using Vector = typename Table<T>::Vector;
    // Beyond this a table takes gigabytes while it is made.
    constexpr double mostEntries = 5e6;
    if (static_cast<double>(rule.size()) * space.size > mostEntries)
        throw InvalidScene("/quadrature",
                           "has " + std::to_string(rule.size()) + " nodes for the " +
                               std::to_string(space.size) +
                               " functions of the space; the limit of their product is 5000000",
                           "fewer nodes or panels");
    const int m = space.size - 1;
    Table<T> t;
    t.space = space;
    t.rule = space.hasKinks ? rule : merged(rule);
    t.node = Eigen::Map<const Vector>(t.rule.c.data(), t.rule.size());
    t.weight = Eigen::Map<const Vector>(t.rule.b.data(), t.rule.size());
    const Probe<T> probe(space);
    const Samples<T> samples(space, probe.point);
    if (space.isAdapted) {
        t.lift = Vector::Unit(m + 1, 0);
        t.change = Matrix::Identity(m + 1, m + 1).rightCols(m);
    } else {
        t.lift = coefficientsOfOne(space, samples, probe);
        t.change = changeOfBasis(space, samples, probe);
    }
    const Samples<T> at(space, t.rule.c);
    t.value = dense::product<T>(at.value, t.change);
    t.derivative = dense::product<T>(at.derivative, t.change);
    if (mustTellApart) checkRank(t, samples);
    t.consistency = consistencyOf(t);
    t.testValue = t.value;
    t.testDerivative = t.derivative;
    t.testValue.col(m - 1) = Vector::Ones(t.nodes()) - t.value.col(m - 1);
    t.testDerivative.col(m - 1) = -t.derivative.col(m - 1);

    if (continuesUsefully(space)) t.extrapolation = extrapolated(space, samples, probe, t.change);
    return t;
}

}  // namespace extremal::detail

namespace extremal {

template <class T>
std::vector<double> consistencyDefects(const Table<T>& t, int most) {
    using std::abs;
    typename Table<T>::Vector P = Table<T>::Vector::Ones(t.nodes()),
                              lower = Table<T>::Vector::Zero(t.nodes());
    auto dP = lower, dLower = lower;
    std::vector<double> defects;
    work::spend((std::is_same_v<T, double> ? 1 : work::quadruple) * 4.0 * most * t.unknowns() * t.nodes());
    for (int k = 0; k < most; ++k) {
        double worst = 0;
        for (int a = 0; a < t.unknowns() - 1; ++a) {
            T sum(0), size(0);
            for (int i = 0; i < t.nodes(); ++i) {
                sum += t.weight(i) * (dP(i) * t.value(i, a) + P(i) * t.derivative(i, a));
                size += abs(t.weight(i) * P(i) * t.derivative(i, a));
            }
            worst = std::max(worst, static_cast<double>(abs(sum)) / static_cast<double>(size + T(1)));
        }
        defects.push_back(worst);
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
    return defects;
}

template <class T>
Eigen::VectorXd kineticValues(const Table<T>& t) {
    const Eigen::MatrixXd slope = t.derivative.template cast<double>();
    const Eigen::VectorXd weight = t.weight.template cast<double>();
    return dense::symmetricEigen<double>(slope.transpose() * weight.asDiagonal() * slope).values;
}

}  // namespace extremal
