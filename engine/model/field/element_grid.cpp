// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/element_grid.hpp"

#include <algorithm>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/small_product.hpp"
#include "engine/model/field/nodes.hpp"

namespace extremal {
namespace {

using Matrix = dense::Matrix<double>;

constexpr int packed = 8;  ///< rows of a left factor are filled up to a multiple

/// The functions of an element, 1 at one of r + 1 places at equal distances, and their slopes, at the nodes
/// of the rule: a row for each node.
struct ElementTables {
    Matrix value, slope;
};

ElementTables tablesOf(int degree, const Rule<double>& rule) {
    const int n = degree + 1;
    const LobattoBasis basis(degree);
    std::vector<double> value(static_cast<std::size_t>(n)), slope(value);
    Matrix places(n, n);  // Lobatto's functions there
    for (int a = 0; a < n; ++a) {
        basis.at(static_cast<double>(a) / degree, value.data(), slope.data());
        for (int b = 0; b < n; ++b) places(a, b) = value[static_cast<std::size_t>(b)];
    }
    const Matrix change = dense::inverse<double>(places);
    ElementTables tables{Matrix(rule.size(), n), Matrix(rule.size(), n)};
    for (int q = 0; q < rule.size(); ++q) {
        basis.at(rule.c[static_cast<std::size_t>(q)], value.data(), slope.data());
        for (int b = 0; b < n; ++b) {
            tables.value(q, b) = value[static_cast<std::size_t>(b)];
            tables.slope(q, b) = slope[static_cast<std::size_t>(b)];
        }
    }
    tables.value = tables.value * change;
    tables.slope = tables.slope * change;
    return tables;
}

}  // namespace

struct ElementGrid::Axis {
    int nodes = 1, points = 1;
    std::vector<double> lambda;
    Way toModes, toNodes, toPoints, fromPoints, fromMomenta, toMomenta;
};

std::shared_ptr<const ElementGrid::Axis> ElementGrid::axisOf(const ElementAxis& axis,
                                                             const Rule<double>& rule) {
    const auto way = [](const Matrix& A) {
        Way w;
        w.rows = static_cast<int>(A.rows());
        w.columns = static_cast<int>(A.cols());
        w.stride = (w.rows + packed - 1) / packed * packed;
        w.left.assign(static_cast<std::size_t>(w.stride) * static_cast<std::size_t>(w.columns), 0);
        for (int j = 0; j < w.columns; ++j)
            for (int i = 0; i < w.rows; ++i) {
                w.left[static_cast<std::size_t>(j) * static_cast<std::size_t>(w.stride) +
                       static_cast<std::size_t>(i)] = A(i, j);
            }
        for (int i = 0; i < w.rows; ++i)
            for (int j = 0; j < w.columns; ++j) w.right.push_back(A(i, j));
        return w;
    };
    auto made = std::make_shared<Axis>();
    if (axis.nodes == 1) {
        made->lambda = {0};
        for (Way* each : {&made->toModes, &made->toNodes, &made->toPoints, &made->fromPoints,
                          &made->fromMomenta, &made->toMomenta})
            *each = way(Matrix::Ones(1, 1));
        return made;
    }
    const int r = axis.degree, elements = axis.nodes / r, each = rule.size(), N = axis.nodes,
              Q = elements * each;
    const double size = axis.length / elements;
    const ElementTables tables = tablesOf(r, rule);
    Matrix B = Matrix::Zero(Q, N), M = Matrix::Zero(N, N), K = Matrix::Zero(N, N);
    Eigen::VectorXd weight(Q);
    for (int e = 0; e < elements; ++e)
        for (int q = 0; q < each; ++q) {
            const int point = e * each + q;
            weight(point) = size * rule.b[static_cast<std::size_t>(q)];
            for (int a = 0; a <= r; ++a) {
                const int i = (e * r + a) % N;
                B(point, i) += tables.value(q, a);
                for (int b = 0; b <= r; ++b) {
                    const int j = (e * r + b) % N;
                    M(i, j) += weight(point) * tables.value(q, a) * tables.value(q, b);
                    K(i, j) += weight(point) / (size * size) * tables.slope(q, a) * tables.slope(q, b);
                }
            }
        }
    // M = Q D Q^T, so that Q D^(-1/2) V has the mass 1 for every orthogonal V.
    const auto mass = dense::symmetricEigen<double>(M);
    const Matrix root = mass.values.array().sqrt().matrix().asDiagonal();
    const Matrix whiten = mass.vectors * root.diagonal().cwiseInverse().asDiagonal();
    const auto modes = dense::symmetricEigen<double>(
        dense::product<double>(dense::product<double>(whiten.transpose(), K), whiten));
    const Matrix U = dense::product<double>(whiten, modes.vectors),
                 MU = dense::product<double>(mass.vectors * root, modes.vectors),
                 P = dense::product<double>(B, U);
    made->nodes = N;
    made->points = Q;
    for (int i = 0; i < N; ++i) made->lambda.push_back(std::max(0.0, modes.values(i)));
    made->toModes = way(MU.transpose());
    made->toNodes = way(U);
    made->toPoints = way(P);
    made->fromPoints = way(P.transpose() * weight.asDiagonal());
    made->fromMomenta = way(U.transpose());
    made->toMomenta = way(MU);
    return made;
}

ElementGrid::ElementGrid(const ElementAxis& x, const ElementAxis& y, const Rule<double>& alongX,
                         const Rule<double>& alongY)
    : x_(axisOf(x, alongX)),
      y_(x.nodes == y.nodes && x.degree == y.degree && x.length == y.length && alongX.c == alongY.c &&
                 alongX.b == alongY.b
             ? x_
             : axisOf(y, alongY)),
      measure_(x.length * y.length),
      between_(static_cast<std::size_t>((std::max(x_->points, x_->nodes) + packed - 1) / packed * packed) *
               static_cast<std::size_t>(std::max(y_->points, y_->nodes))) {}

std::size_t ElementGrid::nodes() const {
    return static_cast<std::size_t>(x_->nodes) * static_cast<std::size_t>(y_->nodes);
}

std::size_t ElementGrid::points() const {
    return static_cast<std::size_t>(x_->points) * static_cast<std::size_t>(y_->points);
}

std::vector<double> ElementGrid::gradients() const {
    std::vector<double> all;
    for (const double mu : y_->lambda)
        for (const double lambda : x_->lambda) all.push_back(lambda + mu);
    return all;
}

void ElementGrid::apply(const Way& X, const Way& Y, const double* from, double* to) {
    static const auto product = nodeSums().product;
    std::fill(between_.begin(), between_.end(), 0.0);
    product(
        {X.left.data(), X.stride, from, X.columns, between_.data(), X.stride, X.rows, Y.columns, X.columns});
    std::fill_n(to, static_cast<std::size_t>(X.rows) * static_cast<std::size_t>(Y.rows), 0.0);
    product({between_.data(), X.stride, Y.right.data(), Y.columns, to, X.rows, X.rows, Y.rows, Y.columns});
}

void ElementGrid::toModes(const double* nodes, double* row) { apply(x_->toModes, y_->toModes, nodes, row); }
void ElementGrid::toNodes(const double* row, double* nodes) { apply(x_->toNodes, y_->toNodes, row, nodes); }
void ElementGrid::toPoints(const double* row, double* values) {
    apply(x_->toPoints, y_->toPoints, row, values);
}
void ElementGrid::fromPoints(const double* values, double* row) {
    apply(x_->fromPoints, y_->fromPoints, values, row);
}
void ElementGrid::fromMomenta(const double* momenta, double* row) {
    apply(x_->fromMomenta, y_->fromMomenta, momenta, row);
}
void ElementGrid::toMomenta(const double* row, double* momenta) {
    apply(x_->toMomenta, y_->toMomenta, row, momenta);
}

double ElementGrid::squareOf(const double* row) const {
    double sum = 0;
    for (std::size_t i = 0; i < numbers(); ++i) sum += row[i] * row[i];
    return sum / measure_;
}

}  // namespace extremal
