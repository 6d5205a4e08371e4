// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/body/free_body_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/algebra/carlson.hpp"
#include "engine/group/so3.hpp"
#include "engine/model/body/jacobi_elliptic.hpp"

namespace extremal {
namespace {

using Vector = so3::Vector<double>;
using Quaternion = so3::Quaternion<double>;

/// A proper rotation that takes body axes to the renamed ones: entry i of the image is sign[i] * v(axis[i]).
struct Renaming {
    std::array<int, 3> axis{0, 1, 2};
    std::array<double, 3> sign{1, 1, 1};

    Vector to(const Vector& v) const {
        return {sign[0] * v(axis[0]), sign[1] * v(axis[1]), sign[2] * v(axis[2])};
    }
    Vector back(const Vector& v) const {
        Vector r;
        for (std::size_t i = 0; i < 3; ++i) r(axis[i]) = sign[i] * v(static_cast<int>(i));
        return r;
    }
};

class Motion {
public:
    /// False where the formula does not serve.
    bool prepare(const std::array<double, 3>& inertia, const State& initial) {
        start_ = initial.t;
        const double* x = initial.x.data();
        q0_ << x[0], x[1], x[2], x[3];
        Pi0_ << x[4], x[5], x[6];
        pi_ << x[7], x[8], x[9];
        omega_ << Pi0_(0) / inertia[0], Pi0_(1) / inertia[1], Pi0_(2) / inertia[2];
        isPermanent_ = so3::cross(Pi0_, omega_).norm() <= 1e-300;
        if (isPermanent_) return true;
        rename(inertia);
        const Vector P = names_.to(Pi0_);
        const auto square = [&](int i) { return P(i) * P(i); };
        // L^2 - 2 E I_k, without the k-th term.
        const double less1 = square(1) * (I_(1) - I_(0)) / I_(1) + square(2) * (I_(2) - I_(0)) / I_(2);
        const double less3 = square(0) * (I_(0) - I_(2)) / I_(0) + square(1) * (I_(1) - I_(2)) / I_(1);
        const double less2 = square(0) * (I_(0) - I_(1)) / I_(0) + square(2) * (I_(2) - I_(1)) / I_(2);
        L_ = P.norm();
        A_ = std::sqrt(I_(0) * less3 / (I_(0) - I_(2)));
        B_ = std::sqrt(I_(1) * less3 / (I_(1) - I_(2)));
        C_ = std::sqrt(I_(2) * less1 / (I_(2) - I_(0)));
        lambda_ = C_ * std::sqrt((1 / I_(0) - 1 / I_(2)) * (1 / I_(1) - 1 / I_(2)));
        m1_ = less2 * (I_(2) - I_(0)) / (less1 * (I_(2) - I_(1)));
        n_ = I_(2) * (I_(0) - I_(1)) / (I_(0) * (I_(2) - I_(1)));
        kappa_ = 1 / I_(0) - 1 / I_(2);
        rate_ = (square(0) / I_(0) + square(1) / I_(1) + square(2) / I_(2)) / L_;
        const double amplification = std::abs(kappa_) / lambda_ * std::max(C_, L_ * std::abs(n_));
        if (!(amplification < 1e3) || !std::isfinite(n_) || !(m1_ >= 0)) return false;
        quarter_ = m1_ > 0 ? carlsonRf(0.0, m1_, 1.0) : std::numeric_limits<double>::infinity();
        thirdKind_ = m1_ > 0 ? n_ / 3 * carlsonRj(0.0, m1_, 1.0, 1 - n_) : 0;
        // Pi_1 >= 0 at the start by the renaming: u_0 is in the first or the last quarter.
        const double s = std::clamp(turn_ * P(1) / B_, -1.0, 1.0), c = P(0) / A_;
        u0_ = s * carlsonRf(c * c, P(2) * P(2) / (C_ * C_), 1.0);
        double angle = 0;
        place(u0_, angle, S0_);
        angle0_ = angle;
        return std::isfinite(u0_) && std::isfinite(angle0_);
    }

    void operator()(double t, std::span<double> x) const {
        Quaternion q;
        Vector Pi = Pi0_;
        if (isPermanent_) {
            q = so3::product(q0_, so3::quaternionExp(Vector(omega_ * (t - start_))));
        } else {
            double angle = 0;
            Quaternion S;
            Pi = names_.back(place(lambda_ * (t - start_) + u0_, angle, S));
            const double psi = rate_ * (t - start_) + kappa_ / lambda_ * (angle - angle0_);
            const Quaternion turned(std::cos(psi / 2), 0, 0, std::sin(psi / 2));
            const Quaternion r = so3::product(so3::conjugate(S0_), so3::product(turned, S));
            const Vector v = names_.back({r(1), r(2), r(3)});
            q = so3::product(q0_, Quaternion(r(0), v(0), v(1), v(2)));
        }
        q = so3::normalised(q);
        for (int i = 0; i < 4; ++i) x[static_cast<std::size_t>(i)] = q(i);
        for (int i = 0; i < 3; ++i) {
            x[static_cast<std::size_t>(4 + i)] = Pi(i);
            x[static_cast<std::size_t>(7 + i)] = pi_(i);
        }
    }

private:
    /// Chooses axis 3 and the order and signs of the others: Pi_3 > 0, Pi_1 >= 0, proper.
    void rename(const std::array<double, 3>& inertia) {
        std::array<int, 3> order{0, 1, 2};
        const auto I = [&](int i) { return inertia[static_cast<std::size_t>(i)]; };
        std::sort(order.begin(), order.end(), [&](int a, int b) { return I(a) < I(b); });
        const auto excess = [&](int i) { return Pi0_(i) * Pi0_(i) * (I(i) - I(order[1])) / I(i); };
        if (excess(order[0]) + excess(order[2]) < 0) std::swap(order[0], order[2]);
        names_.axis = order;
        const bool isEven = (order[1] - order[0] + 3) % 3 == 1;
        names_.sign = {1, isEven ? 1.0 : -1.0, 1};
        const auto flip = [&](std::size_t i, std::size_t j) {
            names_.sign[i] = -names_.sign[i];
            names_.sign[j] = -names_.sign[j];
        };
        if (names_.to(Pi0_)(2) < 0) flip(1, 2);
        if (names_.to(Pi0_)(0) < 0) flip(0, 1);
        I_ << I(order[0]), I(order[1]), I(order[2]);
        turn_ = 1 / I_(0) > 1 / I_(2) ? 1 : -1;
    }
    /// The momentum at u, S there, and the bracket of psi, continuous in u.
    Vector place(double u, double& angle, Quaternion& S) const {
        const double halves = std::isfinite(quarter_) ? std::round(u / (2 * quarter_)) : 0;
        const double v = halves == 0 ? u : u - 2 * quarter_ * halves;
        const double parity = std::fmod(std::abs(halves), 2) == 1 ? -1 : 1;
        const JacobiElliptic j(v, m1_);
        const double root = std::sqrt(1 - n_);
        const double third = n_ == 0 ? 0
                                     : n_ / 3 * j.sn * j.sn * j.sn *
                                           carlsonRj(j.cn * j.cn, j.dn * j.dn, 1.0, 1 - n_ * j.sn * j.sn);
        const double arc = (std::numbers::pi * halves + std::atan2(root * j.sn, j.cn)) / root;
        angle = C_ * C_ / L_ * u + L_ * (2 * halves * thirdKind_ + third) - C_ * arc;
        const Vector P(parity * A_ * j.cn, parity * turn_ * B_ * j.sn, C_ * j.dn);
        const double length = P.norm();
        S = so3::normalised(Quaternion(1 + P(2) / length, P(1) / length, -P(0) / length, 0));
        return P;
    }

    double start_ = 0, L_ = 0, A_ = 0, B_ = 0, C_ = 0, lambda_ = 0, m1_ = 1, n_ = 0, kappa_ = 0;
    double rate_ = 0, quarter_ = 0, thirdKind_ = 0, u0_ = 0, angle0_ = 0, turn_ = 1;
    bool isPermanent_ = false;
    Renaming names_;
    Vector I_, Pi0_, omega_, pi_;
    Quaternion q0_, S0_;
};

}  // namespace

ExactSolution freeBodyMotion(const std::array<double, 3>& inertia, const State& initial) {
    Motion motion;
    if (!motion.prepare(inertia, initial)) return {};
    return [motion](double t, std::span<double> x) { motion(t, x); };
}

}  // namespace extremal
