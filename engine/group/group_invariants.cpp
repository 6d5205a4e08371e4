// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/group/group_invariants.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/algebra/dense.hpp"

namespace extremal {
namespace {

using Square = MatrixGroup::Square;
constexpr double none = 1e-9;  ///< relative size of an eigenvalue 0 of squares

/// A basis of the null space of the sum of A^T A over what `rows` gives, as columns; each with the largest
/// entry 1.
Eigen::MatrixXd nullSpace(const Eigen::MatrixXd& squares) {
    const dense::SymmetricEigen<double> eigen = dense::symmetricEigen<double>(squares);
    const double largest = std::max(eigen.values.tail(1)(0), 1e-300);
    Eigen::Index count = 0;
    while (count < squares.rows() && eigen.values(count) < none * largest) ++count;
    Eigen::MatrixXd basis = eigen.vectors.leftCols(count);
    for (Eigen::Index k = 0; k < count; ++k) basis.col(k) /= basis.col(k).cwiseAbs().maxCoeff();
    return basis;
}

/// The X (n x n) with condition(E, X) = 0 for each matrix of the basis; `isTraceless`: and without a trace.
template <class Condition>
std::vector<Square> invariantsOf(const MatrixGroup::Factor& f, bool isTraceless, const Condition& condition) {
    const int size = f.n * f.n;
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(size, size), A(size, size);
    for (const Square& E : f.basis) {
        const Square unit = E / E.norm();
        for (int k = 0; k < size; ++k) {
            Square X = Square::Zero(f.n, f.n);
            X.data()[k] = 1;
            const Square image = condition(unit, X);
            A.col(k) = Eigen::Map<const Eigen::VectorXd>(image.data(), size);
        }
        squares += dense::product<double>(A.transpose(), A);
    }
    if (isTraceless) {
        const Square one = Square::Identity(f.n, f.n);
        const Eigen::Map<const Eigen::VectorXd> trace(one.data(), size);
        squares += trace * trace.transpose();
    }
    const Eigen::MatrixXd basis = nullSpace(squares);
    std::vector<Square> found;
    for (Eigen::Index k = 0; k < basis.cols(); ++k)
        found.push_back(Eigen::Map<const Square>(basis.col(k).data(), f.n, f.n));
    return found;
}

std::vector<Eigen::VectorXd> vectorsOf(const MatrixGroup::Factor& f, bool fromLeft) {
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(f.n, f.n);
    for (const Square& E : f.basis) {
        const Eigen::MatrixXd unit = E / E.norm();
        squares += fromLeft ? dense::product<double>(unit, unit.transpose())
                            : dense::product<double>(unit.transpose(), unit);
    }
    const Eigen::MatrixXd basis = nullSpace(squares);
    std::vector<Eigen::VectorXd> found;
    for (Eigen::Index k = 0; k < basis.cols(); ++k) found.emplace_back(basis.col(k));
    return found;
}

}  // namespace

GroupInvariants::GroupInvariants(const MatrixGroup& group) {
    for (const MatrixGroup::Factor& f : group.factors()) {
        Part part(f);
        part.forms = invariantsOf(f, false, [](const Square& E, const Square& X) -> Square {
            return E.transpose().lazyProduct(X) + X.lazyProduct(E);
        });
        part.duals = invariantsOf(f, false, [](const Square& E, const Square& X) -> Square {
            return E.lazyProduct(X) + X.lazyProduct(E.transpose());
        });
        // Every g commutes with 1, which tells nothing and costs the digits of far places.
        part.commutant = invariantsOf(f, true, [](const Square& E, const Square& X) -> Square {
            return E.lazyProduct(X) - X.lazyProduct(E);
        });
        part.rows = vectorsOf(f, true);
        part.columns = vectorsOf(f, false);
        part.isSpecial = std::all_of(f.basis.begin(), f.basis.end(),
                                     [](const Square& E) { return std::abs(E.trace()) <= 1e-12 * E.norm(); });
        part.isOrthogonal =
            part.forms.size() == 1 && part.commutant.empty() &&
            (part.forms[0] - part.forms[0](0, 0) * Square::Identity(f.n, f.n)).norm() < 1e-9 &&
            f.d == f.n * (f.n - 1) / 2;
        linearise(part, dimension_);
        parts_.push_back(std::move(part));
    }
}

/// Calls add(defect, place, size) for each defect; they vanish on the group. In terms of X, g (1 + X): each
/// is linear there with coefficients that do not depend on g, up to the defect itself.
template <class Add>
void GroupInvariants::defects(const Part& part, const Square& g, const Square& inverse, const Add& add) {
    for (const Square& K : part.forms) {
        const Square defect = g.transpose().lazyProduct(Square(K.lazyProduct(g))) - K;
        add(defect.data(), defect.size());
    }
    for (const Square& K : part.duals) {
        const Square defect = K - inverse.lazyProduct(Square(K.lazyProduct(inverse.transpose())));
        add(defect.data(), defect.size());
    }
    for (const Square& C : part.commutant) {
        const Square defect = C - inverse.lazyProduct(Square(C.lazyProduct(g)));
        add(defect.data(), defect.size());
    }
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, GroupFactor::maxSize, 1>;
    for (const Eigen::VectorXd& w : part.rows) {
        const Vector defect = g.transpose().lazyProduct(w) - w;
        add(defect.data(), defect.size());
    }
    for (const Eigen::VectorXd& w : part.columns) {
        const Vector defect = w - inverse.lazyProduct(w);
        add(defect.data(), defect.size());
    }
    if (part.isSpecial) {
        const double defect = Eigen::PartialPivLU<Square>(g).determinant() - 1;
        add(&defect, Eigen::Index(1));
    }
}

/// back: the pseudo-inverse of X -> the defects of 1 + X, to first order; the kernel is the algebra that the
/// invariants define.
void GroupInvariants::linearise(Part& part, int& dimension) {
    const int n = part.factor.n, size = n * n;
    const Square one = Square::Identity(n, n);
    Eigen::Index count = 0;
    defects(part, one, one, [&](const double*, Eigen::Index many) { count += many; });
    if (count == 0) {
        dimension += size;
        return;
    }
    Eigen::MatrixXd A(count, size);
    for (int k = 0; k < size; ++k) {
        Square X = Square::Zero(n, n);
        X.data()[k] = 1;
        Eigen::Index at = 0;
        const auto add = [&](const Square& defect) {
            A.col(k).segment(at, size) = Eigen::Map<const Eigen::VectorXd>(defect.data(), size);
            at += size;
        };
        for (const Square& K : part.forms) add(X.transpose().lazyProduct(K) + K.lazyProduct(X));
        for (const Square& K : part.duals) add(X.lazyProduct(K) + K.lazyProduct(X.transpose()));
        for (const Square& C : part.commutant) add(X.lazyProduct(C) - C.lazyProduct(X));
        for (const Eigen::VectorXd& w : part.rows) {
            A.col(k).segment(at, n) = X.transpose().lazyProduct(w);
            at += n;
        }
        for (const Eigen::VectorXd& w : part.columns) {
            A.col(k).segment(at, n) = X.lazyProduct(w);
            at += n;
        }
        if (part.isSpecial) A(at, k) = X.trace();
    }
    const dense::SymmetricEigen<double> squares =
        dense::symmetricEigen<double>(dense::product<double>(A.transpose(), A));
    const Eigen::VectorXd& values = squares.values;
    Eigen::VectorXd inverted = Eigen::VectorXd::Zero(size);
    int rank = 0;
    for (int k = 0; k < size; ++k)
        if (values(k) > none * std::max(values(size - 1), 1e-300)) {
            inverted(k) = 1 / values(k);
            ++rank;
        }
    const Eigen::MatrixXd back = dense::product<double>(squares.vectors.transpose(), A.transpose());
    part.back = dense::product<double>(squares.vectors, inverted.asDiagonal() * back);
    dimension += size - rank;
}

double GroupInvariants::distance(const MatrixGroup::Entries& g) const {
    double largest = 0;
    for (const Part& part : parts_) {
        const int n = part.factor.n;
        const Square here = MatrixGroup::View(g.data() + part.factor.entry, n, n);
        const Square inverse = Eigen::PartialPivLU<Square>(here).inverse();
        defects(part, here, inverse, [&](const double* defect, Eigen::Index size) {
            for (Eigen::Index k = 0; k < size; ++k)
                largest = std::isnan(defect[k]) ? defect[k] : std::max(largest, std::abs(defect[k]));
        });
    }
    return largest;
}

void GroupInvariants::cure(MatrixGroup::Entries& g) const {
    for (const Part& part : parts_) {
        if (part.back.size() == 0) continue;
        const int n = part.factor.n;
        Eigen::Map<Square> to(g.data() + part.factor.entry, n, n);
        const Square here = to, inverse = Eigen::PartialPivLU<Square>(here).inverse();
        Square X = Square::Zero(n, n);
        Eigen::Index at = 0;
        defects(part, here, inverse, [&](const double* defect, Eigen::Index size) {
            Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 1>> flat(X.data(), n * n);
            for (Eigen::Index k = 0; k < size; ++k) flat -= defect[k] * part.back.col(at++);
        });
        to += here.lazyProduct(X);
    }
}

}  // namespace extremal
