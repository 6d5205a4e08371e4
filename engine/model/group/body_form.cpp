// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/group/body_form.hpp"

#include <array>
#include <cmath>
#include <memory>

#include "engine/core/algebra/dense.hpp"

namespace extremal {
namespace {

using Three = so3::Vector<double>;
using Square = so3::Matrix<double>;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Entries = MatrixGroup::Entries;

/// L of a group whose elements are P R P^-1, as the potential of the body R: -L at rest.
struct PotentialOnGroup {
    GroupMechanics mechanics;
    Square T, P, inverseP;

    static void at(const void* p, const double* R, const double*, double* value, double* force,
                   double* slope) {
        const PotentialOnGroup& of = *static_cast<const PotentialOnGroup*>(p);
        const RowMajor g = of.P * Eigen::Map<const Square>(R) * of.inverseP;
        const Three rest = Three::Zero();
        Three m, f;
        double L = 0;
        const void* const model = of.mechanics.model.get();
        if (slope) {
            Square M, N, S;
            of.mechanics.jet(model, g.data(), rest.data(), &L, m.data(), f.data(), M.data(), N.data(),
                             S.data());
            Eigen::Map<Square>{slope} = of.T.transpose() * S * of.T;
        } else {
            of.mechanics.gradient(model, g.data(), rest.data(), &L, m.data(), f.data());
        }
        if (value) *value = -L;
        if (force) Eigen::Map<Three>{force} = of.T.transpose() * f;
    }
};

/// M of L = 1/2 eta . M eta - U(g); nothing where L is not of that kind.
std::optional<Square> constantMasses(const GroupMechanics& on) {
    if (on.isMixed || !on.hasConstantMasses) return {};
    const Entries g = on.group->identity();
    const Three rest = Three::Zero();
    Three m, f;
    Square M, N, S;
    double L = 0;
    if (on.isInvariant)
        on.jet(on.model.get(), g.data(), rest.data(), &L, m.data(), nullptr, M.data(), nullptr, nullptr);
    else
        on.jet(on.model.get(), g.data(), rest.data(), &L, m.data(), f.data(), M.data(), N.data(), S.data());
    if (!m.isZero(0) || !M.allFinite()) return {};
    return M;
}

/// P with F_a P = P L_a, L_a the rotation about axis a.
Square conjugation(const std::vector<Eigen::MatrixXd>& F) {
    const Square third = F[2];
    Three axis = Three::Zero();  // third axis = 0
    for (int i = 0; i < 3; ++i) {
        const Three other = so3::cross(Three(third.row(i)), Three(third.row((i + 1) % 3)));
        if (other.squaredNorm() > axis.squaredNorm()) axis = other;
    }
    axis /= axis.norm();
    Square P;
    P.col(0) = F[1] * axis;
    P.col(1) = -(F[0] * axis);
    P.col(2) = axis;
    return P;
}

}  // namespace

std::optional<BodyForm> BodyForm::of(const GroupMechanics& on) {
    const auto& factors = on.group->factors();
    if (factors.size() != 1 || !factors[0].rotations || !on.isotropy.empty()) return {};
    const RotationAlgebra& algebra = *factors[0].rotations;
    const bool isOne = algebra.spin == RotationAlgebra::Spin::one && factors[0].n == 3,
               isHalf = algebra.spin == RotationAlgebra::Spin::half;
    if (!isOne && !(isHalf && on.isInvariant)) return {};
    const std::optional<Square> masses = constantMasses(on);
    if (!masses) return {};

    BodyForm form;
    form.n_ = factors[0].n;
    form.isHalf_ = isHalf;
    form.T_ = algebra.T;
    form.inverse_ = algebra.inverse;
    Square M = algebra.T.transpose() * *masses * algebra.T;
    if (Square(M - Square(M.diagonal().asDiagonal())).norm() > 1e-15 * M.norm()) {
        const auto principal = dense::symmetricEigen<double>((M + M.transpose()) / 2);
        Square Q = principal.vectors;
        if (Q.determinant() < 0) Q.col(0) = -Q.col(0);
        form.T_ = algebra.T * Q;
        form.inverse_ = Q.transpose() * algebra.inverse;
        M = principal.values.asDiagonal();
    }
    form.body_.dimension = 3;
    for (int i = 0; i < 3; ++i) {
        if (!(M(i, i) > 0) || !std::isfinite(M(i, i))) return {};
        form.body_.inertia[static_cast<std::size_t>(i)] = M(i, i);
    }
    std::vector<Eigen::MatrixXd> F(3, Eigen::MatrixXd::Zero(form.n_, form.n_));
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            F[static_cast<std::size_t>(a)] += form.T_(b, a) * factors[0].basis[static_cast<std::size_t>(b)];
    if (isHalf) {
        form.unit_.push_back(Eigen::MatrixXd::Identity(form.n_, form.n_));
        for (const Eigen::MatrixXd& each : F) form.unit_.push_back(2 * each);
        return form;
    }
    form.P_ = conjugation(F);
    form.inverseP_ = dense::inverse<double>(form.P_);
    form.isPlain_ = form.T_ == Square::Identity() && form.P_ == Square::Identity();
    if (!on.isInvariant) {
        form.body_.model =
            std::make_shared<const PotentialOnGroup>(PotentialOnGroup{on, form.T_, form.P_, form.inverseP_});
        form.body_.potential = &PotentialOnGroup::at;
    }
    return form;
}

void BodyForm::read(const double* x, so3::Quaternion<double>& attitude, Three& momentum) const {
    const Eigen::Map<const Three> J(x + n_ * n_ + 3);
    momentum = isPlain_ ? Three(J) : Three(T_.transpose() * J);
    if (!isHalf_) {
        const Eigen::Map<const RowMajor> g(x);
        attitude = so3::quaternion(isPlain_ ? Square(g) : Square(inverseP_ * g * P_));
        return;
    }
    // The units are orthogonal to each other: tr(U_a U_b) = -n, and n of 1.
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> g(x, n_,
                                                                                                     n_);
    for (int a = 0; a < 4; ++a) {
        double sum = 0;
        const Eigen::MatrixXd& unit = unit_[static_cast<std::size_t>(a)];
        for (int i = 0; i < n_; ++i)
            for (int k = 0; k < n_; ++k) sum += unit(i, k) * g(k, i);
        attitude(a) = (a == 0 ? sum : -sum) / n_;
    }
    attitude = so3::normalised(attitude);
}

void BodyForm::write(const so3::Quaternion<double>& attitude, const Three& momentum, double* x) const {
    const Square R = so3::matrix(attitude);
    const Three body = R.transpose() * momentum;
    double* const mu = x + n_ * n_;
    if (isPlain_) {
        Eigen::Map<RowMajor>{x} = R;
        for (int i = 0; i < 3; ++i) {
            mu[i] = body(i);
            mu[3 + i] = momentum(i);
        }
        return;
    }
    Eigen::Map<Three>{mu} = inverse_.transpose() * body;
    Eigen::Map<Three>{mu + 3} = inverse_.transpose() * momentum;
    if (!isHalf_) {
        Eigen::Map<RowMajor>{x} = P_ * R * inverseP_;
        return;
    }
    for (int i = 0; i < n_; ++i)
        for (int k = 0; k < n_; ++k) {
            double sum = 0;
            for (int a = 0; a < 4; ++a) sum += attitude(a) * unit_[static_cast<std::size_t>(a)](i, k);
            x[i * n_ + k] = sum;
        }
}

void BodyForm::varyBody(double* W) const {
    Eigen::Map<Three> zeta(W), dmu(W + 3);
    zeta = (inverse_ * zeta).eval();
    dmu = (T_.transpose() * dmu).eval();
}
void BodyForm::varyGroup(double* W) const {
    Eigen::Map<Three> zeta(W), dmu(W + 3);
    zeta = (T_ * zeta).eval();
    dmu = (inverse_.transpose() * dmu).eval();
}

}  // namespace extremal
