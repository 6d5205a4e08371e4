// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lagrangian of a group that is given as data, in the natural chart at a base point, and the first guess
/// of its step: what chart_lagrangian.hpp and lie_guess.hpp are for rigid bodies.
///
/// With A = dexp(xi), eta = A v, D = D_xi eta and the derivatives m, f, M, N, S of L (group_mechanics.hpp):
///     l_xi = D^T m + A^T f,   l_v = A^T m,
///     l_vv = A^T M A,   l_v,xi = D_xi(A^T m) + A^T (M D + N A),
///     l_xi,xi = m . D2_xi eta + D^T (M D + N A) + D_xi(A^T f) + A^T (S A + N^T D).
#pragma once

#include <vector>

#include "engine/family/lie/chart_lagrangian.hpp"
#include "engine/family/lie/data_group.hpp"
#include "engine/family/lie/lie_guess.hpp"

namespace extremal {

template <>
struct ChartLagrangian<double, DataGroup> {
    using Vector = DataGroup::Vector;
    using Matrix = DataGroup::Matrix;
    static constexpr bool isMixed = true;
    static constexpr bool hasSpaceForm = false;

    explicit ChartLagrangian(const GroupMechanics& mechanics) : mechanics_(mechanics) {}
    bool isFree() const { return mechanics_.isInvariant; }

    template <int K>
    void gradient(DataChart<K>& at, const Vector& v, Vector& forXi, Vector& forV) const {
        const Vector eta = at.sweep(v);
        Vector m(eta.size());
        double value = 0;
        mechanics_.gradient(mechanics_.model.get(), nullptr, eta.data(), &value, m.data(), nullptr);
        at.pull(m, forXi, forV);
    }
    template <int K>
    Vector gradient(const MatrixGroup::Entries& g, DataChart<K>& at, const Vector& v, Vector& forXi,
                    Vector& forV) const {
        const Vector eta = at.sweep(v);
        Vector m(eta.size()), f(eta.size());
        double value = 0;
        mechanics_.gradient(mechanics_.model.get(), g.data(), eta.data(), &value, m.data(), f.data());
        at.pull(m, forXi, forV);
        forXi += at.dexpTransposed(f);
        return f;
    }
    Vector force(const MatrixGroup::Entries& g, const DataChart<0>& at, const Vector& v) const {
        const Vector eta = at.dexp(v);
        Vector m(eta.size()), f(eta.size());
        double value = 0;
        mechanics_.gradient(mechanics_.model.get(), g.data(), eta.data(), &value, m.data(), f.data());
        return f;
    }

    struct Second {
        Matrix xiXi, vXi, vv, A;
    };
    /// The force and its slopes at a node, with what a node moves by.
    struct ForceSlope {
        Vector f;
        Matrix A, D, S, N;
    };
    Second second(DataChart<2>& at, const Vector& v) const {
        ForceSlope unused;
        return second(nullptr, at, v, unused);
    }
    Second second(const MatrixGroup::Entries& g, DataChart<2>& at, const Vector& v, ForceSlope& F) const {
        return second(g.data(), at, v, F);
    }
    ForceSlope forceSlope(const MatrixGroup::Entries& g, DataChart<2>& at, const Vector& v) const {
        ForceSlope F;
        second(g.data(), at, v, F);
        return F;
    }

    template <class Columns>
    double floor(const Columns&) const {
        return std::numeric_limits<double>::epsilon() * spread_;
    }
    /// L at g with eta, and its gradient by (xi, v).
    double value(const MatrixGroup::Entries& g, const Vector& eta) const {
        Vector m(eta.size());
        double result = 0;
        mechanics_.gradient(mechanics_.model.get(), g.data(), eta.data(), &result, m.data(), nullptr);
        return result;
    }

private:
    Second second(const double* g, DataChart<2>& at, const Vector& v, ForceSlope& F) const {
        const Vector eta = at.sweep(v);
        const auto d = eta.size();
        Vector m(d), forXi, forV;
        Matrix M(d, d);
        double L = 0;
        if (g) {
            F.f.resize(d);
            F.N.resize(d, d);
            F.S.resize(d, d);
        }
        mechanics_.jet(mechanics_.model.get(), g, eta.data(), &L, m.data(), g ? F.f.data() : nullptr,
                       M.data(), g ? F.N.data() : nullptr, g ? F.S.data() : nullptr);
        const auto rows = M.diagonal().cwiseAbs();
        spread_ = rows.minCoeff() > 0 ? rows.maxCoeff() / rows.minCoeff() : 1;
        at.pull(m, forXi, forV);
        auto chart = at.derivatives();
        Second s;
        const Matrix MA = M.lazyProduct(chart.A);
        Matrix change = M.lazyProduct(chart.D);  // of m with xi
        s.vv = chart.A.transpose().lazyProduct(MA);
        s.xiXi = chart.H;
        if (g) {
            change += F.N.lazyProduct(chart.A);
            const Matrix ofForce = F.S.lazyProduct(chart.A) + F.N.transpose().lazyProduct(chart.D);
            s.xiXi += at.derivativeOfTransposed(F.f) + chart.A.transpose().lazyProduct(ofForce);
        }
        s.vXi = chart.B + chart.A.transpose().lazyProduct(change);
        s.xiXi += chart.D.transpose().lazyProduct(change);
        s.A = chart.A;
        F.A = chart.A;
        F.D = chart.D;
        return s;
    }

    GroupMechanics mechanics_;
    mutable double spread_ = 1;  ///< of the inertias, at the last Jacobian
};

/// The classical Runge-Kutta method on (xi, mu) in the chart at the start:
///     xi' = dexp(xi)^-1 eta,   mu' = ad_eta^T mu + f,   dL/deta = mu.
template <>
class StepGuess<double, DataGroup> {
public:
    using Vector = DataGroup::Vector;

    static Vector coordinates(const DataGroup& group, const GroupPose& base, const GroupPose& place,
                              const Vector& near) {
        return group.coordinates(base, place, near);
    }
    /// eta of a momentum in the body.
    static Vector rate(const GroupMechanics& mechanics, const MatrixGroup::Entries& g, const Vector& mu) {
        Vector eta = Vector::Zero(mu.size());
        mechanics.velocity(mechanics.model.get(), g.data(), mu.data(), eta.data());
        return eta;
    }

    StepGuess(const DataGroup& group, const GroupMechanics& mechanics, int points)
        : group_(group), mechanics_(mechanics), xi_(static_cast<std::size_t>(points + 1)) {}

    /// Coordinates, seen from the base, of the curve at the times from the known end on.
    template <class Columns>
    void curve(const GroupPose& known, const Vector& mu, const std::vector<double>& times, double step,
               bool isAdjoint, Columns& points) {
        curveInGroup(known, mu, times, step, isAdjoint && !group_.isOnSpheres(), points);
        if (group_.isOnSpheres()) putOnSpheres(isAdjoint, static_cast<Eigen::Index>(times.size()), points);
    }
    /// False where there is no motion at the start: in a singularity.
    bool isRateFinite() const { return isFound_; }

private:
    struct Move {
        Vector xi, mu;
    };
    template <class Columns>
    void curveInGroup(const GroupPose& known, const Vector& mu, const std::vector<double>& times, double step,
                      bool isAdjoint, Columns& points) {
        const auto count = static_cast<int>(times.size());
        start_ = known.g;
        isFound_ = true;
        Move at{Vector::Zero(mu.size()), mu};
        xi_[0] = at.xi;
        for (int k = 0; k < count; ++k) {
            const auto i = static_cast<std::size_t>(k);
            at = after(at, (times[i] - (k > 0 ? times[i - 1] : 0)) * step);
            xi_[i + 1] = at.xi;
        }
        const MatrixGroup& g = group_.group();
        for (int k = 0; k < count; ++k) {
            const auto i = static_cast<std::size_t>(k + 1);
            if (!isAdjoint) {
                points.col(k) = xi_[i];
                continue;
            }
            const Vector &last = xi_.back(), &other = xi_[static_cast<std::size_t>(count) - i];
            points.col(k) =
                g.logarithm(g.product(g.exponential(-last), g.exponential(other)), Vector(other - last));
        }
    }
    /// The guess of the group, seen on the spheres: the frame at its end has turned about the point.
    template <class Columns>
    void putOnSpheres(bool isAdjoint, Eigen::Index count, Columns& points) {
        const MatrixGroup& group = group_.group();
        if (!isAdjoint) {
            for (Eigen::Index k = 0; k < count; ++k)
                points.col(k) = group_.horizontal(group.exponential(points.col(k)));
            return;
        }
        // The base is where the curve ends, and its frame is that of the known end carried there.
        guessed_ = points;
        const Vector back = -group_.horizontal(group.exponential(guessed_.col(count - 1)));
        for (Eigen::Index k = 0; k + 1 < count; ++k)
            points.col(k) = group_.horizontal(
                group.product(group.exponential(back), group.exponential(guessed_.col(count - 2 - k))));
        points.col(count - 1) = back;
    }
    Move rate(const Move& at) {
        const MatrixGroup& group = group_.group();
        Vector eta(at.mu.size()), m(at.mu.size()), f = Vector::Zero(at.mu.size());
        MatrixGroup::Entries g;
        if (!mechanics_.isInvariant) g = group.product(start_, group.exponential(at.xi));
        const bool isFound = mechanics_.velocity(mechanics_.model.get(), g.data(), at.mu.data(), eta.data());
        double value = 0;
        if (isFound && !mechanics_.isInvariant)
            mechanics_.gradient(mechanics_.model.get(), g.data(), eta.data(), &value, m.data(), f.data());
        if (at.xi.isZero(0)) isFound_ = isFound_ && isFound && f.allFinite();
        return {series::inverseOfDexp(group, at.xi, eta), group.coadjoint(eta, at.mu) + f};
    }
    Move after(const Move& at, double t) {
        const auto along = [](const Move& from, double s, const Move& slope) -> Move {
            return {from.xi + s * slope.xi, from.mu + s * slope.mu};
        };
        const Move k1 = rate(at), k2 = rate(along(at, t / 2, k1)), k3 = rate(along(at, t / 2, k2)),
                   k4 = rate(along(at, t, k3));
        return along(along(along(along(at, t / 6, k1), t / 3, k2), t / 3, k3), t / 6, k4);
    }

    DataGroup group_;
    GroupMechanics mechanics_;
    MatrixGroup::Entries start_;
    std::vector<Vector> xi_;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic> guessed_;
    bool isFound_ = true;
};

}  // namespace extremal
