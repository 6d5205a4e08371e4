// SPDX-License-Identifier: GPL-3.0-or-later
/// The chart at xi of a group given as data, factor by factor: by the closed forms of rotations
/// (group/so3.hpp) where a factor is so(3), whatever its basis (group/rotation_algebra.hpp); nothing to do
/// where it is abelian; else by sweeps of brackets. K as in so3::Exponential. A chart has room of its own and
/// is placed at one xi after another, so that nothing is allocated where it is placed.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/family/lie/series_chart.hpp"
#include "engine/group/matrix_group.hpp"
#include "engine/group/so3.hpp"

namespace extremal {

/// so(3), in the coordinates in which brackets are vector products.
template <int K>
class TurnChart {
public:
    using Vector = GroupFactor::Vector;
    using Matrix = GroupFactor::Matrix;

    TurnChart(const RotationAlgebra& basis, const Vector& xi) : basis_(&basis), chart_(basis.own(xi)) {}

    Vector rotateBack(const Vector& v) const { return given(chart_.rotateBack(own(v))); }
    Vector rotateMomentum(const Vector& m) const {
        return givenMomentum(chart_.rotateMomentum(ownMomentum(m)));
    }
    Vector rotateMomentumBack(const Vector& m) const {
        return givenMomentum(chart_.rotateMomentumBack(ownMomentum(m)));
    }
    Vector dexp(const Vector& v) const { return given(chart_.dexp(own(v))); }
    Vector dexpTransposed(const Vector& m) const {
        return givenMomentum(chart_.dexpTransposed(ownMomentum(m)));
    }
    Vector dexpRightTransposed(const Vector& m) const {
        return givenMomentum(chart_.dexpRightTransposed(ownMomentum(m)));
    }
    Matrix dexpMatrix() const { return vectorsToVectors(chart_.dexpMatrix()); }
    Matrix derivativeOfTransposed(const Vector& m) const {
        return vectorsToMomenta(chart_.derivativeOfTransposed(ownMomentum(m)));
    }
    Matrix derivativeOfRightTransposed(const Vector& m) const {
        return vectorsToMomenta(chart_.derivativeOfRightTransposed(ownMomentum(m)));
    }

    Vector sweep(const Vector& v) {
        v_ = own(v);
        return given(chart_.dexp(v_));
    }
    void pull(const Vector& m, Vector& forXi, Vector& forV) {
        m_ = ownMomentum(m);
        forV = givenMomentum(chart_.dexpTransposed(m_));
        forXi = givenMomentum(chart_.gradient(v_, m_));
    }
    ChartDerivatives derivatives() const {
        return {dexpMatrix(), vectorsToVectors(chart_.derivative(v_)),
                vectorsToMomenta(chart_.derivativeOfTransposed(m_)),
                vectorsToMomenta(chart_.hessian(v_, m_))};
    }

private:
    using Three = so3::Vector<double>;
    using Square = so3::Matrix<double>;

    Three own(const Vector& v) const { return basis_->own(v); }
    Three ownMomentum(const Vector& m) const { return basis_->ownMomentum(m); }
    Vector given(const Three& y) const { return basis_->given(y); }
    Vector givenMomentum(const Three& y) const { return basis_->givenMomentum(y); }
    Square vectorsToVectors(const Square& of) const {
        if (basis_->isUsual) return of;
        return basis_->T.lazyProduct(Square(of.lazyProduct(basis_->inverse)));
    }
    Square vectorsToMomenta(const Square& of) const {
        if (basis_->isUsual) return of;
        return basis_->inverse.transpose().lazyProduct(Square(of.lazyProduct(basis_->inverse)));
    }

    const RotationAlgebra* basis_;
    so3::Exponential<double, K> chart_;
    Three v_, m_;
};

/// Of an abelian algebra: eta = v.
class FlatChart {
public:
    using Vector = GroupFactor::Vector;
    using Matrix = GroupFactor::Matrix;

    explicit FlatChart(const Vector& xi) : d_(xi.size()) {}
    const Vector& rotateBack(const Vector& v) const { return v; }
    const Vector& rotateMomentum(const Vector& m) const { return m; }
    const Vector& rotateMomentumBack(const Vector& m) const { return m; }
    const Vector& dexp(const Vector& v) const { return v; }
    const Vector& dexpTransposed(const Vector& m) const { return m; }
    const Vector& dexpRightTransposed(const Vector& m) const { return m; }
    Matrix dexpMatrix() const { return Matrix::Identity(d_, d_); }
    Matrix derivativeOfTransposed(const Vector&) const { return Matrix::Zero(d_, d_); }
    Matrix derivativeOfRightTransposed(const Vector&) const { return Matrix::Zero(d_, d_); }
    const Vector& sweep(const Vector& v) { return v; }
    void pull(const Vector& m, Vector& forXi, Vector& forV) const {
        forXi = Vector::Zero(d_);
        forV = m;
    }
    ChartDerivatives derivatives() const {
        const Matrix none = Matrix::Zero(d_, d_);
        return {dexpMatrix(), none, none, none};
    }

private:
    Eigen::Index d_;
};

/// The chart of one factor, whichever it is.
template <int K>
class FactorChart {
public:
    using Vector = GroupFactor::Vector;
    using Matrix = GroupFactor::Matrix;

    /// At xi = 0.
    explicit FactorChart(const GroupFactor& factor) : factor_(&factor) {
        if (!factor.rotations && !factor.isAbelian)
            series_.emplace_back(factor);
        else
            place(Vector::Zero(factor.d));
    }
    void place(const Vector& xi) {
        if (!series_.empty())
            series_.front().place(xi);
        else if (factor_->rotations)
            turn_.emplace(*factor_->rotations, xi);
        else
            flat_.emplace(xi);
    }
    const GroupFactor& factor() const { return *factor_; }

    Vector rotateBack(const Vector& v) const {
        return of([&](const auto& c) -> Vector { return c.rotateBack(v); });
    }
    Vector rotateMomentum(const Vector& m) const {
        return of([&](const auto& c) -> Vector { return c.rotateMomentum(m); });
    }
    Vector rotateMomentumBack(const Vector& m) const {
        return of([&](const auto& c) -> Vector { return c.rotateMomentumBack(m); });
    }
    Vector dexp(const Vector& v) const {
        return of([&](const auto& c) -> Vector { return c.dexp(v); });
    }
    Vector dexpTransposed(const Vector& m) const {
        return of([&](const auto& c) -> Vector { return c.dexpTransposed(m); });
    }
    Vector dexpRightTransposed(const Vector& m) const {
        return of([&](const auto& c) -> Vector { return c.dexpRightTransposed(m); });
    }
    Matrix dexpMatrix() const {
        return of([](const auto& c) -> Matrix { return c.dexpMatrix(); });
    }
    /// The matrix direction -> D_xi [dexp(xi)^T m] . direction (m fixed), and that of dexp(-xi)^T m.
    Matrix derivativeOfTransposed(const Vector& m) const {
        return of([&](const auto& c) -> Matrix { return c.derivativeOfTransposed(m); });
    }
    Matrix derivativeOfRightTransposed(const Vector& m) const {
        return of([&](const auto& c) -> Matrix { return c.derivativeOfRightTransposed(m); });
    }
    /// eta = dexp(xi) v, kept for what follows.
    Vector sweep(const Vector& v) {
        return turn_ ? turn_->sweep(v) : flat_ ? flat_->sweep(v) : series_.front().sweep(v);
    }
    /// (D_xi eta)^T m and dexp(xi)^T m, of the curve of the last sweep.
    void pull(const Vector& m, Vector& forXi, Vector& forV) {
        if (turn_)
            turn_->pull(m, forXi, forV);
        else if (flat_)
            flat_->pull(m, forXi, forV);
        else
            series_.front().pull(m, forXi, forV);
    }
    /// Of the curve of the last sweep and the momentum of the last pull.
    ChartDerivatives derivatives() const {
        return of([](const auto& c) { return c.derivatives(); });
    }

private:
    template <class F>
    auto of(const F& f) const {
        return turn_ ? f(*turn_) : flat_ ? f(*flat_) : f(series_.front());
    }
    const GroupFactor* factor_;
    std::optional<TurnChart<K>> turn_;
    std::optional<FlatChart> flat_;
    std::vector<SeriesChart> series_;  ///< one or none: it is large
};

/// That of the product: functions of ad, which is block diagonal. A result is valid until the same function
/// is called again.
template <int K>
class DataChart {
public:
    using Vector = MatrixGroup::Vector;
    using Part = GroupFactor::Vector;
    using Given = MatrixGroup::Given;

    /// At xi = 0; `group` outlives the chart.
    explicit DataChart(const MatrixGroup& group) : xi_(Vector::Zero(group.dimension())) {
        parts_.reserve(group.factors().size());
        for (const GroupFactor& f : group.factors()) parts_.emplace_back(f);
        for (Vector* const each : {&back_, &momentum_, &momentumBack_, &eta_, &pulled_, &rightPulled_})
            *each = xi_;
    }
    void place(Given xi) {
        xi_ = xi;
        for (FactorChart<K>& c : parts_) c.place(segment(xi_, c));
    }
    const Vector& xi() const { return xi_; }
    const FactorChart<K>& part(int p) const { return parts_[static_cast<std::size_t>(p)]; }

    template <class V>
    const Vector& rotateBack(const V& v) {
        return byPart(v, back_, [](const auto& c, const Part& y) { return c.rotateBack(y); });
    }
    template <class V>
    const Vector& rotateMomentum(const V& m) {
        return byPart(m, momentum_, [](const auto& c, const Part& y) { return c.rotateMomentum(y); });
    }
    template <class V>
    const Vector& rotateMomentumBack(const V& m) {
        return byPart(m, momentumBack_, [](const auto& c, const Part& y) { return c.rotateMomentumBack(y); });
    }
    template <class V>
    const Vector& dexp(const V& v) {
        return byPart(v, eta_, [](const auto& c, const Part& y) { return c.dexp(y); });
    }
    template <class V>
    const Vector& dexpTransposed(const V& m) {
        return byPart(m, pulled_, [](const auto& c, const Part& y) { return c.dexpTransposed(y); });
    }
    template <class V>
    const Vector& dexpRightTransposed(const V& m) {
        return byPart(m, rightPulled_, [](const auto& c, const Part& y) { return c.dexpRightTransposed(y); });
    }
    const Vector& sweep(Given v) {
        for (FactorChart<K>& c : parts_) segment(eta_, c) = c.sweep(segment(v, c));
        return eta_;
    }
    void pull(const Vector& m, Vector& forXi, Vector& forV) {
        forXi.resize(m.size());
        forV.resize(m.size());
        Part ownXi, ownV;
        for (FactorChart<K>& c : parts_) {
            c.pull(segment(m, c), ownXi, ownV);
            segment(forXi, c) = ownXi;
            segment(forV, c) = ownV;
        }
    }

private:
    template <class V>
    static auto segment(V&& of, const FactorChart<K>& c) {
        return of.segment(c.factor().coordinate, c.factor().d);
    }
    template <class V, class F>
    const Vector& byPart(const V& v, Vector& result, const F& f) {
        for (const FactorChart<K>& c : parts_) segment(result, c) = f(c, Part(segment(v, c)));
        return result;
    }

    Vector xi_, back_, momentum_, momentumBack_, eta_, pulled_, rightPulled_;
    std::vector<FactorChart<K>> parts_;
};

}  // namespace extremal
