// SPDX-License-Identifier: GPL-3.0-or-later
/// A matrix group given by a basis E_1..E_d of its algebra, real n x n matrices, or a product of such groups.
///
/// [E_i, E_j] = sum_k c_ijk E_k with the structure constants c, found from the basis and kept sparse; the
/// coordinates of a matrix X of the algebra are G^-1 <E_a, X>, G_ab = <E_a, E_b> (Frobenius), and hat(x) =
/// sum_k x_k E_k. Because the brackets are commutators the Jacobi identity follows, and because the E_a are
/// independent matrices the representation is faithful. c of a product is block diagonal: factors do not see
/// each other. An element g is the list of the entries of its factors, row by row, factor after factor.
///
///     bracket(x, y) = [x, y] = ad_x y,                    coadjoint(x, m) = ad_x^T m.
///
/// Sizes are those of a run, but bounded, so that nothing is allocated in a step. Source: Leok 2004, sec. 3,
/// for which a group is any Lie group.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "engine/group/rotation_algebra.hpp"

namespace extremal {

class MatrixGroup {
public:
    static constexpr int maxFactorDimension = 12, maxFactorSize = 12, maxDimension = 24, maxEntries = 256;
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, maxDimension, 1>;
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, maxDimension, maxDimension>;
    using Entries = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, maxEntries, 1>;
    using Square =
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, maxFactorSize, maxFactorSize>;
    using View = Eigen::Map<const Square>;

    struct Factor {
        std::string name;             ///< prefix of its variables; empty: the only one
        std::vector<Square> basis;    ///< of d matrices, n x n
        Eigen::MatrixXd coordinates;  ///< d x n^2: of a matrix of the algebra, row by row
        int n = 0, d = 0;
        int entry = 0, coordinate = 0;             ///< the first of its entries and of its coordinates
        std::optional<RotationAlgebra> rotations;  ///< where the algebra is so(3)
        bool isAbelian = false;
    };
    /// The basis of a factor, and the pointer to it in messages.
    struct Definition {
        std::string name;
        std::vector<Square> basis;
        std::string pointer;
    };
    /// Throws InvalidScene where matrices do not form a basis, are not closed under brackets, or are too
    /// many.
    explicit MatrixGroup(const std::vector<Definition>& factors);

    const std::vector<Factor>& factors() const { return factors_; }
    /// Whether all factors are so(3) or abelian: functions of ad have closed forms.
    bool hasClosedForms() const { return hasClosedForms_; }
    int dimension() const { return dimension_; }
    int entries() const { return entries_; }

    Vector bracket(const Vector& x, const Vector& y) const;
    Vector coadjoint(const Vector& x, const Vector& m) const;
    /// ad_x as a matrix.
    Matrix ad(const Vector& x) const;
    /// ad of the basis vector k, times y.
    Vector bracketOfBasis(int k, const Vector& y) const;
    /// ad of the basis vector k transposed, times m.
    Vector coadjointOfBasis(int k, const Vector& m) const;
    /// An upper bound of the row-sum norms of ad_x and its transpose.
    double adNorm(const Vector& x) const;

    Entries identity() const;
    /// exp(hat x), and g h.
    Entries exponential(const Vector& x) const;
    Entries product(const Entries& g, const Entries& h) const;
    /// Throws nothing: entries that are not finite where g has no inverse.
    Entries inverse(const Entries& g) const;
    /// hat(x), a matrix of each factor.
    Entries hat(const Vector& x) const;
    /// The coordinates of the part in the algebra of matrices.
    Vector coordinatesOf(const Entries& X) const;
    /// Ad_g, given g and its inverse: column a has the coordinates of g E_a g^-1.
    Matrix adjoint(const Entries& g, const Entries& inverse) const;
    /// xi with exp(hat xi) = g, by Newton's method from a guess near it; the guess where it does not
    /// converge.
    Vector logarithm(const Entries& g, const Vector& near) const;

    View part(const Factor& f, const Entries& g) const { return View(g.data() + f.entry, f.n, f.n); }

private:
    struct Bracket {
        int i, j, k;  ///< i < j: [E_i, E_j] has `value` E_k in it
        double value;
    };
    struct Entry {
        int row, column;
        double value;
    };
    void addFactor(const Definition& definition);
    void addBrackets(const Factor& factor, const std::string& pointer);
    void recognise(Factor& factor) const;

    std::vector<Factor> factors_;
    std::vector<Bracket> brackets_;
    std::vector<std::vector<Entry>> ofBasis_;  ///< ad of each basis vector
    int dimension_ = 0, entries_ = 0;
    bool hasClosedForms_ = false;
};

}  // namespace extremal
