// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/group/rotation_algebra.hpp"

#include <Eigen/Cholesky>

#include <cmath>

#include "engine/core/algebra/dense.hpp"

namespace extremal {
namespace {

using Three = Eigen::Matrix3d;

/// Axes, and two vectors that are none: an identity of degree 3 in y that holds there holds everywhere, but
/// for accidents.
const Eigen::Vector3d probes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.6, -0.3, 0.5}, {-0.2, 0.7, 0.4}};

RotationAlgebra::Spin spinOf(const std::vector<Eigen::MatrixXd>& own) {
    bool isOne = true, isHalf = true;
    for (const Eigen::Vector3d& y : probes) {
        const Eigen::MatrixXd X = y(0) * own[0] + y(1) * own[1] + y(2) * own[2], square = X.lazyProduct(X),
                              cube = square.lazyProduct(X);
        const double x = y.squaredNorm(), size = X.norm(), roundOff = 1e-12 * (1 + size * size) * size;
        isOne = isOne && (cube + x * X).norm() <= roundOff;
        isHalf =
            isHalf && (square + x / 4 * Eigen::MatrixXd::Identity(X.rows(), X.cols())).norm() <= roundOff;
    }
    return isOne    ? RotationAlgebra::Spin::one
           : isHalf ? RotationAlgebra::Spin::half
                    : RotationAlgebra::Spin::other;
}

}  // namespace

std::optional<RotationAlgebra> rotationAlgebraOf(const std::vector<Three>& ad,
                                                 const std::vector<Eigen::MatrixXd>& basis) {
    if (ad.size() != 3) return {};
    Three form;  // minus half of the Killing form
    for (Eigen::Index a = 0; a < 3; ++a)
        for (Eigen::Index b = 0; b < 3; ++b)
            form(a, b) =
                -ad[static_cast<std::size_t>(a)].lazyProduct(ad[static_cast<std::size_t>(b)]).trace() / 2;
    const auto eigen = dense::symmetricEigen<double>(form);
    if (!(eigen.values(0) > 1e-10 * eigen.values(2))) return {};
    RotationAlgebra r;
    // form = U^T U: with y = U x it is y . y.
    r.inverse = Eigen::LLT<Three>(form).matrixU();
    r.T = dense::inverse<double>(r.inverse);
    Three adFirst = Three::Zero();
    for (Eigen::Index a = 0; a < 3; ++a) adFirst += r.T(a, 0) * ad[static_cast<std::size_t>(a)];
    const Eigen::Vector3d third = r.inverse.lazyProduct(adFirst.lazyProduct(r.T.col(1)));  // [F_1, F_2] in F
    if (third(2) < 0) {
        r.T = -r.T;
        r.inverse = -r.inverse;
    }
    if ((r.T - Three::Identity()).norm() < 1e-14) {
        r.T = r.inverse = Three::Identity();
        r.isUsual = true;
    }
    std::vector<Eigen::MatrixXd> own(3, Eigen::MatrixXd::Zero(basis[0].rows(), basis[0].cols()));
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t a = 0; a < 3; ++a)
            own[k] += r.T(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(k)) * basis[a];
    r.spin = spinOf(own);
    return r;
}

}  // namespace extremal
