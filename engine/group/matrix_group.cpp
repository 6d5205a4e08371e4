// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/group/matrix_group.hpp"

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

using Square = MatrixGroup::Square;
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

MatrixGroup::MatrixGroup(const std::vector<Definition>& factors) {
    for (const Definition& each : factors) addFactor(each);
    if (dimension_ > maxDimension || entries_ > maxEntries)
        throw InvalidScene(factors.size() == 1 ? factors[0].pointer : "",
                           "has the dimension " + std::to_string(dimension_) + " and " +
                               std::to_string(entries_) + " entries; the limits are " +
                               std::to_string(maxDimension) + " and " + std::to_string(maxEntries),
                           "fewer factors, or smaller ones");
    hasClosedForms_ = std::all_of(factors_.begin(), factors_.end(),
                                  [](const Factor& f) { return f.isAbelian || f.rotations; });
    ofBasis_.resize(static_cast<std::size_t>(dimension_));
    for (const Bracket& b : brackets_) {
        ofBasis_[static_cast<std::size_t>(b.i)].push_back({b.k, b.j, b.value});
        ofBasis_[static_cast<std::size_t>(b.j)].push_back({b.k, b.i, -b.value});
    }
}

void MatrixGroup::addFactor(const Definition& definition) {
    Factor f;
    f.name = definition.name;
    f.basis = definition.basis;
    f.d = static_cast<int>(f.basis.size());
    f.n = f.basis.empty() ? 0 : static_cast<int>(f.basis[0].rows());
    if (f.d < 1 || f.d > maxFactorDimension)
        throw InvalidScene(definition.pointer,
                           "has " + std::to_string(f.d) + " matrices; from 1 to " +
                               std::to_string(maxFactorDimension) + " span an algebra here",
                           "a product of smaller groups");
    f.entry = entries_;
    f.coordinate = dimension_;
    // Of matrices of any size: scaled to length 1 before they are compared.
    Eigen::MatrixXd rows(f.d, f.n * f.n);
    for (int a = 0; a < f.d; ++a) rows.row(a) = rowOf(f.basis[static_cast<std::size_t>(a)]);
    const Eigen::VectorXd lengths = rows.rowwise().norm();
    for (int a = 0; a < f.d; ++a)
        if (!(lengths(a) > 0) || !std::isfinite(lengths(a)))
            throw InvalidScene(definition.pointer + "/" + std::to_string(a),
                               "is zero or not finite, so that the matrices are not a basis",
                               "a matrix of the algebra that the others do not give");
    const Eigen::MatrixXd unit = lengths.cwiseInverse().asDiagonal() * rows;
    const auto gram = dense::symmetricEigen<double>(dense::product<double>(unit, unit.transpose()));
    if (gram.values(0) < 1e-12) {
        Eigen::Index most = 0;
        gram.vectors.col(0).cwiseAbs().maxCoeff(&most);
        throw InvalidScene(definition.pointer,
                           "is not a basis: the matrices depend on each other linearly (" +
                               basisName(static_cast<std::size_t>(most)) + " is a sum of the others)",
                           "leave it out, or give one that is independent");
    }
    f.coordinates = Eigen::LLT<Eigen::MatrixXd>(dense::product<double>(rows, rows.transpose())).solve(rows);
    dimension_ += f.d;
    entries_ += f.n * f.n;
    addBrackets(f, definition.pointer);
    recognise(f);
    factors_.push_back(std::move(f));
}

void MatrixGroup::addBrackets(const Factor& f, const std::string& pointer) {
    for (int i = 0; i < f.d; ++i)
        for (int j = i + 1; j < f.d; ++j) {
            const Square &a = f.basis[static_cast<std::size_t>(i)], &b = f.basis[static_cast<std::size_t>(j)];
            const Square commutator = a.lazyProduct(b) - b.lazyProduct(a);
            const Eigen::VectorXd c = f.coordinates.lazyProduct(rowOf(commutator).transpose());
            Square rest = commutator;
            double largest = 0;
            for (int k = 0; k < f.d; ++k) {
                rest -= c(k) * f.basis[static_cast<std::size_t>(k)];
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
            for (int k = 0; k < f.d; ++k)
                if (std::abs(c(k)) > 1e-13 * std::max(largest, scale))
                    brackets_.push_back({f.coordinate + i, f.coordinate + j, f.coordinate + k, c(k)});
        }
}

void MatrixGroup::recognise(Factor& f) const {
    std::vector<Eigen::Matrix3d> ad(3, Eigen::Matrix3d::Zero());
    std::vector<Eigen::MatrixXd> basis(f.basis.begin(), f.basis.end());
    f.isAbelian = true;
    for (const Bracket& b : brackets_) {
        const int i = b.i - f.coordinate, j = b.j - f.coordinate, k = b.k - f.coordinate;
        if (i < 0 || i >= f.d) continue;
        f.isAbelian = false;
        if (f.d != 3) return;
        ad[static_cast<std::size_t>(i)](k, j) += b.value;
        ad[static_cast<std::size_t>(j)](k, i) -= b.value;
    }
    if (f.d == 3 && !f.isAbelian) f.rotations = rotationAlgebraOf(ad, basis);
}

MatrixGroup::Vector MatrixGroup::bracket(const Vector& x, const Vector& y) const {
    Vector r = Vector::Zero(dimension_);
    for (const Bracket& b : brackets_) r(b.k) += b.value * (x(b.i) * y(b.j) - x(b.j) * y(b.i));
    return r;
}
MatrixGroup::Vector MatrixGroup::coadjoint(const Vector& x, const Vector& m) const {
    Vector r = Vector::Zero(dimension_);
    for (const Bracket& b : brackets_) {
        const double of = b.value * m(b.k);
        r(b.j) += x(b.i) * of;
        r(b.i) -= x(b.j) * of;
    }
    return r;
}
MatrixGroup::Matrix MatrixGroup::ad(const Vector& x) const {
    Matrix r = Matrix::Zero(dimension_, dimension_);
    for (const Bracket& b : brackets_) {
        r(b.k, b.j) += b.value * x(b.i);
        r(b.k, b.i) -= b.value * x(b.j);
    }
    return r;
}
MatrixGroup::Vector MatrixGroup::bracketOfBasis(int k, const Vector& y) const {
    Vector r = Vector::Zero(dimension_);
    for (const Entry& e : ofBasis_[static_cast<std::size_t>(k)]) r(e.row) += e.value * y(e.column);
    return r;
}
MatrixGroup::Vector MatrixGroup::coadjointOfBasis(int k, const Vector& m) const {
    Vector r = Vector::Zero(dimension_);
    for (const Entry& e : ofBasis_[static_cast<std::size_t>(k)]) r(e.column) += e.value * m(e.row);
    return r;
}
double MatrixGroup::adNorm(const Vector& x) const {
    Vector rows = Vector::Zero(dimension_), columns = Vector::Zero(dimension_);
    for (const Bracket& b : brackets_) {
        const double first = std::abs(b.value * x(b.i)), second = std::abs(b.value * x(b.j));
        rows(b.k) += first + second;
        columns(b.j) += first;
        columns(b.i) += second;
    }
    return std::max(rows.maxCoeff(), columns.maxCoeff());
}

MatrixGroup::Entries MatrixGroup::identity() const {
    Entries g(entries_);
    for (const Factor& f : factors_) Eigen::Map<Square>(g.data() + f.entry, f.n, f.n).setIdentity();
    return g;
}
MatrixGroup::Entries MatrixGroup::hat(const Vector& x) const {
    Entries X(entries_);
    for (const Factor& f : factors_) {
        Eigen::Map<Square> to(X.data() + f.entry, f.n, f.n);
        to.setZero();
        for (int a = 0; a < f.d; ++a) to += x(f.coordinate + a) * f.basis[static_cast<std::size_t>(a)];
    }
    return X;
}
MatrixGroup::Entries MatrixGroup::exponential(const Vector& x) const {
    Entries g = hat(x);
    for (const Factor& f : factors_) {
        Eigen::Map<Square> to(g.data() + f.entry, f.n, f.n);
        if (f.rotations && f.rotations->spin != RotationAlgebra::Spin::other) {
            const double y = f.rotations->own(x.segment<3>(f.coordinate)).squaredNorm();
            const auto c = so3::coefficients<0>(f.rotations->spin == RotationAlgebra::Spin::half ? y / 4 : y);
            const Square X = to;
            to = c.s * X + c.a[0] * X.lazyProduct(X);
        } else {
            to = exponentialLess1(to);
        }
        to.diagonal().array() += 1;
    }
    return g;
}
MatrixGroup::Entries MatrixGroup::product(const Entries& g, const Entries& h) const {
    Entries r(entries_);
    for (const Factor& f : factors_)
        Eigen::Map<Square>(r.data() + f.entry, f.n, f.n) = part(f, g).lazyProduct(part(f, h));
    return r;
}
MatrixGroup::Entries MatrixGroup::inverse(const Entries& g) const {
    Entries r(entries_);
    for (const Factor& f : factors_) {
        const Eigen::PartialPivLU<Square> lu(part(f, g));
        Eigen::Map<Square>(r.data() + f.entry, f.n, f.n) = lu.inverse();
    }
    return r;
}
MatrixGroup::Vector MatrixGroup::coordinatesOf(const Entries& X) const {
    Vector x(dimension_);
    for (const Factor& f : factors_)
        x.segment(f.coordinate, f.d) = f.coordinates.lazyProduct(X.segment(f.entry, f.n * f.n));
    return x;
}
MatrixGroup::Matrix MatrixGroup::adjoint(const Entries& g, const Entries& inverse) const {
    Matrix r = Matrix::Zero(dimension_, dimension_);
    for (const Factor& f : factors_)
        for (int a = 0; a < f.d; ++a) {
            const Square turned = part(f, g).lazyProduct(f.basis[static_cast<std::size_t>(a)]);
            const Square moved = turned.lazyProduct(part(f, inverse));
            r.col(f.coordinate + a).segment(f.coordinate, f.d) =
                f.coordinates.lazyProduct(rowOf(moved).transpose());
        }
    return r;
}

MatrixGroup::Vector MatrixGroup::logarithm(const Entries& g, const Vector& near) const {
    Vector xi = near;
    double last = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 30; ++iteration) {
        // exp(-xi) g = exp(delta) up to delta^3: its odd part has the coordinates of delta.
        const Entries rest = product(exponential(-xi), g);
        const Vector delta = coordinatesOf((rest - inverse(rest)) / 2);
        const double size = delta.norm();
        if (!std::isfinite(size)) return near;
        xi += series::inverseOfDexp(*this, xi, delta);
        if (size <= 1e-15 * (1 + xi.norm()) || (iteration > 4 && size >= last && size < 1e-10)) return xi;
        last = size;
    }
    return last < 1e-8 ? xi : near;
}

}  // namespace extremal
