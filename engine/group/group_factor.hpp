// SPDX-License-Identifier: GPL-3.0-or-later
/// One matrix group, given by a basis E_1..E_d of its algebra, real n x n matrices: a factor of a product
/// (group/matrix_group.hpp), or the whole of one.
///
/// The structure constants are found from the basis; the coordinates of a matrix X of the algebra are
/// G^-1 <E_a, X>, G_ab = <E_a, E_b> (Frobenius), and hat(x) = sum_k x_k E_k. Because the brackets are
/// commutators the Jacobi identity follows, and because the E_a are independent matrices the representation
/// is faithful. Sizes are those of a run, but bounded, so that nothing is allocated in a step.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "engine/group/rotation_algebra.hpp"
#include "engine/group/structure_constants.hpp"

namespace extremal {

class GroupFactor {
public:
    static constexpr int maxDimension = 12, maxSize = 12;
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, maxDimension, 1>;
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, maxDimension, maxDimension>;
    using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, maxSize, maxSize>;
    using View = Eigen::Map<const Square>;

    /// `pointer`: to the basis, in messages. Throws InvalidScene where matrices do not form a basis, are not
    /// closed under brackets, or are too many.
    GroupFactor(std::string name, std::vector<Square> basis, const std::string& pointer);

    std::string name;             ///< prefix of its variables; empty: the only one
    std::vector<Square> basis;    ///< of d matrices, n x n
    Eigen::MatrixXd coordinates;  ///< d x n^2: of a matrix of the algebra, row by row
    int n = 0, d = 0;
    int entry = 0, coordinate = 0;  ///< the first of its entries and of its coordinates in a product
    StructureConstants constants;
    std::optional<RotationAlgebra> rotations;  ///< where the algebra is so(3)
    bool isAbelian = false;

    Square hat(const Vector& x) const;
    Square exponential(const Vector& x) const;
    Vector coordinatesOf(const Square& X) const;
    /// Ad_g, given g and its inverse: column a has the coordinates of g E_a g^-1.
    Matrix adjoint(const Square& g, const Square& inverse) const;
    /// xi with exp(hat xi) = g, by Newton's method from a guess near it; the guess where it does not
    /// converge.
    Vector logarithm(const Square& g, const Vector& near) const;

private:
    void addBrackets(const std::string& pointer);
    void recognise();
};

}  // namespace extremal
