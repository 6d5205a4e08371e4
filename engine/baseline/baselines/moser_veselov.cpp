// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete Moser-Veselov algorithm of the free body, and its higher orders by preprocessed moments of
/// inertia.
///
/// A step turns the body by exp(xi), where J is the matrix of the moments of inertia and
///     h Pi = s J xi + a xi x J xi,      Pi_1 = exp(xi)^T Pi          (s, a: group/so3.hpp)
/// (Moser and Veselov 1991; McLachlan and Zanna 2005). It keeps momentum and energy, and only the time is
/// wrong: its modified equation turns the body at (1 + O(h^2)) I^{-1} Pi + O(h^2) Pi. With
///     1 / J_i = (1 + h^2 s_3 + h^4 s_5) / I_i + h^2 d_3 + h^4 d_5
/// in place of I the modified equation is exact to order 4 (s_3, d_3) or 6 (Hairer and Vilmart 2006). With
/// e_1, e_2, e_3 the elementary symmetric functions of 1 / I_i, H the energy and C = |Pi|^2 / 2:
///     s_3 = -e_1 H / 3 + e_2 C / 6,     d_3 = e_2 H / 6 - e_3 C / 3,
///     s_5 = (e_1^2 / 30 - e_2 / 60) H^2 + (2 e_3 / 15 - e_1 e_2 / 30) H C + (e_2^2 / 30 - e_1 e_3 / 10) C^2,
///     d_5 = -(e_3 / 10 + e_1 e_2 / 60) H^2 + (2 e_1 e_3 / 15 - e_2^2 / 60) H C - e_2 e_3 C^2 / 60,
/// found by matching the series of xi with that of the exact rotation in rational numbers.

#include <cmath>
#include <limits>

#include "engine/baseline/body_method.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"
#include "engine/family/parts/conditions.hpp"

namespace extremal::baselines {
namespace {

class MoserVeselov final : public BodyMethodOf<MoserVeselov> {
    friend BodyMethodOf;
    using Matrix = so3::Matrix<double>;

public:
    MoserVeselov(const System& system, const BaselineOptions& options)
        : BodyMethodOf(system, options.step), order_(options.settings.integer("order")) {}

private:
    bool turnsMomentum() const override { return true; }

    template <class T>
    so3::Vector<T> inertia(const so3::Vector<T>& Pi, double h) const {
        const Vector w(1 / body_.inertia[0], 1 / body_.inertia[1], 1 / body_.inertia[2]);
        const T H = so3::dot(Pi, omega(Pi)) * 0.5, C = so3::dot(Pi, Pi) * 0.5;
        const double e1 = w.sum(), e2 = w(0) * w(1) + w(1) * w(2) + w(2) * w(0), e3 = w(0) * w(1) * w(2),
                     hh = h * h;
        T s(1), d(0);
        if (order_ >= 4) {
            s += (C * (e2 / 6) - H * (e1 / 3)) * hh;
            d += (H * (e2 / 6) - C * (e3 / 3)) * hh;
        }
        if (order_ >= 6) {
            s += (H * H * (e1 * e1 / 30 - e2 / 60) + H * C * (2 * e3 / 15 - e1 * e2 / 30) +
                  C * C * (e2 * e2 / 30 - e1 * e3 / 10)) *
                 (hh * hh);
            d += (H * C * (2 * e1 * e3 / 15 - e2 * e2 / 60) - H * H * (e3 / 10 + e1 * e2 / 60) -
                  C * C * (e2 * e3 / 60)) *
                 (hh * hh);
        }
        so3::Vector<T> J;
        for (int i = 0; i < 3; ++i) J(i) = T(1) / (s * w(i) + d);
        return J;
    }

    /// s J xi + a xi x J xi - target.
    template <class T>
    static so3::Vector<T> defect(const Vector& xi, const so3::Vector<T>& J, const so3::Vector<T>& target) {
        const auto c = so3::coefficients<0>(xi.squaredNorm());
        so3::Vector<T> Jxi;
        for (int i = 0; i < 3; ++i) Jxi(i) = J(i) * xi(i);
        return Jxi * T(c.s) + so3::cross(so3::Vector<T>(xi.template cast<T>()), Jxi) * T(c.a[0]) - target;
    }
    /// Its derivative by xi.
    static Matrix slope(const Vector& xi, const Vector& J) {
        const double x = xi.squaredNorm();
        const auto c = so3::coefficients<1>(x);
        const Vector Jxi = J.cwiseProduct(xi), turned = so3::cross(xi, Jxi);
        const double ds = -c.b[0] - x * c.b[1];  // ds/dx
        return c.s * Matrix(J.asDiagonal()) + c.a[0] * (so3::hat(xi) * J.asDiagonal() - so3::hat(Jxi)) +
               (2 * ds * Jxi + 2 * c.a[1] * turned) * xi.transpose();
    }
    /// Newton's method; NaN where it fails, with the outcome in report_.
    Vector solve(const Vector& J, const Vector& target) {
        Vector xi = target.cwiseQuotient(J);
        const CorrectionLimits limits{.last = 4 * CorrectionLimits::epsilon, .roundOff = 1e-11};
        report_.outcome = solveByCorrections(limits, stop(), report_, [&](int, double) {
            const Vector change = slope(xi, J).partialPivLu().solve(defect(xi, J, target));
            xi -= change;
            ++report_.cost.evaluations;
            ++report_.cost.linearSolves;
            return Correction{change.norm(), xi.norm()};
        });
        // Beyond pi the nearest solution is another one than that of the motion.
        if (report_.outcome == Outcome::converged && !(xi.norm() < 3.1415926))
            report_.outcome = Outcome::diverged;
        else if (report_.outcome != Outcome::converged)
            xi.setConstant(std::numeric_limits<double>::quiet_NaN());
        return xi;
    }

    void move(BodyMotion<double>& m, double h) {
        const Vector xi = solve(inertia(m.momentum, h), h * m.momentum);
        if (report_.outcome == Outcome::converged)
            m.q = so3::normalised(so3::product(m.q, so3::quaternionExp(xi)));
    }
    /// The solution does not vary by itself: dF/dxi dxi = -dF at xi.
    void move(BodyMotion<Varied>& m, double h) {
        const so3::Vector<Varied> J = inertia(m.momentum, h), target = m.momentum * Varied(h);
        const Vector xi = solve(values(J), values(target)),
                     change = slope(xi, values(J)).partialPivLu().solve(slopes(defect(xi, J, target)));
        // exp(xi + d) = exp(xi) exp(dexp(xi) d) to first order.
        const Vector rate = so3::Exponential<double>(xi).dexp(-change);
        const so3::Quaternion<double> turn = so3::quaternionExp(xi),
                                      along = so3::product(
                                          turn,
                                          so3::Quaternion<double>(0, rate(0) / 2, rate(1) / 2, rate(2) / 2));
        so3::Quaternion<Varied> turned;
        for (int i = 0; i < 4; ++i) {
            turned(i) = Varied(turn(i));
            turned(i).g[0] = along(i);
        }
        m.q = so3::normalised(so3::product(m.q, turned));
    }

    int order_;
};

}  // namespace

BaselineEntry moser_veselov() {
    FieldInfo order = integerField(
        "order", "", 2, 6, 2, "The algorithm itself (2), or with preprocessed moments of inertia (4, 6).");
    order.choices = {"2", "4", "6"};
    BaselineEntry e;
    e.item = {"moser-veselov",
              "Moser-Veselov",
              "The discrete free body of Moser and Veselov: keeps momentum and energy, errs in time.",
              {order},
              Claims{2, true, true, {"momentum", "energy"}},
              "a free rigid body"};
    e.parts.set(ClaimsOfKeys{[](const Settings& settings) {
        // Moments that depend on the state leave the step a Poisson map of the momentum, but not symplectic
        // with the attitude.
        const int claimed = settings.integer("order");
        return Claims{claimed, true, claimed == 2, {"momentum", "energy"}};
    }});
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.takes = Takes::only<Body>();
    e.parts.set(SystemCondition{
        [](const System& system) { return system.body().dimension == 3 && system.body().isFree(); }});
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<MoserVeselov>(system, options);
    };
    return e;
}

}  // namespace extremal::baselines
