// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/group/group_factor.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/group/algebra_series.hpp"
#include "engine/group/so3.hpp"

namespace extremal {
namespace {

using Square = GroupFactor::Square;
using Row = Eigen::Map<const Eigen::RowVectorXd>;

Row rowOf(const Square& m) { return Row(m.data(), m.size()); }

/// e^X - 1, by the series at a norm of at most 1/2 and doubling: e^2Z - 1 = 2 (e^Z - 1) + (e^Z - 1)^2.
Square exponentialLess1(Square X) {
    const double norm = X.cwiseAbs().rowwise().sum().maxCoeff();
    int doublings = 0;
    if (norm > 0.5 && std::isfinite(norm)) doublings = static_cast<int>(std::ceil(std::log2(norm / 0.5)));
    X *= std::ldexp(1.0, -doublings);
    const double size = std::min(norm, 0.5);
    int terms = 2;
    for (double rest = size * size / 2; rest > 1e-18 && terms < 16; ++terms) rest *= size / (terms + 1);
    Square sum = X / terms;
    for (int n = terms - 1; n > 0; --n) {
        const Square next = X.lazyProduct(sum) + X;
        sum = next / n;
    }
    for (int k = 0; k < doublings; ++k) {
        const Square square = sum.lazyProduct(sum);
        sum = 2 * sum + square;
    }
    return sum;
}

std::string basisName(std::size_t i) { return "E_" + std::to_string(i + 1); }

}  // namespace

GroupFactor::GroupFactor(std::string named, std::vector<Square> given, const std::string& pointer)
    : name(std::move(named)), basis(std::move(given)) {
    d = static_cast<int>(basis.size());
    n = basis.empty() ? 0 : static_cast<int>(basis[0].rows());
    if (d < 1 || d > maxDimension)
        throw InvalidScene(pointer,
                           "has " + std::to_string(d) + " matrices; from 1 to " +
                               std::to_string(maxDimension) + " span an algebra here",
                           "a product of smaller groups");
    // Of matrices of any size: scaled to length 1 before they are compared.
    Eigen::MatrixXd rows(d, n * n);
    for (int a = 0; a < d; ++a) rows.row(a) = rowOf(basis[static_cast<std::size_t>(a)]);
    const Eigen::VectorXd lengths = rows.rowwise().norm();
    for (int a = 0; a < d; ++a)
        if (!(lengths(a) > 0) || !std::isfinite(lengths(a)))
            throw InvalidScene(pointer + "/" + std::to_string(a),
                               "is zero or not finite, so that the matrices are not a basis",
                               "a matrix of the algebra that the others do not give");
    const Eigen::MatrixXd unit = lengths.cwiseInverse().asDiagonal() * rows;
    const auto gram = dense::symmetricEigen<double>(dense::product<double>(unit, unit.transpose()));
    if (gram.values(0) < 1e-12) {
        Eigen::Index most = 0;
        gram.vectors.col(0).cwiseAbs().maxCoeff(&most);
        throw InvalidScene(pointer,
                           "is not a basis: the matrices depend on each other linearly (" +
                               basisName(static_cast<std::size_t>(most)) + " is a sum of the others)",
                           "leave it out, or give one that is independent");
    }
    coordinates = Eigen::LLT<Eigen::MatrixXd>(dense::product<double>(rows, rows.transpose())).solve(rows);
    constants = StructureConstants(d);
    addBrackets(pointer);
    recognise();
}

void GroupFactor::addBrackets(const std::string& pointer) {
    for (int i = 0; i < d; ++i)
        for (int j = i + 1; j < d; ++j) {
            const Square &a = basis[static_cast<std::size_t>(i)], &b = basis[static_cast<std::size_t>(j)];
            const Square commutator = a.lazyProduct(b) - b.lazyProduct(a);
            const Eigen::VectorXd c = coordinates.lazyProduct(rowOf(commutator).transpose());
            Square rest = commutator;
            double largest = 0;
            for (int k = 0; k < d; ++k) {
                rest -= c(k) * basis[static_cast<std::size_t>(k)];
                largest = std::max(largest, std::abs(c(k)));
            }
            const double scale = a.norm() * b.norm();
            if (!(rest.norm() <= 1e-12 * scale))
                throw InvalidScene(pointer,
                                   "is not closed: [" + basisName(static_cast<std::size_t>(i)) + ", " +
                                       basisName(static_cast<std::size_t>(j)) +
                                       "] is not a sum of the matrices (what is left of it has the size " +
                                       formatNumber(rest.norm(), 3) + ")",
                                   "add this commutator to the basis, or mend the two matrices");
            for (int k = 0; k < d; ++k)
                if (std::abs(c(k)) > 1e-13 * std::max(largest, scale)) constants.add({i, j, k, c(k)});
        }
}

void GroupFactor::recognise() {
    isAbelian = constants.brackets().empty();
    if (d != 3 || isAbelian) return;
    std::vector<Eigen::Matrix3d> ad(3, Eigen::Matrix3d::Zero());
    for (const StructureConstants::Bracket& b : constants.brackets()) {
        ad[static_cast<std::size_t>(b.i)](b.k, b.j) += b.value;
        ad[static_cast<std::size_t>(b.j)](b.k, b.i) -= b.value;
    }
    rotations = rotationAlgebraOf(ad, std::vector<Eigen::MatrixXd>(basis.begin(), basis.end()));
}

Square GroupFactor::hat(const Vector& x) const {
    Square X = Square::Zero(n, n);
    for (int a = 0; a < d; ++a) X += x(a) * basis[static_cast<std::size_t>(a)];
    return X;
}
Square GroupFactor::exponential(const Vector& x) const {
    Square g = hat(x);
    if (rotations && rotations->spin != RotationAlgebra::Spin::other) {
        const double y = rotations->own(x).squaredNorm();
        const auto c = so3::coefficients<0>(rotations->spin == RotationAlgebra::Spin::half ? y / 4 : y);
        g = (c.s * g + c.a[0] * g.lazyProduct(g)).eval();
    } else {
        g = exponentialLess1(g);
    }
    g.diagonal().array() += 1;
    return g;
}
GroupFactor::Vector GroupFactor::coordinatesOf(const Square& X) const {
    return coordinates.lazyProduct(rowOf(X).transpose());
}
GroupFactor::Matrix GroupFactor::adjoint(const Square& g, const Square& inverse) const {
    Matrix r(d, d);
    for (int a = 0; a < d; ++a) {
        const Square turned = g.lazyProduct(basis[static_cast<std::size_t>(a)]);
        r.col(a) = coordinatesOf(turned.lazyProduct(inverse));
    }
    return r;
}

GroupFactor::Vector GroupFactor::logarithm(const Square& g, const Vector& near) const {
    Vector xi = near;
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 30; ++iteration) {
        // exp(-xi) g = exp(delta) up to delta^3: its odd part has the coordinates of delta.
        const Square rest = exponential(-xi).lazyProduct(g);
        const Square inverse = Eigen::PartialPivLU<Square>(rest).inverse();
        const Vector delta = coordinatesOf((rest - inverse) / 2);
        const double size = delta.norm();
        if (!std::isfinite(size)) return near;
        xi += series::inverseOfDexp(constants, xi, delta);
        if (size <= 1e-15 * (1 + xi.norm()) || (iteration > 4 && size >= last && size < 1e-10)) return xi;
        last = size;
    }
    return last < 1e-8 ? xi : near;
}

}  // namespace extremal
