// SPDX-License-Identifier: GPL-3.0-or-later
/// Independent routes to the step on SE(3): the action written with R, x and their rates, nothing reduced and
/// nothing in body axes; an adaptive code on quaternions; the canonical form.
#include <QTest>

#include <algorithm>

#include "engine/action/table.hpp"
#include "engine/group/se3.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/laws/bodies.hpp"
#include "tests/tools/jacobian.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::motion_routes_test {
namespace {

using Complex = std::complex<double>;
using Ring = Dual<Complex, 1>;  // the dual part is the derivative by time
using Vector = so3::Vector<double>;
using Twist = se3::Vector<double>;
template <class T>
using Twists = std::vector<se3::Vector<T>>;

const char* const gravityGradient =
    "-mu*mass/sqrt(x^2+y^2+z^2) - mu/(2*(x^2+y^2+z^2)^(3/2))*(I1+I2+I3 - 3*(I1*(x*R11+y*R21+z*R31)^2"
    " + I2*(x*R12+y*R22+z*R32)^2 + I3*(x*R13+y*R23+z*R33)^2)/(x^2+y^2+z^2))";
constexpr Three inertia{0.12, 0.58, 0.61};

System satellite() {
    return systemNamed("rigid-body-se3", {{"inertia", listOf(inertia)},
                                          {"potential", gravityGradient},
                                          {"parameters", Value::Object{{"mu", 1.0}}}});
}
/// The same potential in C++.
Complex gravity(const so3::Vector<Complex>& x, const so3::Matrix<Complex>& R) {
    const Complex rr = so3::dot(x, x), r = std::sqrt(rr);
    const so3::Vector<Complex> rho = R.transpose() * x;
    Complex sum = 0, quadratic = 0;
    for (int i = 0; i < 3; ++i) {
        sum += inertia[static_cast<std::size_t>(i)];
        quadratic += inertia[static_cast<std::size_t>(i)] * rho(i) * rho(i);
    }
    return -1.0 / r - (sum - 3.0 * quadratic / rr) / (2.0 * r * rr);
}

State start() {
    State s = bodyState({0.05 * 0.12, 0.2 * 0.58, 1.25 * 0.61}, {0.5, -0.5, 0.5, 0.5});
    s.x.insert(s.x.end(), {0.8, 0.1, -0.2, 0.1, 1.2, 0.1});
    return s;
}
se3::Motion<double> placeOf(const std::vector<double>& x) {
    se3::Motion<double> g;
    g.rotation = so3::matrix(so3::Quaternion<double>(x[0], x[1], x[2], x[3]));
    g.position << x[10], x[11], x[12];
    return g;
}

struct Curve {
    se3::Motion<double> foot;
    Twists<double> xi;  ///< at the control points d_1 .. d_s = 1
};
Curve curveOf(const Integrator& integrator, const State& before, int degree) {
    Curve c{placeOf(before.x), {}};
    const std::vector<double> d = lobatto<double>(degree + 1).c;
    std::vector<double> x(16);
    for (int k = 1; k <= degree; ++k) {
        integrator.denseOutput(d[static_cast<std::size_t>(k)], x);
        c.xi.push_back(se3::log(se3::product(se3::inverse(c.foot), placeOf(x))));
    }
    return c;
}

/// S = h sum_i b_i [ 1/2 Omega . I Omega + 1/2 |x'|^2 - U(x, R) ], Omega = vee(R^T R'), after a complex
/// change of the foot (from the right) and of xi; its imaginary part is the derivative.
double actionSlope(const Curve& curve, const Rule<double>& rule, double h, const Twist& footBy,
                   const Twists<double>& xiBy) {
    const int degree = static_cast<int>(curve.xi.size());
    const Space<double> space = polynomialSpace<double>(degree, PolynomialBasis::lobatto);
    constexpr double tiny = 1e-40;
    const auto shifted = [&](const Twist& v, const Twist& by) {
        se3::Vector<Complex> r;
        for (int i = 0; i < 6; ++i) r(i) = Complex(v(i), tiny * by(i));
        return r;
    };
    const se3::Motion<Complex> change = se3::Exponential<Complex, 0>(shifted(Twist::Zero(), footBy)).motion();
    const se3::Motion<Complex> foot =
        se3::product({curve.foot.rotation.cast<Complex>(), curve.foot.position.cast<Complex>()}, change);
    Complex sum = 0;
    std::vector<double> value(static_cast<std::size_t>(degree + 1)), slope(value.size());
    for (std::size_t i = 0; i < rule.c.size(); ++i) {
        space.evaluate(rule.c[i], value, slope);
        se3::Vector<Complex> at = se3::Vector<Complex>::Zero(), rate = at;
        for (std::size_t k = 0; k < curve.xi.size(); ++k) {
            at += shifted(curve.xi[k], xiBy[k]) * value[k + 1];
            rate += shifted(curve.xi[k], xiBy[k]) * (slope[k + 1] / h);
        }
        // exp(omega) and dexp(omega)^T rho with their rates: dual numbers in time.
        so3::Vector<Ring> omega, rho;
        for (int j = 0; j < 3; ++j) {
            omega(j).value = at(j);
            omega(j).g[0] = rate(j);
            rho(j).value = at(3 + j);
            rho(j).g[0] = rate(3 + j);
        }
        const so3::Exponential<Ring, 0> chart(omega);
        const so3::Matrix<Ring> turning = chart.rotation();
        const so3::Vector<Ring> way = chart.dexpTransposed(rho);
        so3::Matrix<Complex> E, dE;
        so3::Vector<Complex> w, dw;
        for (int r = 0; r < 3; ++r) {
            w(r) = way(r).value;
            dw(r) = way(r).g[0];
            for (int c = 0; c < 3; ++c) {
                E(r, c) = turning(r, c).value;
                dE(r, c) = turning(r, c).g[0];
            }
        }
        const so3::Matrix<Complex> R = foot.rotation * E, spin = R.transpose() * (foot.rotation * dE);
        const so3::Vector<Complex> x = foot.position + foot.rotation * w, dx = foot.rotation * dw;
        const so3::Vector<Complex> W(spin(2, 1), spin(0, 2), spin(1, 0));
        Complex L = 0.5 * so3::dot(dx, dx) - gravity(x, R);
        for (int j = 0; j < 3; ++j) L += 0.5 * inertia[static_cast<std::size_t>(j)] * W(j) * W(j);
        sum += h * rule.b[i] * L;
    }
    return (sum / tiny).imag();
}

/// Largest residual of D_2 L_d(g_0, g_1) + D_1 L_d(g_1, g_2) = 0 and of the stationarity of the interior
/// points.
double eulerLagrangeResidual(const Discretization& discretization, double h, double spoil = 0) {
    const int degree = discretization.space.integer("degree");
    const Rule<double> rule = makeRule<double>(discretization.quadrature);
    const auto integrator = makeIntegrator(satellite(), discretization, {0, h});
    State s = start();
    std::array<Curve, 2> curves;
    for (Curve& c : curves) {
        const State before = s;
        s = after(*integrator, s, 1).value();
        c = curveOf(*integrator, before, degree);
    }
    curves[1].xi[0](0) += spoil;
    const Twists<double> none(static_cast<std::size_t>(degree), Twist::Zero());
    double worst = 0;
    for (const Curve& c : curves)
        for (int k = 0; k + 1 < degree; ++k)
            for (int j = 0; j < 6; ++j) {
                Twists<double> by = none;
                by[static_cast<std::size_t>(k)] = Twist::Unit(j);
                worst = std::max(worst, std::abs(actionSlope(c, rule, h, Twist::Zero(), by)));
            }
    for (int j = 0; j < 6; ++j) {
        // g_1 exp(zeta): the tip of the first curve, the foot of the second with its tip held.
        const Twist zeta = Twist::Unit(j), first = curves[0].xi.back(), second = curves[1].xi.back();
        Twists<double> tip = none, held = none;
        tip.back() = se3::Exponential<double, 1>(first).dexpInverseMatrix() * zeta;
        held.back() = -(se3::Exponential<double, 1>(Twist(-second)).dexpInverseMatrix() * zeta);
        worst = std::max(worst, std::abs(actionSlope(curves[0], rule, h, Twist::Zero(), tip) +
                                         actionSlope(curves[1], rule, h, zeta, held)));
    }
    return worst;
}

using Tangent = Eigen::Matrix<double, 12, 1>;
/// The state moved by zeta in the body (turn, then shift) and by the change of the momentum in the body.
State moved(const State& s, const Tangent& v) {
    const se3::Motion<double> g =
        se3::product(placeOf(s.x), se3::Exponential<double, 0>(Twist(v.head<6>())).motion());
    const so3::Quaternion<double> q = so3::quaternion(g.rotation);
    const Vector linear = placeOf(s.x).rotation.transpose() * Vector(s.x[13], s.x[14], s.x[15]) + v.tail<3>();
    const Vector p = g.rotation * linear;
    State r = bodyState({s.x[4] + v(6), s.x[5] + v(7), s.x[6] + v(8)}, {q(0), q(1), q(2), q(3)});
    for (const Vector& w : {g.position, p}) r.x.insert(r.x.end(), w.data(), w.data() + 3);
    return r;
}
/// The momentum in the body, six numbers.
Twist momentumOf(const State& s) {
    Twist m;
    m << s.x[4], s.x[5], s.x[6], placeOf(s.x).rotation.transpose() * Vector(s.x[13], s.x[14], s.x[15]);
    return m;
}
Tangent between(const State& s, const State& x) {
    Tangent v;
    v << se3::log(se3::product(se3::inverse(placeOf(s.x)), placeOf(x.x))), momentumOf(x) - momentumOf(s);
    return v;
}
/// w(u, v) = u_z . v_m - u_m . v_z + m . [u_z, v_z].
Eigen::Matrix<double, 12, 12> canonicalForm(const State& s, double sign) {
    Eigen::Matrix<double, 12, 12> w = Eigen::Matrix<double, 12, 12>::Zero();
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            w(i, j) = sign * momentumOf(s).dot(se3::bracket(Twist(Twist::Unit(i)), Twist(Twist::Unit(j))));
    w.topRightCorner<6, 6>().setIdentity();
    w.bottomLeftCorner<6, 6>() = -Eigen::Matrix<double, 6, 6>::Identity();
    return w;
}
double symplecticDefect(const Discretization& discretization, double sign) {
    constexpr double delta = 1e-3;
    constexpr std::array<double, 3> c = centralDifferences;
    const System system = satellite();
    const auto step = [&](const State& s) {
        return after(*makeIntegrator(system, discretization, {0, 0.2}), s, 1).value();
    };
    const State end = step(start());
    Eigen::Matrix<double, 12, 12> M = Eigen::Matrix<double, 12, 12>::Zero();
    for (int j = 0; j < 12; ++j)
        for (int k = 1; k <= 3; ++k)
            for (const int side : {1, -1}) {
                const Tangent v = side * k * delta * Tangent::Unit(j);
                M.col(j) +=
                    side * c[static_cast<std::size_t>(k - 1)] / delta * between(end, step(moved(start(), v)));
            }
    return (M.transpose() * canonicalForm(end, sign) * M - canonicalForm(start(), sign)).norm();
}

}  // namespace

class MotionRoutesTest : public QObject {
    Q_OBJECT
private slots:
    void theUnreducedEquationsHoldOnTheTrajectory() {
        for (int degree = 1; degree <= 4; ++degree)
            for (const char* rule : {"gauss", "lobatto"}) {
                const Discretization discretization = liePair(degree, {rule, {}, {}});
                const double r = eulerLagrangeResidual(discretization, 0.2),
                             broken = eulerLagrangeResidual(discretization, 0.2, 1e-6);
                qInfo("degree %d, %s: %.1e; a curve that is 1e-6 off: %.1e", degree, rule, r, broken);
                QVERIFY(r < 1e-13);  // measured: at most 1.0e-14
                QVERIFY(broken > 1e-8);
            }
    }
    void anAdaptiveCodeOnQuaternionsArrivesAtTheSamePlace() {
        const System system = satellite();
        const Settings keys{"dopri5-quaternion", {{"projection", true}}, {}};
        const auto other = findBaseline("dopri5-quaternion")->make(system, {0.1, {}, 1e-13, keys});
        State right = start();
        while (right.t < 5 - 1e-12) QVERIFY(other->advance(right, 5).outcome == Outcome::converged);
        for (const int degree : {4, 6, 8}) {
            const auto end = after(*makeIntegrator(system, liePair(degree), {0, 0.05}), start(), 100);
            const double angle = attitudeError(end->x, {right.x[0], right.x[1], right.x[2], right.x[3]});
            const double place = distance(end->x, right.x, 10, 13),
                         momentum = distance(end->x, right.x, 4, 10);
            qInfo("degree %d: attitude %.1e, position %.1e, momenta %.1e", degree, angle, place, momentum);
            QVERIFY(std::max({angle, place, momentum}) < 1e-11);  // degree 4: 1.2e-12, degree 8: 3.5e-13
        }
        const auto coarse = after(*makeIntegrator(system, liePair(1), {0, 0.05}), start(), 100);
        QVERIFY(distance(coarse->x, right.x, 10, 13) >
                1e-6);  // it is the scheme that agrees, not the measure
    }
    void theStepIsSymplectic() {
        for (int degree = 1; degree <= 4; ++degree)
            for (const LieForm& form : lieForms) {
                const Discretization discretization = lieFormed(degree, form);
                const double defect = symplecticDefect(discretization, 1),
                             broken = symplecticDefect(discretization, -1);
                qInfo("degree %d%s: %.1e; with the wrong sign of the bracket %.1e", degree, form.name, defect,
                      broken);
                QVERIFY(defect < 2e-11);  // measured: at most 3.6e-12
                QVERIFY(broken > 1e-3);
            }
    }
};

EXTREMAL_TEST(MotionRoutesTest)
}  // namespace extremal::laws::motion_routes_test

#include "motion_routes_test.moc"
