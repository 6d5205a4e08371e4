// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/oscillatory_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

// T: double on a grid of independent phases, where the functions are far from dependent. Along a curve with
// few periods they are nearly polynomials, and their differences lose up to six digits: extended precision.

using dense::Matrix;
using dense::Vector;

/// Where the functions are looked at, and with which weight.
template <class T>
struct Points {
    std::vector<T> tau, weight;
    std::vector<Phases<T>> phase;

    void add(T c, const Phases<T>& angle, T w) {
        tau.push_back(c);
        phase.push_back(angle);
        weight.push_back(w);
    }
    Eigen::Index size() const { return static_cast<Eigen::Index>(tau.size()); }
    Eigen::Map<const Vector<T>> weights() const { return {weight.data(), size()}; }
};

template <class T>
Phases<T> wide(const Phases<double>& z) {
    return {static_cast<T>(z[0]), static_cast<T>(z[1])};
}

/// Every node with every pair of phases.
Points<double> pointsOf(const FilonGrid& grid) {
    Points<double> points;
    const std::size_t M = grid.phase.size();
    for (std::size_t i = 0; i < grid.node.size(); ++i)
        for (std::size_t m = 0; m < M; ++m) points.add(grid.node[i], grid.phase[m], grid.weight[i * M + m]);
    return points;
}

template <class T>
Points<T> pointsOf(const Rule<double>& rule, const Phases<double>& z) {
    Points<T> points;
    for (std::size_t i = 0; i < rule.c.size(); ++i) {
        const T c = rule.c[i];
        points.add(c, {T(z[0]) * c, T(z[1]) * c}, rule.b[i]);
    }
    return points;
}

/// Functions of a basis at points: (i, a).
template <class T>
struct Samples {
    Matrix<T> value, slope;

    Samples(const OscillatoryBasis& basis, const Phases<T>& z, const Points<T>& points)
        : value(basis.size(), points.size()), slope(basis.size(), points.size()) {
        const auto n = static_cast<std::size_t>(basis.size());
        for (Eigen::Index i = 0; i < points.size(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            basis.evaluate<T>(points.tau[k], points.phase[k], z, {value.col(i).data(), n},
                              {slope.col(i).data(), n});
        }
        value.transposeInPlace();
        slope.transposeInPlace();
    }
};

/// What the fastest harmonic turns by.
double fastestPhase(const OscillatoryBasis& basis, const Phases<double>& z) {
    double fastest = 0;
    for (const Harmonic& k : basis.harmonics) fastest = std::max(fastest, std::abs(k.times(z)));
    return fastest;
}

/// Integrates products of two functions along the curve, to round-off.
Points<long double> curvePoints(const OscillatoryBasis& basis, const Phases<double>& z) {
    const int panels = 1 + static_cast<int>(fastestPhase(basis, z) / 3);
    return pointsOf<long double>(composite(gauss<double>(basis.highestDegree() + 10), panels), z);
}

/// The same over all phases, as if these were independent of the position: what a grid sees.
Points<double> gridPoints(const OscillatoryBasis& basis) {
    const Multiples top = basis.highestHarmonics();
    const int M[] = {4 * top[0] + 2, top[1] > 0 ? 4 * top[1] + 2 : 1};
    const Rule<double> rule = gauss<double>(basis.highestDegree() + 1);
    const double turn = 2 * std::numbers::pi;
    Points<double> points;
    for (std::size_t i = 0; i < rule.c.size(); ++i)
        for (int m = 0; m < M[0]; ++m)
            for (int n = 0; n < M[1]; ++n)
                points.add(rule.c[i], {turn * m / M[0], turn * n / M[1]}, rule.b[i] / (M[0] * M[1]));
    return points;
}

/// The product that orthonormalises, and the functions with trivial traces.
template <class T>
struct Functions {
    Matrix<T> gram;    ///< phi phi + phi' phi' / (z . z + 1) of the basis, integrated by the points
    Matrix<T> change;  ///< (function of the basis, a)

    Functions(const OscillatoryBasis& basis, const Phases<T>& z, const Points<T>& points) {
        const Samples<T> at(basis, z, points);
        const auto weight = points.weights().asDiagonal();
        const Matrix<T> slopes = at.slope.transpose() * weight * at.slope;
        gram = at.value.transpose() * weight * at.value + slopes / (z[0] * z[0] + z[1] * z[1] + 1);
        const Eigen::Index n = gram.rows();
        const Vector<T> scale = gram.diagonal().cwiseSqrt().cwiseInverse();

        // Combinations that vanish at both ends, orthonormal; what is nearly dependent is left out.
        Points<T> ends;
        ends.add(0, {0, 0}, 1);
        ends.add(1, z, 1);
        const Matrix<T> traces = scale.asDiagonal() * Samples<T>(basis, z, ends).value.transpose();
        const Matrix<T> vanishing = scale.asDiagonal() * dense::qr<T>(traces).Q.rightCols(n - 2);
        const auto eigen = dense::symmetricEigen<T>(vanishing.transpose() * gram * vanishing);
        const auto& squares = eigen.values;
        Eigen::Index dropped = 0;
        while (dropped < n - 3 && !(squares(dropped) > T(1e-11) * squares(n - 3))) ++dropped;
        const Eigen::Index kept = n - 2 - dropped;
        change = Matrix<T>::Zero(n, kept + 1);
        change.leftCols(kept) = vanishing * eigen.vectors.rightCols(kept) *
                                squares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
        // tau itself, and what is left of it orthogonal to these.
        change(0, kept) = change(1, kept) = T(0.5);
        change.col(kept) -=
            change.leftCols(kept) * (change.leftCols(kept).transpose() * (gram * change.col(kept)));
    }
};

/// The functions of the table projected on slow parts of degree 3 and first harmonics with linear amplitudes.
template <class T>
Matrix<T> smoothestPart(const OscillatoryBasis& basis, const Functions<T>& f) {
    std::vector<Eigen::Index> kept;
    for (int j = 0; j <= std::min(basis.degree, 3); ++j) kept.push_back(j);
    Eigen::Index first = basis.degree + 1;
    for (const Harmonic& k : basis.harmonics) {
        if (std::abs(k.of[0]) + std::abs(k.of[1]) == 1)
            for (int j = 0; j < 2 * (1 + std::min(k.degree, 1)); ++j) kept.push_back(first + j);
        first += 2 * (k.degree + 1);
    }
    const Matrix<T> onto = Matrix<T>(f.gram * f.change)(kept, Eigen::all);
    const Matrix<double> product = Matrix<T>(f.gram(kept, kept)).template cast<double>();
    Matrix<T> part = Matrix<T>::Zero(f.gram.rows(), f.change.cols());
    const Matrix<T> coefficients =
        dense::solve<double>(product, onto.template cast<double>()).template cast<T>();  // a guess
    for (std::size_t i = 0; i < kept.size(); ++i)
        part.row(kept[i]) = coefficients.row(static_cast<Eigen::Index>(i));
    return part;
}

/// A step later the space is the same: column b holds function b, continued beyond the step, in the basis.
/// Amplitudes go on as polynomials, P_j(x + 2), phases turn by z.
template <class T>
Matrix<T> shift(const OscillatoryBasis& basis, const Phases<T>& z) {
    const int highest = basis.highestDegree();
    Matrix<T> S = Matrix<T>::Zero(highest + 2, highest + 1);  // (i, j): P_i in P_j(x + 2)
    S(0, 0) = 1;
    for (int j = 0; j < highest; ++j) {
        const T n = static_cast<T>(j);
        // (2j + 1)(x + 2) P_j - j P_{j-1}, where x P_i = ((i + 1) P_{i+1} + i P_{i-1}) / (2i + 1).
        Vector<T> next = (2 * n + 1) * 2 * S.col(j);
        for (int i = 0; i <= j; ++i) {
            const T share = (2 * n + 1) * S(i, j) / static_cast<T>(2 * i + 1);
            next(i + 1) += share * static_cast<T>(i + 1);
            if (i > 0) next(i - 1) += share * static_cast<T>(i);
        }
        if (j > 0) next -= n * S.col(j - 1);
        S.col(j + 1) = next / (n + 1);
    }
    Matrix<T> all = Matrix<T>::Zero(basis.size(), basis.size());
    all.topLeftCorner(basis.degree + 1, basis.degree + 1) =
        S.topLeftCorner(basis.degree + 1, basis.degree + 1);
    Eigen::Index first = basis.degree + 1;
    for (const Harmonic& k : basis.harmonics) {
        const T turn = k.times(z), c = std::cos(turn), s = std::sin(turn);
        for (int j = 0; j <= k.degree; ++j)
            for (int i = 0; i <= j; ++i) {
                const Eigen::Index row = first + 2 * i, column = first + 2 * j;
                all(row, column) = all(row + 1, column + 1) = S(i, j) * c;
                all(row + 1, column) = -S(i, j) * s;
                all(row, column + 1) = S(i, j) * s;
            }
        first += 2 * (k.degree + 1);
    }
    return all;
}

/// The rule must tell all functions from each other.
void checkRule(const Table<double>& t, const std::string& remedy) {
    if (tellsFunctionsApart(t)) return;
    throw InvalidScene(
        "/quadrature",
        "does not tell the " + std::to_string(t.unknowns() + 1) +
            " functions of the space from each other: some motions inside a step would cost no "
            "action, and the step would be singular",
        remedy);
}

template <class T>
Table<double> build(const OscillatoryBasis& basis, const Phases<double>& turns, const Points<T>& points,
                    const Points<T>& product, const std::string& remedy) {
    const Phases<T> z = wide<T>(turns);
    const Functions<T> f(basis, z, product);
    const Samples<T> at(basis, z, points);
    const Eigen::Index m = f.change.cols();
    Table<double> t;
    t.space = oscillatorySpace(basis, turns);
    t.frequency = std::abs(turns[1]) > std::abs(turns[0]) ? turns[1] : turns[0];
    t.node = Eigen::Map<const Vector<T>>(points.tau.data(), points.size()).template cast<double>();
    t.weight = points.weights().template cast<double>();
    t.change = f.change.template cast<double>();
    t.lift = Eigen::VectorXd::Unit(basis.size(), 0);
    t.value = Matrix<T>(at.value * f.change).template cast<double>();
    t.derivative = Matrix<T>(at.slope * f.change).template cast<double>();
    checkRule(t, remedy);
    t.testValue = t.value;
    t.testDerivative = t.derivative;
    t.testValue.col(m - 1) = Eigen::VectorXd::Ones(t.nodes()) - t.value.col(m - 1);
    t.testDerivative.col(m - 1) = -t.derivative.col(m - 1);

    const Matrix<T> later = shift<T>(basis, z);
    Points<T> start;
    start.add(0, {0, 0}, 1);
    const Matrix<T> atStart = Samples<T>(basis, z, start).value, onto = f.change.transpose() * f.gram;
    const auto extrapolated = [&](const Matrix<T>& curve) {
        Matrix<T> next = later * curve;
        next.row(0) -= atStart * next;  // relative to where it begins
        Matrix<T> Y = onto * next;
        Y.row(m - 1) /= onto.row(m - 1).dot(f.change.col(m - 1));
        return Eigen::MatrixXd(Y.template cast<double>());
    };
    t.extrapolation = extrapolated(f.change);
    t.smoothExtrapolation = extrapolated(smoothestPart(basis, f));
    return t;
}

}  // namespace

void checkResolution(double z, const Rule<double>& rule) {
    const double periods = std::abs(z) / (2 * std::numbers::pi);
    if (rule.size() > 4 * periods) return;
    throw InvalidScene("/quadrature",
                       formatNumber(rule.size()) + " nodes do not resolve the " + formatNumber(periods, 4) +
                           " periods of the fastest harmonic in a step",
                       "some 24 for each fast period, or a Filon rule");
}

Table<double> makeOscillatoryTable(const OscillatoryBasis& basis, const Phases<double>& z, FilonNodes nodes,
                                   int count, const Multiples& phases) {
    const FilonGrid grid = filonGrid(nodes, count, phases, z);
    const Multiples top = basis.highestHarmonics();
    Table<double> t = build<double>(basis, z, pointsOf(grid), gridPoints(basis),
                                    "at least " + std::to_string(basis.highestDegree() + 1) + " nodes and " +
                                        std::to_string(4 * std::max(top[0], top[1]) + 1) + " phases");
    t.upTo = [nodes, count, phases, z](const double& tau, std::span<double> share) {
        const std::vector<double> weight = filonGrid(nodes, count, phases, z, tau).weight;
        std::copy(weight.begin(), weight.end(), share.begin());
    };
    return t;
}

Table<double> makeOscillatoryTable(const OscillatoryBasis& basis, const Phases<double>& z,
                                   const Rule<double>& rule) {
    checkResolution(fastestPhase(basis, z), rule);
    Table<double> t = build<long double>(basis, z, pointsOf<long double>(rule, z), curvePoints(basis, z),
                                         "more nodes or panels, or a Filon rule");
    t.rule = rule;
    t.upTo = [rule](const double& tau, std::span<double> share) { partialWeights<double>(rule, tau, share); };
    return t;
}

}  // namespace extremal
