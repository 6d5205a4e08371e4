// SPDX-License-Identifier: GPL-3.0-or-later
/// The fixed point on the velocities at the nodes, for Lagrangians that are not separable.
#include <QTest>

#include <cmath>
#include <memory>

#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::velocity_iteration_test {
namespace {

using laws::systemNamed;

Discretization gauss(int degree, const char* method = "auto") {
    Discretization d = *namedScheme("galerkin-gauss-" + std::to_string(degree));
    d.solver = {method, {}, {}};
    return d;
}
/// Two coordinates with a mass that depends on the place, and a rotation that the Lagrangian does not see.
System heavier() {
    return systemNamed("lagrangian",
                       {{"coordinates", Value::Array{"x", "y"}},
                        {"lagrangian", "(1+x^2+y^2)*(x_t^2+y_t^2)/2 - (x^2+y^2)/2 - (x^2+y^2)^2/4"}});
}
/// Three, of which two are coupled by their velocities.
System coupled() {
    return systemNamed(
        "lagrangian",
        {{"coordinates", Value::Array{"x", "y", "z"}},
         {"lagrangian",
          "x_t^2/2 + y_t^2 + (2+sin(x))*z_t^2/2 + cos(x-y)*x_t*y_t/2 + z*x_t - x^2 - y^4 - z^2"}});
}
const State springStart{0, 0, {0.05, 1, 0, 0}}, heavierStart{0, 0, {1, 0, 0.1, 0.5}},
    coupledStart{0, 0, {1, 0, 0.5, 0.2, 0.3, 0.4}};

/// Sweeps or Newton iterations and linear solves of the steps of a run, and where it ends.
struct Run {
    Cost cost;
    State end;
};
Run run(const System& system, State s, const Discretization& d, double h, int steps) {
    Run r;
    const auto integrator = makeIntegrator(system, d, {0, h});
    for (int i = 0; i < steps; ++i) {
        const StepReport report = advance(*integrator, s);
        if (report.outcome != Outcome::converged) qFatal("step %d", i);
        r.cost += report.cost;
    }
    r.end = s;
    return r;
}

}  // namespace

class VelocityIterationTest : public QObject {
    Q_OBJECT
private slots:
    void endsWhereNewtonDoes_data() {
        QTest::addColumn<int>("which");
        QTest::addColumn<int>("degree");
        for (const int degree : {1, 2, 5, 8, 12})
            for (const int which : {0, 1, 2})
                QTest::addRow("%s, degree %d",
                              which == 0   ? "spring"
                              : which == 1 ? "heavier"
                                           : "coupled",
                              degree)
                    << which << degree;
    }
    void endsWhereNewtonDoes() {
        QFETCH(int, which);
        QFETCH(int, degree);
        const System system = which == 0   ? systemNamed("spring-pendulum")
                              : which == 1 ? heavier()
                                           : coupled();
        const State start = which == 0 ? springStart : which == 1 ? heavierStart : coupledStart;
        const double h = which == 0 ? 0.002 : 0.02;
        const Run sweeps = run(system, start, gauss(degree), h, 50),
                  newton = run(system, start, gauss(degree, "newton"), h, 50);
        QCOMPARE(sweeps.cost.linearSolves, 0);
        QVERIFY(newton.cost.linearSolves > 0);
        for (std::size_t i = 0; i < start.x.size(); ++i)
            QVERIFY2(std::abs(sweeps.end.x[i] - newton.end.x[i]) < 2e-13 * (1 + std::abs(newton.end.x[i])),
                     qPrintable(QString::number(sweeps.end.x[i] - newton.end.x[i])));
    }
    /// Angular momentum is quadratic in the state: exact up to the sum of what rounding leaves.
    void quadraticInvariantsWalkAtRandom() {
        const System system = heavier();
        const auto momentum = [](const State& s) { return s.x[0] * s.x[3] - s.x[1] * s.x[2]; };
        const Run r = run(system, heavierStart, gauss(6), 0.02, 200000);
        QCOMPARE(r.cost.linearSolves, 0);
        const double drift = std::abs(momentum(r.end) - momentum(heavierStart));
        qInfo("%.1e", drift);
        QVERIFY(drift < 2e-14);
    }
    /// Few periods in a step contract, many do not: then Newton's method takes over.
    void stiffStepsGoToNewton() {
        const System system = systemNamed("spring-pendulum");
        QCOMPARE(run(system, springStart, gauss(8), 0.02, 100).cost.linearSolves, 0);
        QVERIFY(run(system, springStart, gauss(2), 0.2, 100).cost.linearSolves > 0);
    }
};

EXTREMAL_TEST(VelocityIterationTest)
}  // namespace extremal::velocity_iteration_test

#include "velocity_iteration_test.moc"
