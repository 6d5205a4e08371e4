// SPDX-License-Identifier: GPL-3.0-or-later
/// A group given by its basis (group/matrix_group.hpp), as LieStep sees it: the chart by sweeps of brackets,
/// and poses of the entries of g with the momentum J in space.
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

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "engine/group/algebra_series.hpp"
#include "engine/group/group_invariants.hpp"
#include "engine/model/group/group_mechanics.hpp"
#include "engine/model/group/spheres.hpp"

namespace extremal {

/// The chart at xi. K = 2: second derivatives, to the accuracy of a Jacobian.
template <int K>
class DataChart {
public:
    using Vector = MatrixGroup::Vector;
    using Matrix = MatrixGroup::Matrix;

    DataChart(const MatrixGroup& group, const Vector& xi)
        : group_(group),
          xi_(xi),
          terms_(series::termsFor(group.adNorm(xi), 0.1 * std::numeric_limits<double>::epsilon())) {}

    const Vector& xi() const { return xi_; }

    Vector rotateBack(const Vector& v) const {
        return series::exponential(v, terms_, [&](const Vector& y) -> Vector { return -bracket(y); });
    }
    Vector rotateMomentum(const Vector& m) const {
        return series::exponential(m, terms_, [&](const Vector& y) -> Vector { return -coadjoint(y); });
    }
    Vector rotateMomentumBack(const Vector& m) const {
        return series::exponential(m, terms_, [&](const Vector& y) -> Vector { return coadjoint(y); });
    }
    Vector dexp(const Vector& v) const {
        return series::phi(v, terms_, [&](const Vector& y) -> Vector { return -bracket(y); });
    }
    Vector dexpTransposed(const Vector& m) const {
        return series::phi(m, terms_, [&](const Vector& y) -> Vector { return -coadjoint(y); });
    }
    Vector dexpRightTransposed(const Vector& m) const {
        return series::phi(m, terms_, [&](const Vector& y) -> Vector { return coadjoint(y); });
    }
    Matrix dexpMatrix() const {
        Matrix A(d(), d());
        for (int k = 0; k < d(); ++k) A.col(k) = dexp(Vector::Unit(d(), k));
        return A;
    }
    /// The matrix direction -> D_xi [dexp(xi)^T m] . direction (m fixed), and that of dexp(-xi)^T m.
    Matrix derivativeOfTransposed(const Vector& m) const { return slopesOfPull(m, 1); }
    Matrix derivativeOfRightTransposed(const Vector& m) const { return slopesOfPull(m, -1); }

    /// eta = dexp(xi) v; keeps the sweep for what follows.
    Vector sweep(const Vector& v) {
        Vector eta = Vector::Zero(d());
        double factorial = 1;
        for (int n = 0; n < terms_; ++n) {
            w_[at(n)] = n == 0 ? v : Vector(-bracket(w_[at(n - 1)]));
            factorial *= n + 1;
            eta += w_[at(n)] / factorial;
        }
        return eta;
    }
    /// dexp(xi)^T m, and (D_xi eta)^T m, of the curve of the last sweep.
    void pull(const Vector& m, Vector& forXi, Vector& forV) {
        sweepBack(m, 1, lambda_);
        forV = lambda_[0];
        forXi = Vector::Zero(d());
        for (int n = 0; n + 1 < terms_; ++n) forXi += group_.coadjoint(w_[at(n)], lambda_[at(n + 1)]);
    }
    struct Derivatives {
        Matrix A, D;  ///< dexp(xi), and that of dexp(xi) v by xi
        Matrix B, H;  ///< of dexp(xi)^T m by xi, and the second ones of m . dexp(xi) v
    };
    /// Of the curve of the last sweep and the momentum of the last pull.
    Derivatives derivatives() const {
        Derivatives r;
        r.A = dexpMatrix();
        r.B = derivativeOfTransposed(lambdaSource());
        r.D = r.H = Matrix::Zero(d(), d());
        for (int k = 0; k < d(); ++k) {
            std::array<Vector, series::mostTerms> slopes;
            slopesBack(lambda_, k, 1, slopes);
            Vector dw = Vector::Zero(d());
            double factorial = 1;
            for (int n = 0; n < terms_; ++n) {
                factorial *= n + 1;
                r.D.col(k) += dw / factorial;
                if (n + 1 == terms_) break;
                r.H.col(k) +=
                    group_.coadjoint(dw, lambda_[at(n + 1)]) + group_.coadjoint(w_[at(n)], slopes[at(n + 1)]);
                dw = (-group_.bracketOfBasis(k, w_[at(n)]) - bracket(dw)).eval();
            }
        }
        return r;
    }

private:
    using Sweep = std::array<Vector, series::mostTerms>;
    static std::size_t at(int n) { return static_cast<std::size_t>(n); }
    int d() const { return group_.dimension(); }
    Vector bracket(const Vector& y) const { return group_.bracket(xi_, y); }
    Vector coadjoint(const Vector& m) const { return group_.coadjoint(xi_, m); }
    /// The last of the lambda is m / N!.
    Vector lambdaSource() const {
        double factorial = 1;
        for (int n = 2; n <= terms_; ++n) factorial *= n;
        return lambda_[at(terms_ - 1)] * factorial;
    }
    /// lambda_n = m/(n+1)! - sign ad^T lambda_{n+1}.
    void sweepBack(const Vector& m, double sign, Sweep& lambda) const {
        double factorial = 1;
        for (int n = 2; n <= terms_; ++n) factorial *= n;
        for (int n = terms_ - 1; n >= 0; --n) {
            lambda[at(n)] = m / factorial;
            factorial /= n + 1;
            if (n + 1 < terms_) lambda[at(n)] -= sign * coadjoint(lambda[at(n + 1)]);
        }
    }
    /// The derivatives of the lambda along basis vector k.
    void slopesBack(const Sweep& lambda, int k, double sign, Sweep& slopes) const {
        slopes[at(terms_ - 1)] = Vector::Zero(d());
        for (int n = terms_ - 2; n >= 0; --n)
            slopes[at(n)] =
                -sign * (group_.coadjointOfBasis(k, lambda[at(n + 1)]) + coadjoint(slopes[at(n + 1)]));
    }
    Matrix slopesOfPull(const Vector& m, double sign) const {
        Sweep lambda, slopes;
        sweepBack(m, sign, lambda);
        Matrix B(d(), d());
        for (int k = 0; k < d(); ++k) {
            slopesBack(lambda, k, sign, slopes);
            B.col(k) = slopes[0];
        }
        return B;
    }

    const MatrixGroup& group_;
    Vector xi_;
    int terms_;
    Sweep w_, lambda_;
};

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
    Chart<K> chart(const Vector& xi) const {
        return Chart<K>(*group_, xi);
    }

    GroupPose read(const double* x) const {
        if (isOnSpheres()) {
            GroupPose pose{Element(group_->entries()),
                           Eigen::Map<const Vector>(x + dimension(), dimension())};
            for (int k = 0; k < dimension(); k += 3) spheres::frameAt(x + k, pose.g.data() + 3 * k);
            return pose;
        }
        return {Eigen::Map<const Element>(x, group_->entries()),
                Eigen::Map<const Vector>(x + group_->entries() + dimension(), dimension())};
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
    static Element element(const GroupPose& p) { return p.g; }
    template <int K>
    Element times(const Element& g, const Chart<K>& at) const {
        return group_->product(g, group_->exponential(at.xi()));
    }
    /// mu = Ad_g^T J.
    Vector bodyMomentum(const Element& g, const GroupPose& p) const {
        return group_->adjoint(g, group_->inverse(g)).transpose().lazyProduct(p.J);
    }
    Matrix precessionMatrix(const Vector& m) const {
        Matrix r(dimension(), dimension());
        for (int k = 0; k < dimension(); ++k) r.col(k) = group_->coadjointOfBasis(k, m);
        return r;
    }
    Vector precession(const Vector& m, const Vector& u) const { return group_->coadjoint(u, m); }

    static Vector corrected(const Vector& xi, const Vector& change) { return xi + change; }
    /// Takes g back to the group, from which round-off takes it away by 1e-14 in so many steps.
    void settle(GroupPose& p, long long node) const {
        constexpr long long often = 100;
        if (isOnSpheres()) return spheres::removeAlongPoints(p.g, p.J);
        if (node % often == often - 1) invariants_->cure(p.g);
    }
    /// The series have no digits left.
    bool isBeyond(const Vector& xi) const { return !(group_->adNorm(xi) <= 5); }
    Vector coordinates(const GroupPose& base, const GroupPose& place, const Vector& near) const {
        return group_->logarithm(group_->product(group_->inverse(base.g), place.g), near);
    }

    /// The xi without isotropy whose rotation carries e_3 where g carries it, on spheres.
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

    GroupPose place(const GroupPose& p, const Element& g, const Vector& xi) const {
        return {group_->product(g, group_->exponential(xi)), p.J};
    }
    void carry(const GroupPose& base, const Element& g, const Vector& W, GroupPose& end) const {
        end.J = base.J - inSpace(g, W);
    }
    void fetch(GroupPose& base, const Element& g, const Vector& W, const GroupPose& end) const {
        base.J = end.J + inSpace(g, W);
    }

private:
    /// Ad_{g^-1}^T W.
    Vector inSpace(const Element& g, const Vector& W) const {
        if (W.isZero(0)) return Vector::Zero(dimension());
        return group_->adjoint(group_->inverse(g), g).transpose().lazyProduct(W);
    }
    std::shared_ptr<const MatrixGroup> group_;
    std::shared_ptr<const GroupInvariants> invariants_;
    std::vector<int> isotropy_;
};

}  // namespace extremal
