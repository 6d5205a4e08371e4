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
    using Given = MatrixGroup::Given;
    using PartMatrix = GroupFactor::Matrix;
    static constexpr bool isMixed = true;
    static constexpr bool hasSpaceForm = false;

    explicit ChartLagrangian(const GroupMechanics& mechanics) : mechanics_(mechanics), node_(mechanics) {
        m_ = f_ = forXi_ = forV_ = Vector::Zero(mechanics.dimension());
    }
    bool isFree() const { return mechanics_.isInvariant; }
    const Couplings& couplings() const { return *mechanics_.couplings; }

    template <int K>
    void gradient(DataChart<K>& at, Given v, Vector& forXi, Vector& forV) const {
        const Vector& eta = at.sweep(v);
        double value = 0;
        mechanics_.gradient(mechanics_.model.get(), nullptr, eta.data(), &value, m_.data(), nullptr);
        at.pull(m_, forXi, forV);
    }
    template <int K>
    const Vector& gradient(const MatrixGroup::Entries& g, DataChart<K>& at, Given v, Vector& forXi,
                           Vector& forV) const {
        const Vector& eta = at.sweep(v);
        double value = 0;
        mechanics_.gradient(mechanics_.model.get(), g.data(), eta.data(), &value, m_.data(), f_.data());
        at.pull(m_, forXi, forV);
        forXi += at.dexpTransposed(f_);
        return f_;
    }
    const Vector& force(const MatrixGroup::Entries& g, DataChart<0>& at, Given v) const {
        const Vector& eta = at.dexp(v);
        double value = 0;
        mechanics_.gradient(mechanics_.model.get(), g.data(), eta.data(), &value, m_.data(), f_.data());
        return f_;
    }

    /// L and its derivatives at a node, and those of the chart there.
    struct Node {
        std::shared_ptr<const Couplings> couplings;
        Vector m, f;
        std::vector<double> M, N, S;  ///< in the layout of the couplings; N and S empty where L is invariant
        std::vector<ChartDerivatives> charts;  ///< of each factor

        Node() = default;
        explicit Node(const GroupMechanics& on) : couplings(on.couplings) {
            const auto d = static_cast<Eigen::Index>(couplings->dimension());
            const std::size_t forces = on.isInvariant ? 0 : couplings->entries();
            m = f = Vector::Zero(d);
            M.resize(couplings->entries());
            N.resize(forces);
            S.resize(forces);
            charts.resize(static_cast<std::size_t>(couplings->parts()));
        }
        const ChartDerivatives& chart(int p) const { return charts[static_cast<std::size_t>(p)]; }
        bool isFree() const { return S.empty(); }
    };
    /// g: null where L is invariant. Valid until the next call.
    const Node& node(const double* g, DataChart<2>& at, Given v) const {
        const Vector& eta = at.sweep(v);
        Node& n = node_;
        double L = 0;
        mechanics_.jet(mechanics_.model.get(), g, eta.data(), &L, n.m.data(), g ? n.f.data() : nullptr,
                       n.M.data(), g ? n.N.data() : nullptr, g ? n.S.data() : nullptr);
        keepSpread(n);
        at.pull(n.m, forXi_, forV_);
        for (int p = 0; p < n.couplings->parts(); ++p)
            n.charts[static_cast<std::size_t>(p)] = at.part(p).derivatives();
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
    ForceSlope forceSlope(const MatrixGroup::Entries& g, DataChart<2>& at, Given v) const {
        return {node(g.data(), at, v)};
    }

    /// The second derivatives of the whole product, for the element kernel.
    struct Whole {
        Eigen::MatrixXd xiXi, vXi, vv;
    };
    Whole whole(const MatrixGroup::Entries* g, DataChart<2>& at, Given v) const {
        const Node& n = node(g ? g->data() : nullptr, at, v);
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
        double result = 0;
        mechanics_.gradient(mechanics_.model.get(), g.data(), eta.data(), &result, m_.data(), nullptr);
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
    mutable Vector m_, f_, forXi_, forV_;  ///< room for results
    mutable Node node_;
    mutable double spread_ = 1;  ///< of the inertias, at the last Jacobian
};

/// The classical Runge-Kutta method on (xi, mu) in the chart at the start:
///     xi' = dexp(xi)^-1 eta,   mu' = ad_eta^T mu + f,   dL/deta = mu.
template <>
class StepGuess<double, DataGroup> {
public:
    using Vector = DataGroup::Vector;
    using Given = MatrixGroup::Given;

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

    StepGuess(const DataGroup& group, const GroupMechanics& mechanics)
        : group_(group), mechanics_(mechanics) {
        const int d = group.dimension();
        for (Vector* const each : {&eta_, &m_, &f_, &base_}) *each = Vector::Zero(d);
        for (Move* const each : {&at_, &along_, &slope_, &sum_}) each->xi = each->mu = Vector::Zero(d);
    }

    /// As of a body (lie_guess.hpp).
    template <class Columns>
    void curve(const GroupPose& known, const Vector& mu, const std::vector<double>& times, double base,
               double step, Columns& points) {
        start_ = known.g;
        isFound_ = true;
        at_.xi.setZero();
        at_.mu = mu;
        double reached = 0;
        const auto to = [&](double time) -> const Vector& {
            if (time != reached) advance((time - reached) * step);
            reached = time;
            return at_.xi;
        };
        bool isBaseKnown = false;
        for (std::size_t k = 0; k < times.size(); ++k) {
            if (!isBaseKnown && times[k] > base) {
                base_ = to(base);
                isBaseKnown = true;
            }
            points.col(static_cast<Eigen::Index>(k)) = to(times[k]);
        }
        if (!isBaseKnown) base_ = to(base);
        seenFromBase(base != 0, points);
    }
    /// False where there is no motion at the start: in a singularity.
    bool isRateFinite() const { return isFound_; }

private:
    struct Move {
        Vector xi, mu;
    };
    /// From the chart at the start to that at the base point; on spheres, whose frames turn about the points
    /// there, to coordinates without such a turn.
    template <class Columns>
    void seenFromBase(bool hasBase, Columns& points) {
        const MatrixGroup& group = group_.group();
        const bool isOnSpheres = group_.isOnSpheres();
        if (!hasBase && !isOnSpheres) return;
        if (hasBase) {
            along_.xi = base_;
            if (isOnSpheres) {
                group.exponential(base_, g_);
                group_.horizontal(g_, along_.xi);
            }
            along_.xi = -along_.xi;
            group.exponential(along_.xi, back_);
        }
        for (Eigen::Index k = 0; k < points.cols(); ++k) {
            along_.xi = points.col(k);
            if (hasBase)
                group.moved(back_, along_.xi, g_);
            else
                group.exponential(along_.xi, g_);
            if (isOnSpheres) {
                group_.horizontal(g_, points.col(k));
            } else {
                along_.xi -= base_;
                group.logarithm(g_, along_.xi, along_.mu);
                points.col(k) = along_.mu;
            }
        }
    }
    /// slope_ at a place.
    void findRate(const Move& at) {
        const MatrixGroup& group = group_.group();
        const bool isFree = mechanics_.isInvariant;
        if (!isFree) group.moved(start_, at.xi, g_);
        const bool isFound =
            mechanics_.velocity(mechanics_.model.get(), g_.data(), at.mu.data(), eta_.data());
        double value = 0;
        if (isFound && !isFree)
            mechanics_.gradient(mechanics_.model.get(), g_.data(), eta_.data(), &value, m_.data(), f_.data());
        if (at.xi.isZero(0)) isFound_ = isFound_ && isFound && f_.allFinite();
        for (const GroupFactor& factor : group.factors()) {
            const auto own = [&](auto& of) { return of.segment(factor.coordinate, factor.d); };
            const GroupFactor::Vector xi = own(at.xi), mu = own(at.mu), eta = own(eta_);
            own(slope_.xi) = series::inverseOfDexp(factor.constants, xi, eta);
            own(slope_.mu) = factor.constants.coadjoint(eta, mu);
        }
        slope_.mu += f_;
    }
    /// at_ after the time t.
    void advance(double t) {
        sum_ = at_;
        along_ = at_;
        for (int stage = 0; stage < 4; ++stage) {
            findRate(along_);
            const double weight = stage == 0 || stage == 3 ? t / 6 : t / 3;
            sum_.xi += weight * slope_.xi;
            sum_.mu += weight * slope_.mu;
            if (stage == 3) break;
            const double part = stage == 2 ? t : t / 2;
            along_.xi = at_.xi + part * slope_.xi;
            along_.mu = at_.mu + part * slope_.mu;
        }
        at_ = sum_;
    }

    DataGroup group_;
    GroupMechanics mechanics_;
    MatrixGroup::Entries start_, g_, back_;
    Vector base_;         ///< xi of the base point, seen from the start
    Vector eta_, m_, f_;  ///< f_: 0 where L is invariant
    Move at_, along_, slope_, sum_;
    bool isFound_ = true;
};

}  // namespace extremal
