#include "engine/action/oscillatory_table.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"

namespace extremal {
namespace {

/// Tables are made in extended precision: where functions are nearly dependent, their differences lose up to six digits.
using Wide = long double;
using Matrix = Eigen::Matrix<Wide, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Wide, Eigen::Dynamic, 1>;

/// Where the functions are looked at, and with which weight.
struct Points {
    std::vector<Wide> tau, phase, weight;

    void add(Wide c, Wide angle, Wide w) {
        tau.push_back(c);
        phase.push_back(angle);
        weight.push_back(w);
    }
    Eigen::Index size() const { return static_cast<Eigen::Index>(tau.size()); }
};

Points pointsOf(const FilonGrid& grid) {
    Points points;
    const std::size_t M = grid.phase.size();
    for (std::size_t i = 0; i < grid.node.size(); ++i)
        for (std::size_t m = 0; m < M; ++m) points.add(grid.node[i], grid.phase[m], grid.weight[i * M + m]);
    return points;
}
/// Every node with every one of equally spaced phases.
Points pointsOf(const Rule<double>& rule, int phases) {
    Points points;
    for (std::size_t i = 0; i < rule.c.size(); ++i)
        for (int m = 0; m < phases; ++m)
            points.add(rule.c[i], 2 * std::numbers::pi_v<Wide> * m / phases, Wide(rule.b[i]) / phases);
    return points;
}

Points pointsOf(const Rule<double>& rule, double z) {
    Points points;
    for (std::size_t i = 0; i < rule.c.size(); ++i) points.add(rule.c[i], Wide(z) * Wide(rule.c[i]), rule.b[i]);
    return points;
}

/// Functions of a basis at points: (i, a).
struct Samples {
    Matrix value, slope;
    Samples(const OscillatoryBasis& basis, Wide z, const Points& points, Wide forward = 0)
        : value(points.size(), basis.size()), slope(points.size(), basis.size()) {
        std::vector<Wide> v(static_cast<std::size_t>(basis.size())), s(v.size());
        for (Eigen::Index i = 0; i < points.size(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            basis.evaluate<Wide>(points.tau[k] + forward, points.phase[k] + forward * z, z, v, s);
            value.row(i) = Eigen::Map<const Vector>(v.data(), basis.size()).transpose();
            slope.row(i) = Eigen::Map<const Vector>(s.data(), basis.size()).transpose();
        }
    }
};

/// Integrates products of two functions along the curve, to round-off.
Points curvePoints(const OscillatoryBasis& basis, double z) {
    const int top = 2 * basis.highestHarmonic();
    return pointsOf(composite(gauss<double>(basis.highestDegree() + 10), 1 + static_cast<int>(top * std::abs(z) / 6)), z);
}

/// The same over all phases, as if these were independent of the position: what a grid sees.
Points gridPoints(const OscillatoryBasis& basis) {
    return pointsOf(gauss<double>(basis.highestDegree() + 1), 4 * basis.highestHarmonic() + 2);
}

/// The product that orthonormalises, and the functions with trivial traces.
struct Functions {
    Matrix gram;    ///< phi phi + phi' phi' / (z^2 + 1) of the basis, integrated by the points
    Matrix change;  ///< (function of the basis, a)

    Functions(const OscillatoryBasis& basis, Wide z, const Points& points) {
        const Samples at(basis, z, points);
        const auto weight = Eigen::Map<const Vector>(points.weight.data(), points.size());
        const Matrix slopes = at.slope.transpose() * weight.asDiagonal() * at.slope;
        gram = at.value.transpose() * weight.asDiagonal() * at.value + slopes / (z * z + 1);
        const Eigen::Index n = gram.rows();
        const Vector scale = gram.diagonal().cwiseSqrt().cwiseInverse();

        // Combinations that vanish at both ends, orthonormal; what is nearly dependent is left out.
        Points ends;
        ends.add(0, 0, 1);
        ends.add(1, z, 1);
        const Matrix traces = scale.asDiagonal() * Samples(basis, z, ends).value.transpose();
        const Matrix Q = Eigen::HouseholderQR<Matrix>(traces).householderQ() * Matrix::Identity(n, n);
        const Matrix vanishing = scale.asDiagonal() * Q.rightCols(n - 2);
        const Eigen::SelfAdjointEigenSolver<Matrix> eigen(vanishing.transpose() * gram * vanishing);
        const Vector& squares = eigen.eigenvalues();
        Eigen::Index dropped = 0;
        while (dropped < n - 3 && !(squares(dropped) > Wide(1e-11) * squares(n - 3))) ++dropped;
        const Eigen::Index kept = n - 2 - dropped;
        change = Matrix::Zero(n, kept + 1);
        change.leftCols(kept) = vanishing * eigen.eigenvectors().rightCols(kept) *
                                squares.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
        // tau itself, and what is left of it orthogonal to these.
        change(0, kept) = change(1, kept) = Wide(0.5);
        change.col(kept) -= change.leftCols(kept) * (change.leftCols(kept).transpose() * (gram * change.col(kept)));
    }
};

/// The functions of the table projected on slow parts of degree 3 and first harmonics with linear amplitudes.
Matrix smoothestPart(const OscillatoryBasis& basis, const Functions& f) {
    std::vector<Eigen::Index> kept;
    for (int j = 0; j <= std::min(basis.degree, 3); ++j) kept.push_back(j);
    if (basis.highestHarmonic() > 0)
        for (int j = 0; j < 2 * (1 + std::min(basis.harmonics[0], 1)); ++j) kept.push_back(basis.degree + 1 + j);
    const Matrix onto = Matrix(f.gram * f.change)(kept, Eigen::all);
    const Matrix product = f.gram(kept, kept);
    Matrix part = Matrix::Zero(f.gram.rows(), f.change.cols());
    const Matrix coefficients = product.partialPivLu().solve(onto);
    for (std::size_t i = 0; i < kept.size(); ++i) part.row(kept[i]) = coefficients.row(static_cast<Eigen::Index>(i));
    return part;
}

/// The rule must tell all functions from each other.
void checkRule(const Table<double>& t, const std::string& remedy) {
    if (tellsFunctionsApart(t)) return;
    throw InvalidScene("/quadrature", "does not tell the " + std::to_string(t.unknowns() + 1) +
                                          " functions of the space from each other: some motions inside a step would cost no "
                                          "action, and the step would be singular",
                       remedy);
}

/// A plain rule must resolve the square of the highest harmonic.
void checkResolution(const OscillatoryBasis& basis, double z, const Rule<double>& rule) {
    const double periods = std::abs(z) / (2 * std::numbers::pi), least = 4 * basis.highestHarmonic() * periods;
    if (rule.size() > least) return;
    throw InvalidScene("/quadrature", formatNumber(rule.size()) + " nodes do not resolve the " + formatNumber(periods, 4) +
                                          " fast periods of a step",
                       "some 24 for each period, or a Filon rule");
}

Table<double> build(const OscillatoryBasis& basis, double z, const Points& points, const Points& product,
                    const std::string& remedy) {
    const Functions f(basis, z, product);
    const Samples at(basis, z, points);
    const Eigen::Index m = f.change.cols();
    Table<double> t;
    t.space = oscillatorySpace(basis, z);
    t.frequency = z;
    t.node = Eigen::Map<const Vector>(points.tau.data(), points.size()).cast<double>();
    t.weight = Eigen::Map<const Vector>(points.weight.data(), points.size()).cast<double>();
    t.change = f.change.cast<double>();
    t.lift = Eigen::VectorXd::Unit(basis.size(), 0);
    t.value = (at.value * f.change).cast<double>();
    t.derivative = (at.slope * f.change).cast<double>();
    checkRule(t, remedy);
    t.testValue = t.value;
    t.testDerivative = t.derivative;
    t.testValue.col(m - 1) = Eigen::VectorXd::Ones(t.nodes()) - t.value.col(m - 1);
    t.testDerivative.col(m - 1) = -t.derivative.col(m - 1);

    // A step later the space is the same: amplitudes are continued as polynomials, phases by z.
    const Points grid = gridPoints(basis);
    const Matrix shift = Eigen::HouseholderQR<Matrix>(Samples(basis, z, grid).value).solve(Samples(basis, z, grid, 1).value);
    Points start;
    start.add(0, 0, 1);
    const auto continued = [&](const Matrix& curve) {
        Matrix next = shift * curve;
        next.row(0) -= Samples(basis, z, start).value * next;  // relative to where it begins
        Matrix Y = f.change.transpose() * f.gram * next;
        Y.row(m - 1) /= f.change.col(m - 1).dot(f.gram * f.change.col(m - 1));
        return Eigen::MatrixXd(Y.cast<double>());
    };
    t.continuation = continued(f.change);
    t.cautious = continued(smoothestPart(basis, f));
    return t;
}

}  // namespace

Table<double> makeOscillatoryTable(const OscillatoryBasis& basis, double z, FilonNodes nodes, int count, int phases) {
    const FilonGrid grid = filonGrid(nodes, count, phases, z);
    Table<double> t = build(basis, z, pointsOf(grid), gridPoints(basis),
                            "at least " + std::to_string(basis.highestDegree() + 1) + " nodes and " +
                                std::to_string(4 * basis.highestHarmonic() + 1) + " phases");
    t.upTo = [nodes, count, phases, z](const double& tau, std::span<double> share) {
        const std::vector<double> weight = filonGrid(nodes, count, phases, z, tau).weight;
        std::copy(weight.begin(), weight.end(), share.begin());
    };
    return t;
}

Table<double> makeOscillatoryTable(const OscillatoryBasis& basis, double z, const Rule<double>& rule) {
    checkResolution(basis, z, rule);
    Table<double> t = build(basis, z, pointsOf(rule, z), curvePoints(basis, z), "more nodes or panels, or a Filon rule");
    t.rule = rule;
    t.upTo = [rule](const double& tau, std::span<double> share) { partialWeights<double>(rule, tau, share); };
    return t;
}

}  // namespace extremal
