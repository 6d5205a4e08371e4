// SPDX-License-Identifier: GPL-3.0-or-later
/// The chart at xi of a group given as data: by the closed forms of rotations (group/so3.hpp) where every
/// factor is so(3) or abelian, whatever its basis (group/rotation_algebra.hpp); else by sweeps of brackets.
/// K as in so3::Exponential.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "engine/family/lie/series_chart.hpp"
#include "engine/group/so3.hpp"

namespace extremal {

/// ad is block diagonal, with vector products in the blocks of rotations and nothing in those of abelian
/// factors: functions are taken factor by factor, in the coordinates in which each block is the usual one.
template <int K>
class RotationsChart {
public:
    using Vector = MatrixGroup::Vector;
    using Matrix = MatrixGroup::Matrix;

    RotationsChart(const MatrixGroup& group, const Vector& xi) : d_(group.dimension()) {
        for (const MatrixGroup::Factor& f : group.factors())
            if (f.rotations) {
                Turn& turn = turns_[count_++];
                turn.basis = &*f.rotations;
                turn.at = f.coordinate;
                turn.chart.emplace(turn.basis->own(xi.template segment<3>(f.coordinate)));
            }
    }

    Vector rotateBack(const Vector& v) const {
        return ofVectors(v, [](const Turn& t, const Three& y) { return t.chart->rotateBack(y); });
    }
    Vector rotateMomentum(const Vector& m) const {
        return ofMomenta(m, [](const Turn& t, const Three& y) { return t.chart->rotateMomentum(y); });
    }
    Vector rotateMomentumBack(const Vector& m) const {
        return ofMomenta(m, [](const Turn& t, const Three& y) { return t.chart->rotateMomentumBack(y); });
    }
    Vector dexp(const Vector& v) const {
        return ofVectors(v, [](const Turn& t, const Three& y) { return t.chart->dexp(y); });
    }
    Vector dexpTransposed(const Vector& m) const {
        return ofMomenta(m, [](const Turn& t, const Three& y) { return t.chart->dexpTransposed(y); });
    }
    Vector dexpRightTransposed(const Vector& m) const {
        return ofMomenta(m, [](const Turn& t, const Three& y) { return t.chart->dexpRightTransposed(y); });
    }
    Matrix dexpMatrix() const {
        Matrix A = Matrix::Identity(d_, d_);
        for (const Turn& t : turns()) block(A, t) = vectorsToVectors(t, t.chart->dexpMatrix());
        return A;
    }
    Matrix derivativeOfTransposed(const Vector& m) const {
        return slopes(m, [](const Turn& t, const Three& y) { return t.chart->derivativeOfTransposed(y); });
    }
    Matrix derivativeOfRightTransposed(const Vector& m) const {
        return slopes(m,
                      [](const Turn& t, const Three& y) { return t.chart->derivativeOfRightTransposed(y); });
    }

    Vector sweep(const Vector& v) {
        v_ = v;
        return dexp(v);
    }
    void pull(const Vector& m, Vector& forXi, Vector& forV) {
        m_ = m;
        forV = dexpTransposed(m);
        forXi = Vector::Zero(d_);
        for (const Turn& t : turns())
            forXi.template segment<3>(t.at) =
                t.basis->givenMomentum(t.chart->gradient(vectorOf(t, v_), momentumOf(t, m)));
    }
    ChartDerivatives derivatives() const {
        ChartDerivatives r;
        r.A = dexpMatrix();
        r.B = derivativeOfTransposed(m_);
        r.D = r.H = Matrix::Zero(d_, d_);
        for (const Turn& t : turns()) {
            const Three v = vectorOf(t, v_), m = momentumOf(t, m_);
            block(r.D, t) = vectorsToVectors(t, t.chart->derivative(v));
            block(r.H, t) = vectorsToMomenta(t, t.chart->hessian(v, m));
        }
        return r;
    }

private:
    using Three = so3::Vector<double>;
    using Square = so3::Matrix<double>;
    struct Turn {
        const RotationAlgebra* basis = nullptr;
        int at = 0;  ///< the first of its coordinates
        std::optional<so3::Exponential<double, K>> chart;
    };
    struct Turns {
        const Turn *first, *last;
        const Turn* begin() const { return first; }
        const Turn* end() const { return last; }
    };
    Turns turns() const { return {turns_.data(), turns_.data() + count_}; }

    static Three vectorOf(const Turn& t, const Vector& v) {
        return t.basis->own(v.template segment<3>(t.at));
    }
    static Three momentumOf(const Turn& t, const Vector& m) {
        return t.basis->ownMomentum(m.template segment<3>(t.at));
    }
    template <class F>
    Vector ofVectors(const Vector& v, F&& f) const {
        Vector r = v;
        for (const Turn& t : turns())
            r.template segment<3>(t.at) = t.basis->given(Three(f(t, vectorOf(t, v))));
        return r;
    }
    template <class F>
    Vector ofMomenta(const Vector& m, F&& f) const {
        Vector r = m;
        for (const Turn& t : turns())
            r.template segment<3>(t.at) = t.basis->givenMomentum(Three(f(t, momentumOf(t, m))));
        return r;
    }
    template <class F>
    Matrix slopes(const Vector& m, F&& f) const {
        Matrix B = Matrix::Zero(d_, d_);
        for (const Turn& t : turns()) block(B, t) = vectorsToMomenta(t, f(t, momentumOf(t, m)));
        return B;
    }
    static auto block(Matrix& of, const Turn& t) { return of.template block<3, 3>(t.at, t.at); }
    static Square vectorsToVectors(const Turn& t, const Square& of) {
        if (t.basis->isUsual) return of;
        return t.basis->T.lazyProduct(Square(of.lazyProduct(t.basis->inverse)));
    }
    static Square vectorsToMomenta(const Turn& t, const Square& of) {
        if (t.basis->isUsual) return of;
        return t.basis->inverse.transpose().lazyProduct(Square(of.lazyProduct(t.basis->inverse)));
    }

    int d_;
    std::size_t count_ = 0;
    std::array<Turn, MatrixGroup::maxDimension / 3> turns_;
    Vector v_, m_;
};

template <int K>
class DataChart {
public:
    using Vector = MatrixGroup::Vector;
    using Matrix = MatrixGroup::Matrix;

    DataChart(const MatrixGroup& group, const Vector& xi) : xi_(xi) {
        if (group.hasClosedForms())
            closed_.emplace(group, xi_);
        else
            series_.emplace(group, xi_);
    }
    const Vector& xi() const { return xi_; }

    Vector rotateBack(const Vector& v) const {
        return closed_ ? closed_->rotateBack(v) : series_->rotateBack(v);
    }
    Vector rotateMomentum(const Vector& m) const {
        return closed_ ? closed_->rotateMomentum(m) : series_->rotateMomentum(m);
    }
    Vector rotateMomentumBack(const Vector& m) const {
        return closed_ ? closed_->rotateMomentumBack(m) : series_->rotateMomentumBack(m);
    }
    Vector dexp(const Vector& v) const { return closed_ ? closed_->dexp(v) : series_->dexp(v); }
    Vector dexpTransposed(const Vector& m) const {
        return closed_ ? closed_->dexpTransposed(m) : series_->dexpTransposed(m);
    }
    Vector dexpRightTransposed(const Vector& m) const {
        return closed_ ? closed_->dexpRightTransposed(m) : series_->dexpRightTransposed(m);
    }
    Matrix dexpMatrix() const { return closed_ ? closed_->dexpMatrix() : series_->dexpMatrix(); }
    /// The matrix direction -> D_xi [dexp(xi)^T m] . direction (m fixed), and that of dexp(-xi)^T m.
    Matrix derivativeOfTransposed(const Vector& m) const {
        return closed_ ? closed_->derivativeOfTransposed(m) : series_->derivativeOfTransposed(m);
    }
    Matrix derivativeOfRightTransposed(const Vector& m) const {
        return closed_ ? closed_->derivativeOfRightTransposed(m) : series_->derivativeOfRightTransposed(m);
    }
    /// eta = dexp(xi) v; keeps what follows needs of it.
    Vector sweep(const Vector& v) { return closed_ ? closed_->sweep(v) : series_->sweep(v); }
    /// dexp(xi)^T m, and (D_xi eta)^T m, of the curve of the last sweep.
    void pull(const Vector& m, Vector& forXi, Vector& forV) {
        closed_ ? closed_->pull(m, forXi, forV) : series_->pull(m, forXi, forV);
    }
    /// Of the curve of the last sweep and the momentum of the last pull.
    ChartDerivatives derivatives() const { return closed_ ? closed_->derivatives() : series_->derivatives(); }

private:
    Vector xi_;
    std::optional<RotationsChart<K>> closed_;
    std::optional<SeriesChart> series_;
};

}  // namespace extremal
