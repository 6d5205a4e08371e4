// SPDX-License-Identifier: GPL-3.0-or-later
/// The chart at xi of a group given as data, factor by factor: by the closed forms of rotations
/// (group/so3.hpp) where a factor is so(3), whatever its basis (group/rotation_algebra.hpp); nothing to do
/// where it is abelian; else by sweeps of brackets.
/// K as in so3::Exponential.
#pragma once

#include <cstddef>
#include <memory>
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

    FactorChart(const GroupFactor& factor, const Vector& xi) : factor_(&factor) {
        if (factor.rotations)
            turn_.emplace(*factor.rotations, xi);
        else if (!factor.isAbelian)
            series_ = std::make_unique<SeriesChart>(factor, xi);
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
    Vector sweep(const Vector& v) { return turn_ ? turn_->sweep(v) : series_ ? series_->sweep(v) : v; }
    /// (D_xi eta)^T m and dexp(xi)^T m, of the curve of the last sweep.
    void pull(const Vector& m, Vector& forXi, Vector& forV) {
        if (turn_)
            turn_->pull(m, forXi, forV);
        else if (series_)
            series_->pull(m, forXi, forV);
        else
            flat_->pull(m, forXi, forV);
    }
    /// Of the curve of the last sweep and the momentum of the last pull.
    ChartDerivatives derivatives() const {
        return of([](const auto& c) { return c.derivatives(); });
    }

private:
    template <class F>
    auto of(const F& f) const {
        return turn_ ? f(*turn_) : series_ ? f(*series_) : f(*flat_);
    }
    const GroupFactor* factor_;
    std::optional<TurnChart<K>> turn_;
    std::unique_ptr<SeriesChart> series_;
    std::optional<FlatChart> flat_;
};

/// That of the product: functions of ad, which is block diagonal.
template <int K>
class DataChart {
public:
    using Vector = MatrixGroup::Vector;
    using Part = GroupFactor::Vector;

    DataChart(const MatrixGroup& group, const Vector& xi) : xi_(xi) {
        parts_.reserve(group.factors().size());
        for (const GroupFactor& f : group.factors())
            parts_.emplace_back(f, Part(xi.segment(f.coordinate, f.d)));
    }
    const Vector& xi() const { return xi_; }
    const FactorChart<K>& part(int p) const { return parts_[static_cast<std::size_t>(p)]; }

    Vector rotateBack(const Vector& v) const {
        return byPart(v, [](const auto& c, const Part& y) { return c.rotateBack(y); });
    }
    Vector rotateMomentum(const Vector& m) const {
        return byPart(m, [](const auto& c, const Part& y) { return c.rotateMomentum(y); });
    }
    Vector rotateMomentumBack(const Vector& m) const {
        return byPart(m, [](const auto& c, const Part& y) { return c.rotateMomentumBack(y); });
    }
    Vector dexp(const Vector& v) const {
        return byPart(v, [](const auto& c, const Part& y) { return c.dexp(y); });
    }
    Vector dexpTransposed(const Vector& m) const {
        return byPart(m, [](const auto& c, const Part& y) { return c.dexpTransposed(y); });
    }
    Vector dexpRightTransposed(const Vector& m) const {
        return byPart(m, [](const auto& c, const Part& y) { return c.dexpRightTransposed(y); });
    }
    Vector sweep(const Vector& v) {
        Vector eta(v.size());
        for (FactorChart<K>& c : parts_) segment(eta, c) = c.sweep(segment(v, c));
        return eta;
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
    static auto segment(V& of, const FactorChart<K>& c) {
        return of.segment(c.factor().coordinate, c.factor().d);
    }
    template <class F>
    Vector byPart(const Vector& v, const F& f) const {
        Vector r(v.size());
        for (const FactorChart<K>& c : parts_) segment(r, c) = f(c, Part(segment(v, c)));
        return r;
    }

    Vector xi_;
    std::vector<FactorChart<K>> parts_;
};

}  // namespace extremal
