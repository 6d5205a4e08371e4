// SPDX-License-Identifier: GPL-3.0-or-later
/// Points on spheres, moved by a Lagrangian that is typed in their places and velocities: the part of a
/// problem.
///
/// A rotation R carries e_3 to the point x = R e_3, and with the velocity eta in the body
///     x' = R (eta x e_3) = eta_2 R e_1 - eta_1 R e_2.
/// So L(x, x') is one on SO(3)^N that rotations about the points leave as it is (GroupMechanics::isotropy).
/// The velocity about the point is held at 0: of all rotations that carry the point these are the ones that
/// do no more, and which of the frames R stands at the point does not matter. There is no chart of the whole
/// sphere, and hence no pole.
///
/// The state of a run is x, three entries of each sphere, then pi = x x dL/dx', likewise, with pi . x = 0.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "engine/group/so3.hpp"
#include "engine/model/group/group_mechanics.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct Spheres {
    static constexpr PartInfo part{"spheres", "points on spheres"};
    std::vector<std::string> names;
    std::shared_ptr<const GroupMechanics> mechanics;  ///< on SO(3)^N
};

namespace spheres {

/// R, row by row, with R e_3 = x / |x|. Not continuous in x, as it cannot be.
inline void frameAt(const double* x, double* R) {
    using Three = Eigen::Vector3d;
    const Three e3 = Eigen::Map<const Three>(x).normalized();
    Eigen::Index least = 0;
    e3.cwiseAbs().minCoeff(&least);
    const Three e1 = (Three::Unit(least) - e3(least) * e3).normalized();
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> frame(R);
    frame.col(0) = e1;
    frame.col(1) = so3::cross(e3, e1);
    frame.col(2) = e3;
}

using Frame = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
/// R of the sphere whose entries begin at k = 0, 3, 6, .. in (x, pi).
inline Frame frameOf(const MatrixGroup::Entries& g, int k) { return Frame(g.data() + 3 * k); }

/// Frames at all points of a state.
inline void framesAt(const GroupMechanics& on, const double* x, MatrixGroup::Entries& g) {
    g.resize(on.group->entries());
    for (int k = 0; k < on.dimension(); k += 3) frameAt(x + k, g.data() + 3 * k);
}
inline MatrixGroup::Entries framesAt(const GroupMechanics& on, const double* x) {
    MatrixGroup::Entries g;
    framesAt(on, x, g);
    return g;
}

/// R^T pi of each sphere, in frames g.
inline void bodyMomenta(const MatrixGroup::Entries& g, const double* pi, MatrixGroup::Vector& mu) {
    mu.resize(g.size() / 3);
    for (int k = 0; k < mu.size(); k += 3)
        mu.segment<3>(k) = frameOf(g, k).transpose() * Eigen::Map<const Eigen::Vector3d>(pi + k);
}

/// The points R e_3, of length 1.
inline void pointsOf(const MatrixGroup::Entries& g, double* x) {
    for (Eigen::Index k = 0; k < g.size(); k += 9, x += 3) {
        const double scale = 1 / std::hypot(g(k + 2), g(k + 5), g(k + 8));
        for (int i = 0; i < 3; ++i) x[i] = scale * g(k + 3 * i + 2);
    }
}

/// Takes from each momentum what it has along its point. It stays round-off only if it is taken away in every
/// step: the equations see the part of a momentum normal to the point where a step ends, and a rest along x
/// grows by 1/(x_0 . x_1) from step to step.
inline void removeAlongPoints(const MatrixGroup::Entries& g, MatrixGroup::Vector& J) {
    for (Eigen::Index k = 0; k < J.size(); k += 3) {
        const Eigen::Vector3d x(g(3 * k + 2), g(3 * k + 5), g(3 * k + 8));
        J.segment<3>(k) -= J.segment<3>(k).dot(x) / x.squaredNorm() * x;
    }
}

}  // namespace spheres
}  // namespace extremal
