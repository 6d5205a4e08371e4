// SPDX-License-Identifier: GPL-3.0-or-later
/// Rolling conditions, controls, and forces with a rule of their own: orders in q and p, against closed forms
/// and other routes to the same motion.
#include <QTest>

#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::rolling_test {
namespace {

using mechanism_test::byRungeKutta;
using mechanism_test::Distance;
using mechanism_test::distance;
using mechanism_test::Ending;
using mechanism_test::MeasuredOrder;
using mechanism_test::Mechanical;
using mechanism_test::orderOf;
using mechanism_test::run;
using mechanism_test::startAt;
using mechanism_test::typedWith;

Value::Object rolling(const char* formula) { return {{"rolling", Value::Object{{"blade", formula}}}}; }

/// A blade on an incline; it turns with the rate w = 1.6 from a start along x at the speed 0.
Mechanical knifeEdge() {
    return startAt(
        typedWith({"x", "y", "phi"}, "(x_t^2+y_t^2+phi_t^2)/2 + 2*x", rolling("x_t*sin(phi) - y_t*cos(phi)")),
        {0, 0, 0}, {0, 0, 1.6});
}
/// Two wheels and a mass off their axis.
Mechanical sleigh() {
    return startAt(typedWith({"x", "y", "phi"},
                             "(x_t^2+y_t^2)/2 + 0.4*phi_t*(y_t*cos(phi)-x_t*sin(phi)) + 0.3*phi_t^2 - x^2/5",
                             rolling("x_t*sin(phi) - y_t*cos(phi)")),
                   {0.5, 0, 0.3}, {0.7 * std::cos(0.3), 0.7 * std::sin(0.3), 1.1});
}
/// z' = y x' in a quartic potential.
Mechanical particle() {
    return startAt(typedWith({"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 - (x^2+y^2+z^2)/2 - (x^4+y^4)/8",
                             rolling("z_t - y*x_t")),
                   {0.6, 0.4, 0}, {0.5, -0.3, 0.2});
}
/// A rolling condition, a constraint, and a force together.
Mechanical bladeOnBowl() {
    return startAt(typedWith({"x", "y", "z", "phi"}, "(x_t^2+y_t^2+z_t^2+phi_t^2)/2 - 3*z",
                             {{"rolling", Value::Object{{"blade", "x_t*sin(phi) - y_t*cos(phi)"}}},
                              {"constraints", Value::Object{{"bowl", "z - (x^2+y^2)/3"}}},
                              {"forces", Value::Object{{"phi", "-0.2*phi_t + 0.3*cos(t)"}}}}),
                   {0.6, 0, 0.12, 0.4}, {0.5 * std::cos(0.4), 0.5 * std::sin(0.4), 0, 0.9});
}

Mechanical named(const QString& name) {
    return name == "knife edge" ? knifeEdge()
           : name == "sleigh"   ? sleigh()
           : name == "particle" ? particle()
                                : bladeOnBowl();
}

/// The scheme with a rule of its own for the forces.
Discretization withForcesBy(const std::string& scheme, int nodes, const char* end) {
    Discretization d = *namedScheme(scheme);
    Value whole(Value::Object{{"type", d.quadrature.type}});
    for (const auto& [key, value] : d.quadrature.keys) whole.set(key, value);
    d.quadrature = Settings{
        "terms",
        {{"otherwise", whole},
         {"forces", Value::Object{{"type", "radau"}, {"nodes", static_cast<double>(nodes)}, {"end", end}}}},
        {}};
    return d;
}

}  // namespace

class RollingTest : public QObject {
    Q_OBJECT
private slots:
    void orders_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("order");
        QTest::addColumn<int>("steps");
        for (const char* name : {"knife edge", "sleigh", "particle", "blade on a bowl"}) {
            QTest::addRow("%s, midpoint", name) << name << "galerkin-gauss-1" << 2 << 100;
            QTest::addRow("%s, Gauss 2", name) << name << "galerkin-gauss-2" << 4 << 40;
            QTest::addRow("%s, Lobatto 2", name) << name << "galerkin-lobatto-2" << 4 << 40;
            QTest::addRow("%s, Gauss 3", name) << name << "galerkin-gauss-3" << 6 << 20;
            QTest::addRow("%s, Gauss 4", name) << name << "galerkin-gauss-4" << 8 << 10;
        }
    }
    void orders() {
        QFETCH(QString, name);
        QFETCH(QString, scheme);
        QFETCH(int, order);
        QFETCH(int, steps);
        const MeasuredOrder m = orderOf(named(name), scheme.toStdString(), 3, steps);
        QVERIFY(m.isDone());
        qInfo("errors of q %.1e, of p %.1e; orders %.2f, %.2f; rate %.0e", m.error.q, m.error.p, m.q, m.p,
              m.fine.largestRate);
        QVERIFY(std::abs(m.q - order) < 0.35);
        QVERIFY(std::abs(m.p - order) < 0.35);
        QVERIFY(m.fine.largestRate < 1e-13);
    }
    /// Multipliers at the Gauss nodes: the energy of a quadratic Lagrangian to round-off, where those at the
    /// Lobatto nodes have an error of the scheme's order, and q of order 2 s with p of a lower one.
    void rollingByGauss_data() {
        QTest::addColumn<QString>("name");
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("orderOfMomenta");
        QTest::addColumn<int>("steps");
        for (const char* name : {"knife edge", "particle"}) {
            QTest::addRow("%s, 1", name) << name << 1 << 2 << 100;
            QTest::addRow("%s, 2", name) << name << 2 << 2 << 40;
            QTest::addRow("%s, 3", name) << name << 3 << 4 << 20;
            QTest::addRow("%s, 4", name) << name << 4 << 4 << 10;
        }
    }
    void rollingByGauss() {
        QFETCH(QString, name);
        QFETCH(int, degree);
        QFETCH(int, orderOfMomenta);
        QFETCH(int, steps);
        const Mechanical of = named(name);
        const std::string scheme = "galerkin-gauss-" + std::to_string(degree);
        Discretization gauss = *namedScheme(scheme);
        Value whole(Value::Object{{"type", gauss.quadrature.type}});
        for (const auto& [key, value] : gauss.quadrature.keys) whole.set(key, value);
        gauss.quadrature =
            Settings{"terms", {{"otherwise", whole}, {"rolling", Value::Object{{"type", "gauss"}}}}, {}};
        QCOMPARE(describe(gauss, of.system).claims.order, std::min(2 * degree, orderOfMomenta));
        const State reference = byRungeKutta(of, 3);
        const Ending a = run(of, gauss, 3, steps), b = run(of, gauss, 3, 2 * steps);
        QVERIFY(a.outcome == Outcome::converged && b.outcome == Outcome::converged);
        const Distance coarse = distance(a.state, reference), fine = distance(b.state, reference);
        const double q = std::log2(coarse.q / fine.q), p = std::log2(coarse.p / fine.p);
        const EnergyFunction energy = energyOf(of.system);
        const auto change = [&](const State& s) {
            return std::abs(energy(s.t, s.x.data()) - energy(0, of.start.x.data()));
        };
        const Ending lobatto = run(of, scheme, 3, 2 * steps);
        qInfo("orders of q %.2f, of p %.2f; energy %.0e (Lobatto %.0e); rate %.0e", q, p, change(b.state),
              change(lobatto.state), b.largestRate);
        QVERIFY(std::abs(q - 2 * degree) < 0.35);
        QVERIFY(std::abs(p - orderOfMomenta) < 0.35);
        QVERIFY(b.largestRate > 1e3 * lobatto.largestRate);
        if (name == "knife edge") {
            QVERIFY(change(b.state) < 1e-13);
            QVERIFY(change(lobatto.state) > 20 * change(b.state));
        }
    }
    /// phi = w t, and the speed along the blade has the rate 2 cos(phi): x = (1 - cos(2 w t)) / (2 w^2) ..
    void theKnifeEdgeInClosedForm() {
        const double w = 1.6, t = 3;
        const Ending r = run(knifeEdge(), "galerkin-gauss-6", t, 60);
        const double x = std::pow(std::sin(w * t), 2) / (w * w),
                     y = (w * t - std::sin(2 * w * t) / 2) / (w * w);
        QVERIFY(std::abs(r.state.x[0] - x) < 1e-11);
        QVERIFY(std::abs(r.state.x[1] - y) < 1e-11);
        QVERIFY(std::abs(r.state.x[2] - w * t) < 1e-12);
    }
    /// With the condition inside the action the motion is another one, and depends on a multiplier at the
    /// start, the part of p across the blade.
    void vakonomicIsAnotherMotion() {
        const Mechanical rolls = knifeEdge();
        const double w = rolls.start.x[5];
        const System vakonomic = laws::systemNamed(
            "hamiltonian", {{"coordinates", Value::Array{"x", "y", "phi"}},
                            {"parameters", Value::Object{}},
                            {"hamiltonian", "(p_x*cos(phi) + p_y*sin(phi))^2/2 + p_phi^2/2 - 2*x"}});
        const Ending r = run(rolls, "galerkin-gauss-4", 3, 60);
        State end[2];
        for (const int mu : {0, 1}) {
            end[mu] = {0, 0, {0, 0, 0, 0, -0.5 * mu, w}};
            const auto scheme = makeIntegrator(vakonomic, *namedScheme("galerkin-gauss-3"), {0, 0.05});
            for (int i = 0; i < 60; ++i) QVERIFY(advance(*scheme, end[mu]).outcome == Outcome::converged);
            qInfo("d'Alembert (%.4f, %.4f), vakonomic (%.4f, %.4f)", r.state.x[0], r.state.x[1], end[mu].x[0],
                  end[mu].x[1]);
            QVERIFY(distance(end[mu], r.state).q > 1);
        }
        QVERIFY(distance(end[0], end[1]).q > 0.5);
    }
    /// The energy of a reversible scheme does not drift.
    void longRuns() {
        const Mechanical of = particle();
        const EnergyFunction energy = energyOf(of.system);
        const auto integrator = makeIntegrator(of.system, *namedScheme("galerkin-gauss-2"), {0, 0.1});
        State s = of.start;
        double first = 0, last = 0;
        const int steps = 40000;
        for (int i = 0; i < steps; ++i) {
            QVERIFY(advance(*integrator, s).outcome == Outcome::converged);
            double& part = i < steps / 2 ? first : last;
            part = std::max(part, std::abs(energy(s.t, s.x.data()) - energy(0, of.start.x.data())));
        }
        qInfo("energy %.4e and %.4e", first, last);
        QVERIFY(std::abs(last / first - 1) < 0.05);
    }
    /// What is the gradient of a constraint may be written as a rolling condition: the same motion.
    void aConstraintOnVelocities() {
        const Mechanical rod = mechanism_test::sphericalPendulum();
        const Mechanical wheel = startAt(
            typedWith({"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 - 9.81*z", rolling("x*x_t + y*y_t + z*z_t")),
            {0.6, 0, -0.8}, {0, 2.5, 0.3});
        const Ending a = run(rod, "galerkin-gauss-6", 2, 80), b = run(wheel, "galerkin-gauss-6", 2, 80);
        QVERIFY(distance(a.state, b.state).q < 1e-10 && distance(a.state, b.state).p < 1e-9);
    }
    /// Forces by Radau from the left lose one order, and damp what is stiff; from the right they amplify.
    void forcesByRadau_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("steps");
        QTest::newRow("1") << 1 << 400;
        QTest::newRow("2") << 2 << 60;
        QTest::newRow("3") << 3 << 30;
    }
    void forcesByRadau() {
        QFETCH(int, degree);
        QFETCH(int, steps);
        const Mechanical of =
            startAt(typedWith({"x"}, "x_t^2/2 - x^2/2", {{"forces", Value::Object{{"x", "2*(1-x^2)*x_t"}}}}),
                    {1}, {0.5});
        const State reference = byRungeKutta(of, 3);
        const Discretization scheme =
            withForcesBy("galerkin-gauss-" + std::to_string(degree), degree, "left");
        const Distance a = distance(run(of, scheme, 3, steps).state, reference),
                       b = distance(run(of, scheme, 3, 2 * steps).state, reference);
        qInfo("orders %.2f, %.2f", std::log2(a.q / b.q), std::log2(a.p / b.p));
        QVERIFY(std::abs(std::log2(a.q / b.q) - (2 * degree - 1)) < 0.35);
        QVERIFY(std::abs(std::log2(a.p / b.p) - (2 * degree - 1)) < 0.35);
        const Mechanical stiff =
            startAt(typedWith({"x"}, "x_t^2/2", {{"forces", Value::Object{{"x", "-10000*x_t"}}}}), {0}, {1});
        const std::string gauss = "galerkin-gauss-" + std::to_string(degree);
        qInfo("p %.2e", run(stiff, scheme, 1, 1).state.x[1]);
        QVERIFY(std::abs(run(stiff, scheme, 1, 1).state.x[1]) < 1e-3);
        QVERIFY(std::abs(run(stiff, withForcesBy(gauss, degree, "right"), 1, 1).state.x[1]) > 1e3);
        QVERIFY(std::abs(run(stiff, gauss, 1, 1).state.x[1]) > 0.99);
    }
    /// A control by a formula, by a table, and typed out are the same force.
    void controls() {
        const auto end = [](const Value::Object& further) {
            return run(startAt(typedWith({"x"}, "x_t^2/2 - x^2/2", further, {{"F", 0.7}}), {0.3}, {0}),
                       "galerkin-gauss-3", 2, 20)
                .state;
        };
        const Value::Object force{{"x", "u"}};
        const State out = end({{"forces", Value::Object{{"x", "F*(1 - t/4)"}}}}),
                    formula = end({{"forces", force}, {"controls", Value::Object{{"u", "F*(1 - t/4)"}}}}),
                    table = end(
                        {{"forces", force},
                         {"controls",
                          Value::Object{{"u", Value::Object{{"table", Value::Array{Value::Array{0, 0.7},
                                                                                   Value::Array{4, 0}}}}}}}});
        // Another function under the same name is another force.
        const State steeper = end({{"forces", force}, {"controls", Value::Object{{"u", "F*(1 - t/2)"}}}}),
                    flat = end({{"forces", force},
                                {"controls",
                                 Value::Object{
                                     {"u", Value::Object{{"table", Value::Array{Value::Array{0, 0.7},
                                                                                Value::Array{4, 0.7}}}}}}}}),
                    constant = end({{"forces", Value::Object{{"x", "0.7"}}}});
        QVERIFY(distance(out, steeper).q > 0.1);
        QVERIFY(distance(flat, constant).q < 1e-15 && distance(flat, table).q > 0.1);
        QVERIFY(distance(out, formula).q == 0 && distance(out, formula).p == 0);
        QVERIFY(distance(out, table).q < 1e-15 && distance(out, table).p < 1e-15);
        // In the Lagrangian as well.
        const State inside = run(startAt(typedWith({"x"}, "x_t^2/2 - x^2/2 + u*x",
                                                   {{"controls", Value::Object{{"u", "0.7*(1 - t/4)"}}}}),
                                         {0.3}, {0}),
                                 "galerkin-gauss-3", 2, 20)
                                 .state;
        QVERIFY(distance(out, inside).q < 1e-14 && distance(out, inside).p < 1e-14);
    }
};

EXTREMAL_TEST(RollingTest)
}  // namespace extremal::rolling_test
#include "rolling_test.moc"
