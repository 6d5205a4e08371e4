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
#include <Eigen/LU>

#include <cmath>
#include <limits>

#include "engine/baseline/body_method.hpp"

namespace extremal::baselines {
namespace {

class MoserVeselov final : public BodyMethod {
    using Matrix = so3::Matrix<double>;

public:
    MoserVeselov(const System& system, const BaselineOptions& options)
        : BodyMethod(system, options.step), order_(options.settings.integer("order")) {}

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MoserVeselov>(*this); }

private:
    bool turnsMomentum() const override { return true; }

    Vector inertia(const Vector& Pi, double h) const {
        const Vector w(1 / body_.inertia[0], 1 / body_.inertia[1], 1 / body_.inertia[2]);
        const double H = 0.5 * Pi.dot(w.cwiseProduct(Pi)), C = 0.5 * Pi.squaredNorm();
        const double e1 = w.sum(), e2 = w(0) * w(1) + w(1) * w(2) + w(2) * w(0), e3 = w(0) * w(1) * w(2),
                     hh = h * h;
        double s = 1, d = 0;
        if (order_ >= 4) {
            s += hh * (e2 * C / 6 - e1 * H / 3);
            d += hh * (e2 * H / 6 - e3 * C / 3);
        }
        if (order_ >= 6) {
            s += hh * hh *
                 ((e1 * e1 / 30 - e2 / 60) * H * H + (2 * e3 / 15 - e1 * e2 / 30) * H * C +
                  (e2 * e2 / 30 - e1 * e3 / 10) * C * C);
            d += hh * hh *
                 (-(e3 / 10 + e1 * e2 / 60) * H * H + (2 * e1 * e3 / 15 - e2 * e2 / 60) * H * C -
                  e2 * e3 / 60 * C * C);
        }
        return (s * w + Vector::Constant(d)).cwiseInverse();
    }

    void step(Motion& m, double h) override {
        const Vector J = inertia(m.momentum, h), target = h * m.momentum;
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        Vector xi = target.cwiseQuotient(J);
        double last = std::numeric_limits<double>::infinity();
        for (int iteration = 0; iteration < 50; ++iteration) {
            if (stop().stop_requested()) {
                report_.outcome = Outcome::stopped;
                return;
            }
            const double x = xi.squaredNorm();
            const auto c = so3::coefficients<1>(x);
            const Vector Jxi = J.cwiseProduct(xi), turned = so3::cross(xi, Jxi);
            const Vector F = c.s * Jxi + c.a[0] * turned - target;
            const double slope = -c.b[0] - x * c.b[1];  // ds/dx
            Matrix D = c.s * Matrix(J.asDiagonal()) +
                       c.a[0] * (so3::hat(xi) * J.asDiagonal() - so3::hat(Jxi)) +
                       (2 * slope * Jxi + 2 * c.a[1] * turned) * xi.transpose();
            const Vector change = D.partialPivLu().solve(F);
            xi -= change;
            ++report_.cost.iterations;
            ++report_.cost.evaluations;
            ++report_.cost.linearSolves;
            const double size = change.norm();
            report_.residual = size / std::max(xi.norm(), 1e-300);
            if (!std::isfinite(size)) {
                report_.outcome = Outcome::notFinite;
                return;
            }
            if (size <= 4 * epsilon * xi.norm() || (size < 1e-11 * xi.norm() && size >= 0.25 * last)) {
                // Beyond pi the nearest solution is another one than that of the motion.
                if (!(xi.norm() < 3.1415926)) report_.outcome = Outcome::diverged;
                m.q = so3::normalised(so3::product(m.q, so3::quaternionExp(xi)));
                return;
            }
            last = size;
        }
        report_.outcome = Outcome::diverged;
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
    e.claims = [](const Settings& settings) {
        // Moments that depend on the state leave the step a Poisson map of the momentum, but not symplectic
        // with the attitude.
        const int claimed = settings.integer("order");
        return Claims{claimed, true, claimed == 2, {"momentum", "energy"}};
    };
    e.stabilityLimit = std::numeric_limits<double>::infinity();
    e.applies = [](const System& system) {
        return isBody(system) && system.body().dimension == 3 && system.body().isFree();
    };
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<MoserVeselov>(system, options);
    };
    return e;
}

}  // namespace extremal::baselines
