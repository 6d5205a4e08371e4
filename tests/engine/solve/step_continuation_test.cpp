// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps whose solution is followed from a short step, as their domain is too thin for Newton's method.
#include "engine/solve/step_continuation.hpp"

#include <QTest>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::step_continuation_test {
namespace {

using laws::systemNamed;
using Vector = Eigen::VectorXd;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A turn on the unit circle.
Vector turned(double part) {
    Vector Y(2);
    Y << std::cos(part) - 1, std::sin(part);
    return Y;
}

/// Solved where the starting value is near, as Newton's method does; nothing is solved from `end` on.
struct Circle {
    double nearness, end;
    int attempts = 0;
    bool follow(Vector& Y) {
        return StepContinuation<double>().follow(Y, [&](double part, bool isFresh) {
            ++attempts;
            if (part >= end || (isFresh ? part > 0.1 : (Y - turned(part)).norm() > nearness)) return false;
            Y = turned(part);
            return true;
        });
    }
};

/// A charge near the speed of light on a circle of radius v: L = -sqrt(1 - v^2) + g (x v_y - y v_x) / 2 with
/// g = (1 - v^2)^(-1/2).
struct Charge {
    double g, speed = std::sqrt(1 - 1 / (g * g));
    System system = systemNamed("lagrangian", {{"coordinates", Value::Array{"x", "y"}},
                                               {"parameters", Value::Object{{"g", g}}},
                                               {"lagrangian", "-sqrt(1-x_t^2-y_t^2)+g*(x*y_t-y*x_t)/2"}});
    State start{0, 0, {0, -speed, g* speed + g* speed / 2, 0}};

    /// p - dA/dt of the curve: the kinetic momentum.
    Eigen::Vector2d kinetic(const State& s) const {
        return {s.x[2] + g * s.x[1] / 2, s.x[3] - g * s.x[0] / 2};
    }
    double energy(const State& s) const { return std::sqrt(1 + kinetic(s).squaredNorm()); }
    /// How much of the two equations of the midpoint rule a step leaves over, relative to p.
    double residualOfMidpoint(const State& a, const State& b, double h) const {
        const double x = (a.x[0] + b.x[0]) / 2, y = (a.x[1] + b.x[1]) / 2, vx = (b.x[0] - a.x[0]) / h,
                     vy = (b.x[1] - a.x[1]) / h, mass = 1 / std::sqrt(1 - vx * vx - vy * vy);
        const Eigen::Vector2d force(g * vy / 2, -g * vx / 2), p(mass * vx - g * y / 2, mass * vy + g * x / 2),
            before(a.x[2], a.x[3]), after(b.x[2], b.x[3]);
        return ((p - before - h / 2 * force).norm() + (after - p - h / 2 * force).norm()) / before.norm();
    }
};

}  // namespace

class StepContinuationTest : public QObject {
    Q_OBJECT
private slots:
    void bendsWithTheCurve() {
        Circle circle{1e-3, 2};
        Vector Y = Vector::Zero(2);
        QVERIFY(circle.follow(Y));
        QVERIFY((Y - turned(1)).norm() == 0);
        QVERIFY2(circle.attempts < 25, qPrintable(QString::number(circle.attempts)));
    }
    void givesUpWhereTheCurveEnds() {
        Circle circle{1e-3, 0.6};
        Vector Y = Vector::Zero(2);
        QVERIFY(!circle.follow(Y));
        QVERIFY(circle.attempts <= 100);
    }
    void chargeNearTheSpeedOfLight_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("g");
        QTest::addColumn<int>("steps");
        for (const char* scheme : {"galerkin-gauss-1", "galerkin-gauss-2", "galerkin-lobatto-2"})
            for (const double g : {5.0, 200.0, 2000.0})
                for (const int steps : {16, 25})
                    QTest::addRow("%s, g = %g, %d steps a turn", scheme, g, steps) << scheme << g << steps;
    }
    void chargeNearTheSpeedOfLight() {
        QFETCH(QString, scheme);
        QFETCH(double, g);
        QFETCH(int, steps);
        const Charge charge{g};
        const double h = 2 * std::numbers::pi / steps, energy = charge.energy(charge.start);
        const auto integrator = makeIntegrator(charge.system, *namedScheme(scheme.toStdString()), {0, h});
        State s = charge.start;
        for (int k = 0; k < 2 * steps; ++k) {
            const State before = s;
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            // v = (q_1 - q_0) / h has the round-off of q over h, and 1 - v^2 is known g^2 times worse.
            if (scheme == "galerkin-gauss-1")
                QVERIFY(charge.residualOfMidpoint(before, s, h) < 8 * epsilon / h * g * g);
            QVERIFY(std::abs(charge.energy(s) / energy - 1) < 1e-12);
        }
    }
    /// Its steps have the length at which the energy is right, which takes many solutions each.
    void movingTimesNearTheSpeedOfLight() {
        const Charge charge{200};
        const double energy = charge.energy(charge.start);
        const auto integrator =
            makeIntegrator(charge.system, *namedScheme("sem-2"), {0, 2 * std::numbers::pi / 16});
        State s = charge.start;
        for (int k = 0; k < 16; ++k) {
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            QVERIFY(std::abs(charge.energy(s) / energy - 1) < 1e-11);
        }
        QVERIFY(s.t > 6);
    }
};

EXTREMAL_TEST(StepContinuationTest)
}  // namespace extremal::step_continuation_test
#include "step_continuation_test.moc"
