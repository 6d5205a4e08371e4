// SPDX-License-Identifier: GPL-3.0-or-later
/// The chart of any matrix group at xi, by sweeps of brackets (group/algebra_series.hpp). Matrices are swept
/// with all their columns at once.
#pragma once

#include <array>
#include <limits>

#include "engine/group/algebra_series.hpp"
#include "engine/group/group_factor.hpp"

namespace extremal {

struct ChartDerivatives {
    GroupFactor::Matrix A, D;  ///< dexp(xi), and the slope of dexp(xi) v by xi
    GroupFactor::Matrix B, H;  ///< that of dexp(xi)^T m by xi, and the second one of m . dexp(xi) v
};

class SeriesChart {
public:
    using Vector = GroupFactor::Vector;
    using Matrix = GroupFactor::Matrix;

    /// At xi = 0; `group` outlives the chart.
    explicit SeriesChart(const GroupFactor& group)
        : group_(&group.constants), xi_(Vector::Zero(group.d)), terms_(1) {}
    void place(const Vector& xi) {
        xi_ = xi;
        terms_ = series::termsFor(group_->adNorm(xi), 0.1 * std::numeric_limits<double>::epsilon());
    }

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
        return series::phi(Rows(Rows::Identity(d(), d())), terms_, [&](const Rows& y) {
            Rows r = Rows::Zero(d(), d());
            group_->addBracket(-1, xi_, y, r);
            return r;
        });
    }
    /// The matrix direction -> D_xi [dexp(xi)^T m] . direction (m fixed), and that of dexp(-xi)^T m.
    Matrix derivativeOfTransposed(const Vector& m) const { return slopesOfPull(m, 1); }
    Matrix derivativeOfRightTransposed(const Vector& m) const { return slopesOfPull(m, -1); }

    /// eta = dexp(xi) v; keeps the sweep for what follows.
    Vector sweep(const Vector& v) {
        Vector eta = Vector::Zero(d());
        double factorial = 1;
        for (int n = 0; n < terms_; ++n) {
            if (n == 0) {
                w_[0] = v;
            } else {
                w_[at(n)].setZero(d());
                group_->addBracket(-1, xi_, w_[at(n - 1)], w_[at(n)]);
            }
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
        for (int n = 0; n + 1 < terms_; ++n) group_->addCoadjoint(1, w_[at(n)], lambda_[at(n + 1)], forXi);
    }
    /// Of the curve of the last sweep and the momentum of the last pull.
    ChartDerivatives derivatives() const {
        ChartDerivatives r;
        r.A = dexpMatrix();
        r.B = derivativeOfTransposed(lambdaSource());
        // Column k: the derivatives of the w along basis vector k, -[E_k, w] - [xi, dw]. Both slopes of
        // m . dexp(xi) v act at two places of the same brackets, in one order or the other.
        Rows dw = Rows::Zero(d(), d()), next = dw, D = dw, inOrder = dw;
        double factorial = 1;
        for (int n = 0; n < terms_; ++n) {
            factorial *= n + 1;
            D += dw / factorial;
            if (n + 1 == terms_) break;
            group_->addCoadjointBy(dw, lambda_[at(n + 1)], inOrder);
            next.setZero();
            group_->addMatrix(w_[at(n)], next);
            group_->addBracket(-1, xi_, dw, next);
            dw.swap(next);
        }
        r.D = D;
        r.H = inOrder;
        r.H += inOrder.transpose();
        return r;
    }

private:
    using Sweep = std::array<Vector, series::mostTerms>;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor,
                               Matrix::MaxRowsAtCompileTime, Matrix::MaxColsAtCompileTime>;
    static std::size_t at(int n) { return static_cast<std::size_t>(n); }
    int d() const { return static_cast<int>(xi_.size()); }
    Vector bracket(const Vector& y) const { return group_->bracket(xi_, y); }
    Vector coadjoint(const Vector& m) const { return group_->coadjoint(xi_, m); }
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
            if (n + 1 < terms_) group_->addCoadjoint(-sign, xi_, lambda[at(n + 1)], lambda[at(n)]);
        }
    }
    /// Column k: the derivative of lambda_0 along basis vector k.
    Matrix slopesOfPull(const Vector& m, double sign) const {
        Sweep lambda;
        sweepBack(m, sign, lambda);
        Rows slopes = Rows::Zero(d(), d()), next = slopes;
        for (int n = terms_ - 2; n >= 0; --n) {
            next.setZero();
            group_->addCoadjointMatrix(-sign, lambda[at(n + 1)], next);
            group_->addCoadjoint(-sign, xi_, slopes, next);
            slopes.swap(next);
        }
        return slopes;
    }

    const StructureConstants* group_;
    Vector xi_;
    int terms_;
    Sweep w_, lambda_;
};

}  // namespace extremal
