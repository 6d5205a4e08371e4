// SPDX-License-Identifier: GPL-3.0-or-later
/// Algebras of dimension 3 that are so(3) in another basis, and their matrices: where closed forms hold.
///
/// The Killing form tr(ad_x ad_y) of so(3) is -2 x . y, and an algebra of dimension 3 whose form is negative
/// definite is so(3). A basis F that is orthonormal by minus half of it has [F_1, F_2] = F_3 in cyclic order
/// once its orientation is right. With x = T y the coordinates of the same vector in the given basis and in
/// F, ad_x is the vector product with y, and what group/so3.hpp has holds for y. No name decides: su(2) and
/// permuted, scaled or slanting bases are found as well as the usual one.
///
/// Matrices that represent spins 0 and 1 satisfy X^3 = -|y|^2 X and those of spin 1/2 satisfy X^2 = -|y|^2/4,
/// so that exp X = 1 + s X + a X^2 with the s and a of so3.hpp at |y|^2, or at |y|^2 / 4.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace extremal {

struct RotationAlgebra {
    Eigen::Matrix3d T, inverse;  ///< x = T y
    bool isUsual = false;        ///< T is 1
    enum class Spin { one, half, other };
    Spin spin = Spin::other;  ///< what the matrices represent: 0 and 1; 1/2 alone; anything else

    /// y from x and back; momenta pair with vectors, so that they go by the transposed matrices.
    template <class V>
    Eigen::Vector3d own(const V& x) const {
        return isUsual ? Eigen::Vector3d(x) : Eigen::Vector3d(inverse.lazyProduct(x));
    }
    template <class V>
    Eigen::Vector3d given(const V& y) const {
        return isUsual ? Eigen::Vector3d(y) : Eigen::Vector3d(T.lazyProduct(y));
    }
    template <class V>
    Eigen::Vector3d ownMomentum(const V& m) const {
        return isUsual ? Eigen::Vector3d(m) : Eigen::Vector3d(T.transpose().lazyProduct(m));
    }
    template <class V>
    Eigen::Vector3d givenMomentum(const V& m) const {
        return isUsual ? Eigen::Vector3d(m) : Eigen::Vector3d(inverse.transpose().lazyProduct(m));
    }
};

/// `ad`: of the three basis vectors; `basis`: their matrices. Nothing where the algebra is another one.
std::optional<RotationAlgebra> rotationAlgebraOf(const std::vector<Eigen::Matrix3d>& ad,
                                                 const std::vector<Eigen::MatrixXd>& basis);

}  // namespace extremal
