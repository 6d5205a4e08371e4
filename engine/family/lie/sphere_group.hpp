// SPDX-License-Identifier: GPL-3.0-or-later
/// Points on spheres (model/group/spheres.hpp), as LieStep sees them: rotations from a frame at each point,
/// in the chart of the symmetric space.
///
/// With xi normal to e_3 in the frame, x = R exp(hat xi) e_3 covers the sphere around R e_3, and does so by
/// shortest lines: S^2 = SO(3)/SO(2) with so(3) = h + m, [m, m] in h, xi in m. The equations along h are
/// xi_3 = 0; those along m are the ones of the group, since momenta have no part along h. A variation by a
/// rotation about the base point is one that the equations along m cover, so that nothing is lost. Of a pose
/// g is the frames, and J is pi.
#pragma once

#include <cmath>
#include <vector>

#include "engine/family/lie/data_lagrangian.hpp"
#include "engine/model/group/spheres.hpp"

namespace extremal {

class SphereGroup : public DataGroup {
public:
    explicit SphereGroup(const GroupMechanics& mechanics)
        : DataGroup(mechanics), isotropy_(mechanics.isotropy) {}

    /// Unknowns that stay 0.
    const std::vector<int>& isotropy() const { return isotropy_; }

    GroupPose read(const double* x) const {
        GroupPose pose{Element(group().entries()), Eigen::Map<const Vector>(x + dimension(), dimension())};
        for (int k = 0; k < dimension(); k += 3) spheres::frameAt(x + k, pose.g.data() + 3 * k);
        return pose;
    }
    void write(const GroupPose& p, double* x) const {
        spheres::pointsOf(p.g, x);
        Eigen::Map<Vector>(x + dimension(), dimension()) = p.J;
    }
    void settle(GroupPose& p, long long) const { spheres::removeAlongPoints(p.g, p.J); }

    /// The xi without isotropy whose rotation carries e_3 where g carries it.
    Vector horizontal(const Element& g) const {
        Vector xi = Vector::Zero(dimension());
        for (int k = 0; k < dimension(); k += 3) {
            const double x = g(3 * k + 2), y = g(3 * k + 5), z = g(3 * k + 8), sine = std::hypot(x, y);
            const double ratio = sine > 0 ? std::atan2(sine, z) / sine : 1;
            xi(k) = -ratio * y;
            xi(k + 1) = ratio * x;
        }
        return xi;
    }
    Vector coordinates(const GroupPose& base, const GroupPose& place, const Vector&) const {
        return horizontal(group().product(group().inverse(base.g), place.g));
    }

private:
    std::vector<int> isotropy_;
};

template <>
struct ChartLagrangian<double, SphereGroup> : ChartLagrangian<double, DataGroup> {
    using ChartLagrangian<double, DataGroup>::ChartLagrangian;
};

/// The guess of the group, seen on the spheres: the frame at its end has turned about the point.
template <>
class StepGuess<double, SphereGroup> : public StepGuess<double, DataGroup> {
public:
    StepGuess(const SphereGroup& group, const GroupMechanics& mechanics, int points)
        : StepGuess<double, DataGroup>(group, mechanics, points), spheres_(group) {}

    template <class Columns>
    void curve(const GroupPose& known, const Vector& mu, const std::vector<double>& times, double step,
               bool isAdjoint, Columns& points) {
        StepGuess<double, DataGroup>::curve(known, mu, times, step, false, points);
        const MatrixGroup& group = spheres_.group();
        const auto count = static_cast<Eigen::Index>(times.size());
        if (!isAdjoint) {
            for (Eigen::Index k = 0; k < count; ++k)
                points.col(k) = spheres_.horizontal(group.exponential(points.col(k)));
            return;
        }
        // The base is where the curve ends, and its frame is that of the known end carried there.
        guessed_ = points;
        const Vector back = -spheres_.horizontal(group.exponential(guessed_.col(count - 1)));
        for (Eigen::Index k = 0; k + 1 < count; ++k)
            points.col(k) = spheres_.horizontal(
                group.product(group.exponential(back), group.exponential(guessed_.col(count - 2 - k))));
        points.col(count - 1) = back;
    }

private:
    SphereGroup spheres_;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic> guessed_;
};

}  // namespace extremal
