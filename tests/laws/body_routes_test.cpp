// SPDX-License-Identifier: GPL-3.0-or-later
/// Independent routes to the Lie group step: the action written with matrices g and g' and nothing reduced,
/// rotation vectors as coordinates with the Galerkin step of mechanical systems, and turned starts.
#include <QTest>

#include <Eigen/LU>

#include "engine/action/table.hpp"
#include "engine/integrator/galerkin_step.hpp"
#include "engine/model/bind.hpp"
#include "engine/space/polynomial.hpp"
#include "tests/laws/bodies.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::body_routes_test {
namespace {

using Complex = std::complex<double>;
using Ring = Dual<Complex, 1>;  // the dual part is the derivative by time
using Matrix = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

Vector vee(const Matrix& m) { return {m(2, 1), m(0, 2), m(1, 0)}; }

/// The curve of one step, found from the integrator's own curve: where it starts, and xi at the control
/// points.
struct Curve {
    Matrix foot;
    std::vector<Vector> xi;  ///< at d_1 .. d_s = 1
};
Curve curveOf(const Integrator& integrator, const State& before, int degree) {
    Curve c;
    const auto rotation = [](const std::vector<double>& x) {
        return Matrix(so3::matrix(so3::Quaternion<double>(x[0], x[1], x[2], x[3])));
    };
    c.foot = rotation(before.x);
    const std::vector<double> d = lobatto<double>(degree + 1).c;
    std::vector<double> x(10);
    for (int k = 1; k <= degree; ++k) {
        integrator.denseOutput(d[static_cast<std::size_t>(k)], x);
        c.xi.push_back(so3::log(so3::Matrix<double>(c.foot.transpose() * rotation(x))));
    }
    return c;
}

/// S = h sum_i b_i [ 1/2 Omega . I Omega - U(g) ], Omega = vee(g^T g'), from the matrices g = foot exp(xi)
/// and g' alone, after a complex change of the foot (from the right) and of xi.
Complex action(const Curve& curve, const KnownBody& body, const Rule<double>& rule, double h,
               const Vector& footBy, const std::vector<Vector>& xiBy) {
    const int degree = static_cast<int>(curve.xi.size());
    const Space<double> space = polynomialSpace<double>(degree, PolynomialBasis::lobatto);
    constexpr double tiny = 1e-40;
    const auto shifted = [&](const Vector& v, const Vector& by) {
        so3::Vector<Complex> r;
        for (int i = 0; i < 3; ++i) r(i) = Complex(v(i), tiny * by(i));
        return r;
    };
    const so3::Matrix<Complex> foot =
        curve.foot.cast<Complex>() * so3::Exponential<Complex, 0>(shifted(Vector::Zero(), footBy)).rotation();
    Complex sum = 0;
    std::vector<double> value(static_cast<std::size_t>(degree + 1)), slope(value.size());
    for (std::size_t i = 0; i < rule.c.size(); ++i) {
        space.evaluate(rule.c[i], value, slope);
        so3::Vector<Ring> xi;
        xi.setConstant(Ring(Complex(0)));
        for (std::size_t k = 0; k < curve.xi.size(); ++k) {
            const so3::Vector<Complex> z = shifted(curve.xi[k], xiBy[k]);
            for (int j = 0; j < 3; ++j) {
                xi(j).value += z(j) * value[k + 1];
                xi(j).g[0] += z(j) * slope[k + 1] / h;
            }
        }
        const so3::Matrix<Ring> moving = so3::Exponential<Ring, 0>(xi).rotation();
        so3::Matrix<Complex> E, dE;
        for (int r = 0; r < 3; ++r)
            for (int c = 0; c < 3; ++c) {
                E(r, c) = moving(r, c).value;
                dE(r, c) = moving(r, c).g[0];
            }
        const so3::Matrix<Complex> g = foot * E, rate = g.transpose() * (foot * dE);
        const so3::Vector<Complex> w(rate(2, 1), rate(0, 2), rate(1, 0));
        Complex L = 0;
        for (int j = 0; j < 3; ++j) {
            const auto k = static_cast<std::size_t>(j);
            L += 0.5 * body.inertia[k] * w(j) * w(j) - body.centre[k] * g(2, j);
        }
        sum += h * rule.b[i] * L;
    }
    return sum / tiny;
}

/// Largest residual of the unreduced discrete Euler-Lagrange equations over two steps, D_2 L_d(g_0, g_1) +
/// D_1 L_d(g_1, g_2) and the stationarity of the interior points.
double eulerLagrangeResidual(const KnownBody& body, const Discretization& discretization, double h,
                             double spoil = 0) {
    const int degree = discretization.space.integer("degree");
    const Rule<double> rule = makeRule<double>(discretization.quadrature);
    const auto integrator = makeIntegrator(body.system(), discretization, {0, h});
    State s = bodyState(body.start, {0.5, -0.5, 0.5, 0.5});
    std::array<Curve, 2> curves;
    for (Curve& c : curves) {
        const State before = s;
        s = after(*integrator, s, 1).value();
        c = curveOf(*integrator, before, degree);
    }
    curves[1].xi[0](0) += spoil;
    const std::vector<Vector> none(static_cast<std::size_t>(degree), Vector::Zero());
    double worst = 0;
    for (const Curve& c : curves)
        for (int k = 0; k + 1 < degree; ++k)
            for (int j = 0; j < 3; ++j) {
                std::vector<Vector> by = none;
                by[static_cast<std::size_t>(k)] = Vector::Unit(j);
                worst = std::max(worst, std::abs(action(c, body, rule, h, Vector::Zero(), by).imag()));
            }
    for (int j = 0; j < 3; ++j) {
        // g_1 exp(zeta): the tip of the first curve, the foot of the second with its tip held.
        const Vector zeta = Vector::Unit(j);
        const Vector first = curves[0].xi.back(), second = curves[1].xi.back();
        std::vector<Vector> tip = none, held = none;
        tip.back() = so3::Exponential<double, 1>(first).dexpInverseMatrix() * zeta;
        held.back() = -(so3::Exponential<double, 1>(Vector(-second)).dexpInverseMatrix() * zeta);
        const double sum = action(curves[0], body, rule, h, Vector::Zero(), tip).imag() +
                           action(curves[1], body, rule, h, zeta, held).imag();
        worst = std::max(worst, std::abs(sum));
    }
    return worst;
}

/// The free body in one chart, fixed in space: coordinates are the rotation vector from the identity.
struct RotationVectors {
    static constexpr int dimension = 3;
    Three inertia{1, 2, 3};

    template <class T, class S>
    S lagrangian(const T&, const std::array<S, 3>& q, const std::array<S, 3>& v) const {
        const S x = square(q[0]) + square(q[1]) + square(q[2]);
        S a, b;
        if constexpr (Differentiable<S>) {
            const auto c = so3::coefficients<2>(x.value);
            a = x.chain(c.a[0], c.a[1], c.a[2]);
            b = x.chain(c.b[0], c.b[1], c.b[2]);
        } else {
            const auto c = so3::coefficients<0>(x);
            a = c.a[0];
            b = c.b[0];
        }
        const auto times = [](const std::array<S, 3>& u, const std::array<S, 3>& w) {
            return std::array<S, 3>{u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                                    u[0] * w[1] - u[1] * w[0]};
        };
        const auto qv = times(q, v), qqv = times(q, qv);
        S sum(T(0));
        for (std::size_t i = 0; i < 3; ++i)
            sum = sum + square(v[i] - a * qv[i] + b * qqv[i]) * T(inertia[i] / 2);
        return sum;
    }
};

/// Attitude after n steps of the Galerkin step in the fixed chart, from q with the body momentum Pi.
so3::Quaternion<double> fixedChart(int degree, double h, int n, const so3::Quaternion<double>& q,
                                   const Vector& Pi) {
    const Table<double> table =
        makeTable(polynomialSpace<double>(degree, PolynomialBasis::lobatto), gauss<double>(degree));
    GalerkinStep<double, 3> step(bindMechanics<double>(RotationVectors{}), table, h, {});
    Vector x = so3::log(q);
    Vector p = so3::Exponential<double, 0>(x).dexpTransposed(Pi);
    for (int k = 0; k < n; ++k)
        if (step.advance(h * k, x.data(), p.data(), {}).outcome != Outcome::converged) return {0, 0, 0, 0};
    return so3::quaternionExp(x);
}
double angleBetween(const so3::Quaternion<double>& a, const so3::Quaternion<double>& b) {
    return attitudeError({a(0), a(1), a(2), a(3)}, {b(0), b(1), b(2), b(3)});
}

}  // namespace

class BodyRoutesTest : public QObject {
    Q_OBJECT
private slots:
    void theUnreducedEquationsHoldOnTheTrajectory() {
        for (const KnownBody* body : {&standard(), &top()})
            for (int degree = 1; degree <= 4; ++degree)
                for (const char* rule : {"gauss", "lobatto"}) {
                    const double h = body == &top() ? 0.2 : 0.5;
                    const double r = eulerLagrangeResidual(*body, liePair(degree, {rule, {}, {}}), h);
                    const double broken =
                        eulerLagrangeResidual(*body, liePair(degree, {rule, {}, {}}), h, 1e-6);
                    qInfo("%s, degree %d, %s: %.1e; a curve that is 1e-6 off: %.1e", body->name.c_str(),
                          degree, rule, r, broken);
                    QVERIFY(r < 1e-13);  // measured: at most 2.1e-14
                    QVERIFY(broken > 1e-8);
                }
    }
    void aTurnedStartGivesTheTurnedMotion() {
        // Any turn for the free body, turns about the vertical for the top.
        for (const bool isTop : {false, true})
            for (int degree = 1; degree <= 4; ++degree)
                for (const LieForm& form : lieForms) {
                    const KnownBody& body = isTop ? top() : standard();
                    const so3::Quaternion<double> turn = so3::quaternionExp(
                        isTop ? so3::Vector<double>(0, 0, 1.1) : so3::Vector<double>(0.7, -1.2, 0.4));
                    const auto run = [&](const so3::Quaternion<double>& q) {
                        const auto integrator =
                            makeIntegrator(body.system(), lieFormed(degree, form), {0, 0.2});
                        return after(*integrator, bodyState(body.start, {q(0), q(1), q(2), q(3)}), 50)->x;
                    };
                    const auto plain = run({1, 0, 0, 0}), turned = run(turn);
                    const auto expected =
                        so3::product(turn, so3::Quaternion<double>(plain[0], plain[1], plain[2], plain[3]));
                    const double defect =
                        std::max(attitudeError(turned, {expected(0), expected(1), expected(2), expected(3)}),
                                 momentumError(turned, {plain[4], plain[5], plain[6]}));
                    qInfo("%s, degree %d: %.1e", body.name.c_str(), degree, defect);
                    QVERIFY(defect < 1e-13);
                }
    }
    void oneChartForAllIsNotEquivariantButConverges() {
        const Vector Pi(std::cos(1.1), 0, std::sin(1.1));
        const so3::Quaternion<double> here(1, 0, 0, 0), turn = so3::quaternionExp(Vector(0.9, -1.0, 0.5));
        std::vector<double> h, error;
        double defect = 0;
        for (const int n : {4, 8, 16}) {
            const double step = 2.0 / n;
            const auto plain = fixedChart(2, step, n, here, Pi), turned = fixedChart(2, step, n, turn, Pi);
            if (n == 4) defect = angleBetween(so3::product(turn, plain), turned);
            const auto right = after(*makeIntegrator(standard().system(), liePair(8), {0, 0.1}),
                                     bodyState(standard().start), 20);
            const Four q{right->x[0], right->x[1], right->x[2], right->x[3]};
            h.push_back(std::log(step));
            error.push_back(std::log(
                angleBetween(so3::product(turn, so3::Quaternion<double>(q[0], q[1], q[2], q[3])), turned)));
        }
        qInfo("fixed chart: defect %.1e at h = 0.5, order %.2f", defect, slope(h, error));
        QVERIFY(defect > 1e-6);
        QVERIFY(std::abs(slope(h, error) - 4) < 0.3);
        // In one step from the foot of its chart it is the Lie group step's curve, but not its momentum.
        const auto natural =
            after(*makeIntegrator(standard().system(), liePair(2), {0, 0.5}), bodyState(standard().start), 1);
        const auto fixed = fixedChart(2, 0.5, 1, here, Pi);
        QVERIFY(attitudeError(natural->x, {fixed(0), fixed(1), fixed(2), fixed(3)}) < 1e-3);
    }
};

EXTREMAL_TEST(BodyRoutesTest)
}  // namespace extremal::laws::body_routes_test

#include "body_routes_test.moc"
