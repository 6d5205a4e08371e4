// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lagrangian of a group that is given as data, in the natural chart at a base point, and the first guess
/// of its step: what chart_lagrangian.hpp and lie_guess.hpp are for rigid bodies.
///
/// With A = dexp(xi), eta = A v, D = D_xi eta and the derivatives m, f, M, N, S of L (group_mechanics.hpp):
///     l_xi = D^T m + A^T f,   l_v = A^T m,
///     l_vv = A^T M A,   l_v,xi = D_xi(A^T m) + A^T (M D + N A),
///     l_xi,xi = m . D2_xi eta + D^T (M D + N A) + D_xi(A^T f) + A^T (S A + N^T D).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "engine/family/lie/chart_lagrangian.hpp"
#include "engine/family/lie/data_group.hpp"
#include "engine/family/lie/lie_guess.hpp"

namespace extremal {

template <>
struct ChartLagrangian<double, DataGroup> {
    using Vector = DataGroup::Vector;
    using PartMatrix = GroupFactor::Matrix;
    static constexpr bool isMixed = true;
    static constexpr bool hasSpaceForm = false;

    explicit ChartLagrangian(const GroupMechanics& mechanics) : mechanics_(mechanics) {}
    bool isFree() const { return mechanics_.isInvariant; }
    const Couplings& couplings() const { return *mechanics_.couplings; }

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

    /// L and its derivatives at a node, and those of the chart there.
    struct Node {
        std::shared_ptr<const Couplings> couplings;
        Vector m, f;
        std::vector<double> M, N, S;  ///< in the layout of the couplings; N and S empty where L is invariant
        std::vector<ChartDerivatives> charts;  ///< of each factor

        const ChartDerivatives& chart(int p) const { return charts[static_cast<std::size_t>(p)]; }
        bool isFree() const { return S.empty(); }
    };
    /// g: null where L is invariant.
    Node node(const double* g, DataChart<2>& at, const Vector& v) const {
        const Vector eta = at.sweep(v);
        const std::size_t entries = mechanics_.couplings->entries();
        Node n{mechanics_.couplings, Vector(eta.size()), {}, std::vector<double>(entries), {}, {}, {}};
        if (g) {
            n.f.resize(eta.size());
            n.N.resize(entries);
            n.S.resize(entries);
        }
        double L = 0;
        mechanics_.jet(mechanics_.model.get(), g, eta.data(), &L, n.m.data(), g ? n.f.data() : nullptr,
                       n.M.data(), g ? n.N.data() : nullptr, g ? n.S.data() : nullptr);
        keepSpread(n);
        Vector forXi, forV;
        at.pull(n.m, forXi, forV);
        n.charts.reserve(static_cast<std::size_t>(n.couplings->parts()));
        for (int p = 0; p < n.couplings->parts(); ++p) n.charts.push_back(at.part(p).derivatives());
        return n;
    }
    /// The second derivatives by (xi, v) of two factors.
    struct Second {
        PartMatrix xiXi, xiV, vXi, vv;
    };
    Second second(const Node& n, const DataChart<2>& at, const Couplings::Pair& pair) const {
        const Couplings& on = *n.couplings;
        const auto M = on.block(n.M.data(), pair);
        const ChartDerivatives &left = n.chart(pair.p), &right = n.chart(pair.q);
        const PartMatrix MA = M.lazyProduct(right.A);
        PartMatrix change = M.lazyProduct(right.D), changeOfOther = left.D.transpose().lazyProduct(M);
        Second s;
        s.vv = left.A.transpose().lazyProduct(MA);
        if (n.isFree()) {
            s.xiXi = left.D.transpose().lazyProduct(change);
        } else {
            const auto N = on.block(n.N.data(), pair), opposite = on.opposite(n.N.data(), pair);
            change += N.lazyProduct(right.A);
            changeOfOther += left.A.transpose().lazyProduct(opposite.transpose());
            PartMatrix ofForce = on.block(n.S.data(), pair).lazyProduct(right.A);
            ofForce += opposite.transpose().lazyProduct(right.D);
            s.xiXi = left.D.transpose().lazyProduct(change);
            s.xiXi += left.A.transpose().lazyProduct(ofForce);
        }
        s.vXi = left.A.transpose().lazyProduct(change);
        s.xiV = changeOfOther.lazyProduct(right.A);
        if (pair.p != pair.q) return s;
        s.xiXi += left.H;
        if (!n.isFree()) s.xiXi += at.part(pair.p).derivativeOfTransposed(part(n.f, on, pair.p));
        s.vXi += left.B;
        s.xiV += left.B.transpose();
        return s;
    }
    /// What (xi, v) of factor q do to the force on p, less the bracket with it.
    struct ForceBy {
        PartMatrix xi, v;
    };
    ForceBy forceBy(const Node& n, const Couplings::Pair& pair) const {
        const Couplings& on = *n.couplings;
        const ChartDerivatives& chart = n.chart(pair.q);
        const auto opposite = on.opposite(n.N.data(), pair);
        PartMatrix slope = on.block(n.S.data(), pair);
        if (pair.p == pair.q) {
            const GroupFactor& factor = mechanics_.group->factors()[static_cast<std::size_t>(pair.p)];
            const GroupFactor::Vector f = part(n.f, on, pair.p);
            for (int k = 0; k < factor.d; ++k) slope.col(k) -= factor.constants.coadjointOfBasis(k, f);
        }
        ForceBy by{slope.lazyProduct(chart.A), opposite.transpose().lazyProduct(chart.A)};
        by.xi += opposite.transpose().lazyProduct(chart.D);
        return by;
    }

    /// The same as matrices of the product, for a tangent map: A, D, S and N times a vector.
    struct ForceSlope {
        Node node;
        struct Coupled {
            const Couplings* on;
            const std::vector<double>* values;
            bool isTransposed = false;
            Coupled transpose() const { return {on, values, !isTransposed}; }
            Vector operator*(const Vector& x) const {
                return isTransposed ? on->transposedTimes(values->data(), x) : on->times(values->data(), x);
            }
        };
        struct Diagonal {
            const Node* node;
            PartMatrix ChartDerivatives::*of;
            bool isTransposed = false;
            Diagonal transpose() const { return {node, of, !isTransposed}; }
            Vector operator*(const Vector& x) const {
                const Couplings& on = *node->couplings;
                Vector y(x.size());
                for (int p = 0; p < on.parts(); ++p) {
                    const PartMatrix& block = node->chart(p).*of;
                    const auto own = x.segment(on.first(p), on.size(p));
                    if (isTransposed)
                        y.segment(on.first(p), on.size(p)) = block.transpose().lazyProduct(own);
                    else
                        y.segment(on.first(p), on.size(p)) = block.lazyProduct(own);
                }
                return y;
            }
        };
        const Vector& f() const { return node.f; }
        Diagonal A() const { return {&node, &ChartDerivatives::A}; }
        Diagonal D() const { return {&node, &ChartDerivatives::D}; }
        Coupled S() const { return {node.couplings.get(), &node.S}; }
        Coupled N() const { return {node.couplings.get(), &node.N}; }
    };
    ForceSlope forceSlope(const MatrixGroup::Entries& g, DataChart<2>& at, const Vector& v) const {
        return {node(g.data(), at, v)};
    }

    /// The second derivatives of the whole product, for the element kernel.
    struct Whole {
        Eigen::MatrixXd xiXi, vXi, vv;
    };
    Whole whole(const MatrixGroup::Entries* g, DataChart<2>& at, const Vector& v) const {
        const Node n = node(g ? g->data() : nullptr, at, v);
        const Couplings& on = *n.couplings;
        Whole w;
        for (Eigen::MatrixXd* const each : {&w.xiXi, &w.vXi, &w.vv})
            *each = Eigen::MatrixXd::Zero(v.size(), v.size());
        for (const Couplings::Pair& pair : on.pairs()) {
            const Second s = second(n, at, pair);
            const auto put = [&](Eigen::MatrixXd& to, const PartMatrix& of) {
                to.block(on.first(pair.p), on.first(pair.q), on.size(pair.p), on.size(pair.q)) = of;
            };
            put(w.xiXi, s.xiXi);
            put(w.vXi, s.vXi);
            put(w.vv, s.vv);
        }
        return w;
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
    static GroupFactor::Vector part(const Vector& of, const Couplings& on, int p) {
        return of.segment(on.first(p), on.size(p));
    }
    void keepSpread(const Node& n) const {
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (int i = 0; i < n.couplings->dimension(); ++i) {
            const double own = std::abs(n.M[n.couplings->place(i, i)]);
            least = std::min(least, own);
            most = std::max(most, own);
        }
        spread_ = least > 0 ? most / least : 1;
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
        return {series::inverseOfDexp(group.constants(), at.xi, eta), group.coadjoint(eta, at.mu) + f};
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
