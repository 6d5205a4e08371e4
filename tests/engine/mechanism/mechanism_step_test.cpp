// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps with constraints and forces: orders in q and p, constraints kept to round-off, balance of energy and
/// work, and the same motion by other routes.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/baseline/catalog.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::mechanism_test {
namespace {

Mechanical named(const QString& name) {
    return name == "spherical pendulum" ? sphericalPendulum()
           : name == "double pendulum"  ? doublePendulum()
           : name == "winch"            ? winch()
                                        : chargeOnTorus();
}

}  // namespace

class MechanismStepTest : public QObject {
    Q_OBJECT
private slots:
    void orders_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        for (const char* name : {"spherical pendulum", "double pendulum", "winch", "torus"}) {
            // As many steps as the fastest turn of each asks for.
            const int few = QString(name) == "torus" ? 1 : 2;
            QTest::addRow("%s, midpoint", name) << name << "galerkin-gauss-1" << 2 << 100 * few;
            QTest::addRow("%s, trapezoid", name) << name << "galerkin-lobatto-1" << 2 << 100 * few;
            QTest::addRow("%s, Gauss 2", name) << name << "galerkin-gauss-2" << 4 << 40 * few;
            QTest::addRow("%s, Lobatto 2", name) << name << "galerkin-lobatto-2" << 4 << 40 * few;
            QTest::addRow("%s, Gauss 3", name) << name << "galerkin-gauss-3" << 6 << 24 * few;
            QTest::addRow("%s, Gauss 4", name)
                << name << "galerkin-gauss-4" << 8 << (QString(name) == "double pendulum" ? 18 : 12) * few;
        }
    }
    void orders() {
        QFETCH(QString, name);
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        const MeasuredOrder m = orderOf(named(name), scheme.toStdString(), 2, steps);
        QVERIFY(m.isDone());
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f; |g| %.0e, |dg/dt| %.0e", m.error.q, m.error.p,
              m.q, m.p, m.fine.largestValue, m.fine.largestRate);
        QVERIFY(std::abs(m.q - order) < 0.3);
        QVERIFY(std::abs(m.p - order) < 0.3);
        QVERIFY(m.fine.largestValue < 1e-14 && m.fine.largestRate < 1e-13);
    }
    /// The angles of two rods know no constraint.
    void theDoublePendulumIsThatOfAngles() {
        const Mechanical rods = doublePendulum();
        const System angles = laws::systemNamed(
            "lagrangian", {{"coordinates", Value::Array{"a", "b"}},
                           {"parameters", Value::Object{}},
                           {"lagrangian", "a_t^2 + b_t^2/2 + a_t*b_t*cos(a-b) + 9.81*(2*cos(a)+cos(b))"}});
        State s{0, 0, {1, 1.5, 0, 0}};
        const auto integrator = makeIntegrator(angles, *namedScheme("galerkin-gauss-6"), {0, 0.02});
        for (int i = 0; i < 100; ++i) QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
        const Ending end = run(rods, "galerkin-gauss-6", 2, 100);
        const double x = std::sin(s.x[0]), y = -std::cos(s.x[0]);
        QVERIFY(std::abs(end.state.x[0] - x) + std::abs(end.state.x[1] - y) < 1e-11);
        QVERIFY(std::abs(end.state.x[2] - x - std::sin(s.x[1])) +
                    std::abs(end.state.x[3] - y + std::cos(s.x[1])) <
                1e-11);
    }
    /// A force -c v and the Lagrangian e^(ct) L are one motion.
    void aDampedOscillatorIsThatOfAGrowingMass() {
        const Mechanical damped =
            startAt(typed({"x"}, "x_t^2/2 - 2*x^2 - x^4/4", {}, {{"x", "-0.3*x_t"}}), {1}, {0});
        const System growing =
            laws::systemNamed("lagrangian", {{"coordinates", Value::Array{"x"}},
                                             {"parameters", Value::Object{}},
                                             {"lagrangian", "exp(0.3*t)*(x_t^2/2 - 2*x^2 - x^4/4)"}});
        const double end = 4;
        State s{0, 0, {1, 0}};
        const auto integrator = makeIntegrator(growing, *namedScheme("galerkin-gauss-6"), {0, end / 80});
        for (int i = 0; i < 80; ++i) QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
        const Ending r = run(damped, "galerkin-gauss-6", end, 80);
        QVERIFY(std::abs(r.state.x[0] - s.x[0]) < 1e-12);
        QVERIFY(std::abs(r.state.x[1] - s.x[1] * std::exp(-0.3 * end)) < 1e-12);
    }
    /// With a Lagrangian quadratic in q and v and one Gauss rule the work is the change of the energy.
    void balanceIsExactForQuadraticLagrangians_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* scheme :
             {"galerkin-gauss-1", "galerkin-gauss-2", "galerkin-gauss-3", "galerkin-gauss-4"})
            QTest::newRow(scheme) << scheme;
    }
    void balanceIsExactForQuadraticLagrangians() {
        QFETCH(QString, scheme);
        const Mechanical of =
            startAt(typed({"x"}, "(x_t^2 - x^2)/2", {}, {{"x", "2*(1-x^2)*x_t + sin(t)"}}), {1}, {0.5});
        const Ending r = run(of, scheme.toStdString(), 10, 100);
        const auto energy = [&](const State& s) { return energyOf(of.system)(s.t, s.x.data()); };
        QVERIFY(std::abs(r.work) > 0.1);
        QVERIFY(std::abs(energy(r.state) - energy(of.start) - r.work) < 1e-13);
    }
    /// A constraint that moves with time does work; the balance has the order of the scheme.
    void theWinchBalances_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        QTest::newRow("midpoint") << "galerkin-gauss-1" << 2 << 160;
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 4 << 80;
        QTest::newRow("Gauss 3") << "galerkin-gauss-3" << 6 << 40;
    }
    void theWinchBalances() {
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        const Mechanical of = winch();
        const EnergyFunction energy = energyOf(of.system);
        double defect[2];
        for (int k = 0; k < 2; ++k) {
            const Ending r = run(of, scheme.toStdString(), 2, steps << k);
            QVERIFY(r.outcome == Outcome::converged);
            defect[k] = std::abs(energy(r.state.t, r.state.x.data()) - energy(0, of.start.x.data()) - r.work);
        }
        qInfo("balance %.2e, order %.2f", defect[1], std::log2(defect[0] / defect[1]));
        QVERIFY(std::abs(std::log2(defect[0] / defect[1]) - order) < 0.25);
    }
    /// Neither energy nor angular momentum drifts.
    void longRuns() {
        const Mechanical of = sphericalPendulum();
        const EnergyFunction energy = energyOf(of.system);
        const double start = energy(0, of.start.x.data());
        const auto integrator = makeIntegrator(of.system, *namedScheme("galerkin-gauss-2"), {0, 0.02});
        State s = of.start;
        Mechanism mechanism(of.system.parts);
        double first = 0, last = 0, spin = 0;
        const auto angular = [](const State& at) { return at.x[0] * at.x[4] - at.x[1] * at.x[3]; };
        const int steps = 40000;
        for (int i = 0; i < steps; ++i) {
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            double& part = i < steps / 2 ? first : last;
            part = std::max(part, std::abs(energy(s.t, s.x.data()) - start));
            spin = std::max(spin, std::abs(angular(s) - angular(of.start)));
            QVERIFY(mechanism.largestValue(s.t, s.x.data()) < 1e-15);
        }
        qInfo("energy %.4e and %.4e, angular momentum %.1e", first, last, spin);
        QVERIFY(std::abs(last / first - 1) < 0.02);
        QVERIFY(spin < 1e-11);
    }
    /// A step of h and one of -h lead back.
    void thereAndBack() {
        for (const Mechanical& of : {sphericalPendulum(), doublePendulum(), chargeOnTorus()})
            for (const char* scheme :
                 {"galerkin-gauss-1", "galerkin-gauss-2", "galerkin-lobatto-2", "galerkin-gauss-3"}) {
                const auto forth = makeIntegrator(of.system, *namedScheme(scheme), {0, 0.01}),
                           back = makeIntegrator(of.system, *namedScheme(scheme), {0, -0.01});
                State s = of.start;
                for (int i = 0; i < 100; ++i) QVERIFY(advance(*forth, s).outcome == Outcome::converged);
                s.node = 0;
                for (int i = 0; i < 100; ++i) {
                    const StepReport report = advance(*back, s);
                    QVERIFY2(report.outcome == Outcome::converged,
                             qPrintable(QString("%1, step %2: %3")
                                            .arg(scheme)
                                            .arg(i)
                                            .arg(static_cast<int>(report.outcome))));
                }
                QVERIFY(distance(s, of.start).q < 1e-11 && distance(s, of.start).p < 1e-11);
            }
    }
    /// A four-bar with a motor and a damper, by Newton's method: what ends the steps before their last
    /// correction is evaluated leaves places and momenta as the tolerance has them, and spares iterations.
    void stepsEndWhereTheNextCorrectionIsKnownToBeSmall() {
        const Mechanical of = startAt(
            typed(
                {"a", "b", "c", "d"}, "(a_t^2+b_t^2+2*c_t^2+2*d_t^2)/2 - 9.81*(b+2*d)",
                {{"crank", "a^2+b^2-1"}, {"coupler", "(c-a)^2+(d-b)^2-4"}, {"rocker", "(c-2.5)^2+d^2-3.24"}},
                {{"a", "-12*b"}, {"b", "12*a"}, {"c", "-1.5*c_t"}, {"d", "-1.5*d_t"}}),
            {-0.42, 0.91, 1.5, 1.49}, {0, 0, 0, 0});
        const auto run = [&of](double tolerance) {
            Discretization d = *namedScheme("galerkin-gauss-4");
            d.solver = {"newton", {{"tolerance", tolerance}}, {}};
            const auto integrator = makeIntegrator(of.system, d, {0, 0.01});
            State s = of.start;
            double iterations = 0;
            for (int i = 0; i < 200; ++i) iterations += advance(*integrator, s).cost.iterations;
            return std::pair(s, iterations / 200);
        };
        const State exact = run(1e-15).first;
        for (const auto& [tolerance, most] : {std::pair{1e-15, 3.2}, {1e-9, 2.6}, {1e-6, 2.3}}) {
            const auto [s, iterations] = run(tolerance);
            double apart = 0;
            for (std::size_t i = 0; i < s.x.size(); ++i)
                apart = std::max(apart, std::abs(s.x[i] - exact.x[i]));
            qInfo("%.0e: apart by %.1e after %.2f iterations a step", tolerance, apart, iterations);
            QVERIFY(apart <= 10 * tolerance);
            QVERIFY(iterations <= most);
        }
    }
    /// Damping that is stiff: what p becomes in one step of c h = 100, by the Pade approximation of the rule.
    void stiffDamping() {
        const Mechanical of = startAt(typed({"x"}, "x_t^2/2", {}, {{"x", "-100*x_t"}}), {0}, {1});
        const Ending one = run(of, "galerkin-gauss-1", 1, 1), two = run(of, "galerkin-gauss-2", 1, 1);
        QVERIFY(std::abs(one.state.x[1] - (1 - 50.0) / (1 + 50.0)) < 1e-13);
        QVERIFY(std::abs(two.state.x[1] - (1 - 50.0 + 1e4 / 12) / (1 + 50.0 + 1e4 / 12)) < 1e-13);
    }
};

EXTREMAL_TEST(MechanismStepTest)
}  // namespace extremal::mechanism_test
#include "mechanism_step_test.moc"
