// SPDX-License-Identifier: GPL-3.0-or-later
/// A group given by its basis (group/matrix_group.hpp), as LieStep sees it: its chart (data_chart.hpp), and
/// poses of the entries of g with the momentum J in space. What does not fit on the stack, because a product
/// has as many factors as it likes, is room of this object, which belongs to one integrator.
///
/// Where a force has taken the impulse W (a momentum at the base point) the momenta at the ends satisfy
/// J_end = J_base - Ad_{g_base^-1}^T W, and in the body mu = Ad_g^T J.
///
/// Points on spheres (model/group/spheres.hpp) are rotations from a frame at each point, in the chart of the
/// symmetric space. With xi normal to e_3 in the frame, x = R exp(hat xi) e_3 covers the sphere around R e_3,
/// and does so by shortest lines: S^2 = SO(3)/SO(2) with so(3) = h + m, [m, m] in h, xi in m. The equations
/// along h are xi_3 = 0; those along m are the ones of the group, since momenta have no part along h. A
/// variation by a rotation about the base point is one that the equations along m cover, so that nothing is
/// lost. Of a pose g is the frames, and J is pi.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "engine/family/lie/data_chart.hpp"
#include "engine/group/group_invariants.hpp"
#include "engine/model/group/group_mechanics.hpp"
#include "engine/model/group/spheres.hpp"

namespace extremal {

struct GroupPose {
    MatrixGroup::Entries g;
    MatrixGroup::Vector J;
};

class DataGroup {
public:
    static constexpr int n = Eigen::Dynamic;
    using Mechanics = GroupMechanics;
    using Pose = GroupPose;
    using Vector = MatrixGroup::Vector;
    using Matrix = MatrixGroup::Matrix;
    using Element = MatrixGroup::Entries;
    using Given = MatrixGroup::Given;
    template <int K>
    using Chart = DataChart<K>;

    explicit DataGroup(const GroupMechanics& mechanics)
        : group_(mechanics.group), invariants_(mechanics.invariants), isotropy_(mechanics.isotropy) {}

    /// Unknowns that stay 0.
    const std::vector<int>& isotropy() const { return isotropy_; }
    bool isOnSpheres() const { return !isotropy_.empty(); }

    int dimension() const { return group_->dimension(); }
    const MatrixGroup& group() const { return *group_; }
    template <int K>
    Chart<K> chart(Given xi) const {
        Chart<K> made(*group_);
        made.place(xi);
        return made;
    }

    const GroupPose& read(const double* x) const {
        GroupPose& pose = room_.pose;
        pose.g.resize(group_->entries());
        if (isOnSpheres()) {
            for (int k = 0; k < dimension(); k += 3) spheres::frameAt(x + k, pose.g.data() + 3 * k);
            pose.J = Eigen::Map<const Vector>(x + dimension(), dimension());
        } else {
            pose.g = Eigen::Map<const Element>(x, group_->entries());
            pose.J = Eigen::Map<const Vector>(x + group_->entries() + dimension(), dimension());
        }
        return pose;
    }
    void write(const GroupPose& p, double* x) const {
        if (isOnSpheres()) {
            spheres::pointsOf(p.g, x);
            Eigen::Map<Vector>(x + dimension(), dimension()) = p.J;
            return;
        }
        Eigen::Map<Element>(x, group_->entries()) = p.g;
        Eigen::Map<Vector>(x + group_->entries(), dimension()) = bodyMomentum(p.g, p);
        Eigen::Map<Vector>(x + group_->entries() + dimension(), dimension()) = p.J;
    }
    static const Element& element(const GroupPose& p) { return p.g; }
    template <int K>
    const Element& times(const Element& g, const Chart<K>& at) const {
        group_->moved(g, at.xi(), room_.element);
        return room_.element;
    }
    /// mu = Ad_g^T J.
    const Vector& bodyMomentum(const Element& g, const GroupPose& p) const {
        group_->inBody(g, p.J, room_.momentum);
        return room_.momentum;
    }
    Vector precession(const Vector& m, const Vector& u) const { return group_->coadjoint(u, m); }

    static Vector corrected(const Vector& xi, const Vector& change) { return xi + change; }
    /// Takes g back to the group, from which round-off takes it away by 1e-14 in so many steps.
    void settle(GroupPose& p, long long node) const {
        constexpr long long often = 100;
        if (isOnSpheres()) return makeNormal(p);
        if (node % often == often - 1) invariants_->cure(p.g);
    }
    /// The series have no digits left.
    bool isBeyond(Given xi) const { return !(group_->adNorm(xi) <= 5); }
    Vector coordinates(const GroupPose& base, const GroupPose& place, const Vector& near) const {
        return group_->logarithm(group_->product(group_->inverse(base.g), place.g), near);
    }

    /// Adds `weight` times the momenta m, in the frames of spheres, to momenta in space.
    void addInSpace(const Element& g, const Vector& m, double weight, Vector& to) const {
        for (int k = 0; k < dimension(); k += 3)
            to.segment<3>(k) += weight * (spheres::frameOf(g, k) * m.segment<3>(k));
    }
    /// The xi without isotropy whose rotation carries e_3 where g carries it, on spheres.
    template <class V>
    void horizontal(const Element& g, V&& xi) const {
        xi.setZero();
        for (int k = 0; k < dimension(); k += 3) {
            const double x = g(3 * k + 2), y = g(3 * k + 5), z = g(3 * k + 8), sine = std::hypot(x, y);
            const double ratio = sine > 0 ? std::atan2(sine, z) / sine : 1;
            xi(k) = -ratio * y;
            xi(k + 1) = ratio * x;
        }
    }

    const GroupPose& place(const GroupPose& p, const Element& g, Given xi) const {
        group_->moved(g, xi, room_.pose.g);
        room_.pose.J = p.J;
        return room_.pose;
    }
    void carry(const GroupPose& base, const Element& g, const Vector& W, GroupPose& end) const {
        end.J = base.J - inSpace(g, W);
    }

private:
    /// Takes pi . x away from x: what round-off and the last correction of Newton's method leave of it comes
    /// from x and is mostly of one sign, and taken from pi it would add up in momenta that are kept, 1.3e-16
    /// a step. Where pi is so small that x would go further than that, it is taken from pi.
    static void makeNormal(GroupPose& p) {
        bool isSmall = false;
        for (Eigen::Index k = 0; k < p.J.size(); k += 3) {
            const Eigen::Vector3d pi = p.J.segment<3>(k);
            double* const g = p.g.data() + 3 * k;
            const double along = pi(0) * g[2] + pi(1) * g[5] + pi(2) * g[8], square = pi.squaredNorm();
            if (along == 0) continue;
            if (!(along * along <= 1e-24 * square)) {
                isSmall = true;
                continue;
            }
            for (int i = 0; i < 3; ++i) g[3 * i + 2] -= along / square * pi(i);
        }
        if (isSmall) spheres::removeAlongPoints(p.g, p.J);
    }
    /// Ad_{g^-1}^T W.
    const Vector& inSpace(const Element& g, const Vector& W) const {
        if (W.isZero(0))
            room_.momentum = W;
        else
            group_->inSpace(g, W, room_.momentum);
        return room_.momentum;
    }
    std::shared_ptr<const MatrixGroup> group_;
    std::shared_ptr<const GroupInvariants> invariants_;
    std::vector<int> isotropy_;
    /// Of results: each is valid until the same function is called again.
    struct Room {
        Element element;
        Vector momentum;
        GroupPose pose;
    };
    mutable Room room_;
};

}  // namespace extremal
