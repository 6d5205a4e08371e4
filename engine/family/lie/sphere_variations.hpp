// SPDX-License-Identifier: GPL-3.0-or-later
/// Variations of points on spheres, and those of the frames that carry them.
///
/// In the frame F at a point x (spheres::frameAt) a variation is dx = F (zeta x e_3) with zeta_3 = 0, and
/// dmu the change of the momentum F^T pi in the frame that is carried along without turning about its point:
/// (zeta_1, zeta_2) of all spheres and then (mu_1, mu_2) are canonical coordinates of the cotangent bundle at
/// x, since mu . [zeta, zeta'] = 0. A step has frames of its own at its end, which may have turned about
/// their points; that is taken back.
#pragma once

#include <vector>

#include "engine/family/lie/data_group.hpp"

namespace extremal::spheres {

/// (zeta, dmu) on SO(3)^N from `columns` columns of 4 N numbers.
inline std::vector<double> variationsOfFrames(const double* w, int N, int columns) {
    std::vector<double> wide(static_cast<std::size_t>(6 * N * columns), 0);
    for (int c = 0; c < columns; ++c)
        for (int k = 0; k < 2 * N; ++k) {
            double* const to = wide.data() + 6 * N * c + 3 * k;  // N of zeta, and then N of mu
            to[0] = w[4 * N * c + 2 * k];
            to[1] = w[4 * N * c + 2 * k + 1];
        }
    return wide;
}

/// The opposite, at the pose where a step has ended.
inline void variationsOfPoints(const GroupPose& end, const std::vector<double>& wide, int N, int columns,
                               double* w) {
    using Three = Eigen::Vector3d;
    for (int k = 0; k < N; ++k) {
        const Frame R = frameOf(end.g, 3 * k);
        const Three x = R.col(2), mu = R.transpose() * end.J.segment<3>(3 * k);
        Eigen::Matrix<double, 3, 3, Eigen::RowMajor> own;
        frameAt(x.data(), own.data());
        const Eigen::Matrix3d turn = own.transpose() * R;
        for (int c = 0; c < columns; ++c) {
            const double* const from = wide.data() + 6 * N * c + 3 * k;
            const double about = from[2];
            const Three zeta = turn * Three(from[0], from[1], 0),
                        dmu = turn * Three(from[3 * N] - about * mu(1), from[3 * N + 1] + about * mu(0), 0);
            double* const to = w + 4 * N * c + 2 * k;
            to[0] = zeta(0);
            to[1] = zeta(1);
            to[2 * N] = dmu(0);
            to[2 * N + 1] = dmu(1);
        }
    }
}

}  // namespace extremal::spheres
