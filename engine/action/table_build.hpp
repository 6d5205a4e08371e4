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

/// Smallest k for which the rule is not exact; at most degree + 1, as more does not matter.
template <class T>
int consistencyOf(const Table<T>& t) {
    const std::vector<double> defect = consistencyDefects(t, t.space.degree + 1);
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

template <class T>
Table<T> buildTable(const Space<T>& space, const Rule<T>& rule, bool mustTellApart = true) {
    using Matrix = typename Table<T>::Matrix;
    using Vector = typename Table<T>::Vector;
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
        t.lift = coefficientsOfOne(samples);
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

    if (!space.continues) return t;
    // Continue the curve: match it at points of the next step, relative to the value at its start.
    std::vector<T> beyond;
    for (const T& c : probe.point) beyond.push_back(T(1) + c);
    Matrix next = dense::product<T>(Samples<T>(space, beyond).value, t.change);
    next.col(m - 1).array() -= T(1);  // the new step starts at q_1 = q_0 + Y_{m-1}
    t.extrapolation = dense::leastSquares<T>(dense::product<T>(samples.value, t.change), next);
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
