// SPDX-License-Identifier: GPL-3.0-or-later
/// How the step of a mechanism is solved by Newton's method: from the curve of the last step, with a matrix
/// that is kept, and with parts that are evaluated at all nodes together.
#include <QTest>

#include <cmath>

#include "tests/engine/mechanism/mechanisms.hpp"
#include "tests/tools/test.hpp"

namespace extremal::newton_start_test {
namespace {

using mechanism_test::distance;
using mechanism_test::fourBar;
using mechanism_test::Mechanical;
using mechanism_test::startAt;
using mechanism_test::typedWith;

/// The motion of a four-bar in the angle of the crank: the loop is closed by two circles, and the rocker
/// turns by w for each turn of the crank.
Mechanical fourBarInOneAngle() {
    const std::string x = "cos(a)", y = "sin(a)", square = "(2.5-cos(a))^2+sin(a)^2",
                      along = "((0.76+" + square + ")/(2*(" + square + ")))",
                      across = "sqrt(4/(" + square + ")-" + along + "^2)",
                      u = "(cos(a)+" + along + "*(2.5-cos(a))+" + across + "*sin(a))",
                      v = "(sin(a)-" + along + "*sin(a)+" + across + "*(2.5-cos(a)))",
                      w = "((" + v + "-" + y + ")*" + x + "-(" + u + "-" + x + ")*" + y + ")/((" + v + "-" +
                          y + ")*(" + u + "-2.5)-(" + u + "-" + x + ")*" + v + ")";
    return startAt(
        typedWith({"a"}, "a_t^2/2*(1+6.48*(" + w + ")^2)-9.81*sin(a)-19.62*" + v,
                  {{"forces", Value::Object{{"a", "12"}}}, {"dissipation", "2.43*(" + w + ")^2*a_t^2"}}),
        {std::atan2(0.909297426825682, -0.416146836547142)}, {0});
}

struct Totals {
    State end;
    double iterations = 0, factorisations = 0;  ///< of a step, on average
};

Totals solve(const Mechanical& of, int degree, double end, int steps, double tolerance = 0,
             bool isFresh = false, const std::string& method = "newton") {
    Discretization scheme = *namedScheme("galerkin-gauss-" + std::to_string(degree));
    scheme.solver = {method, {}, {}};
    if (tolerance > 0) scheme.solver.keys.emplace_back("tolerance", tolerance);
    const auto integrator = makeIntegrator(of.system, scheme, {0, end / steps});
    Totals all{of.start};
    for (int i = 0; i < steps; ++i) {
        if (isFresh) integrator->begin(all.end);
        const StepReport report = advance(*integrator, all.end);
        if (report.outcome != Outcome::converged) qFatal("a step failed");
        const double iterations = static_cast<double>(report.cost.iterations);
        all.iterations += iterations / steps;
        all.factorisations += (static_cast<double>(report.cost.linearSolves) - iterations) / steps;
    }
    return all;
}

}  // namespace

class NewtonStartTest : public QObject {
    Q_OBJECT
private slots:
    void theMatrixIsKept_data() {
        QTest::addColumn<int>("degree");
        for (const int degree : {1, 2, 3, 4, 6, 8}) QTest::addRow("degree %d", degree) << degree;
    }
    void theMatrixIsKept() {
        QFETCH(int, degree);
        const Totals all = solve(fourBar(), degree, 1, 200),
                     fresh = solve(fourBar(), degree, 1, 200, 0, true);
        const auto apart = distance(all.end, fresh.end);
        qInfo("iterations %.2f, factorisations %.2f; from each start anew %.2f, %.2f; apart %.1e, %.1e",
              all.iterations, all.factorisations, fresh.iterations, fresh.factorisations, apart.q, apart.p);
        // Starts anew have the factors of an acceleration besides.
        QVERIFY(all.factorisations < (degree == 1 ? 1.6 : 1.3) && fresh.factorisations < 2.3);
        QVERIFY(all.iterations < 6 && (degree < 3 || all.iterations < fresh.iterations));
        QVERIFY(apart.q < 1e-12 && apart.p < 1e-11);
    }
    /// A curve that goes on may be right to a tolerance before the impulses of the rods are.
    void impulsesAreSolvedToTheTolerance() {
        const State exact = solve(fourBar(), 6, 10, 4000).end;
        for (const char* method : {"newton", "auto"}) {
            const State coarse = solve(fourBar(), 6, 10, 4000, 1e-9, false, method).end;
            const auto apart = distance(exact, coarse);
            qInfo("%s: apart %.1e in q, %.1e in p", method, apart.q, apart.p);
            QVERIFY(apart.q < 1e-8 && apart.p < 1e-7);
        }
    }
    /// A polynomial of degree 8 that goes on far swings to roots that do not belong to the motion.
    void otherIncrementsAreStartedAnew() {
        for (const int degree : {4, 8}) {
            const Totals all = solve(fourBarInOneAngle(), degree, 10, 300, 0, false, "auto"),
                         fresh = solve(fourBarInOneAngle(), degree, 10, 300, 0, true, "auto");
            const auto apart = distance(all.end, fresh.end);
            qInfo("degree %d: iterations %.2f, anew %.2f; apart %.1e", degree, all.iterations,
                  fresh.iterations, apart.q);
            QVERIFY(apart.q < 1e-8 && apart.p < 1e-8);
        }
    }
    void allNodesAreAsEach() {
        const System system = typedWith(
            {"x", "y", "u", "w"}, "(x_t^2+y_t^2+u_t^2+w_t^2)/2",
            {{"constraints", Value::Object{{"first", "x^2+y^2-exp(t/9)"}, {"second", "sin(u*x)-w/(2+t)"}}},
             {"forces", Value::Object{{"x", "-y_t*cos(t)+u"}, {"w", "sqrt(2+x*u_t)"}}},
             {"dissipation", "0.3*u_t^2*(1+w^2)"}});
        const Constraint& g = *system.parts.find<Constraint>();
        const Force& F = *system.parts.find<Force>();
        constexpr int nodes = 16, d = 4, n = 2;
        Eigen::MatrixXd q(nodes, d), v(nodes, d), firsts(nodes, n * (1 + d)), forces(nodes, d),
            derivatives(nodes, 2 * d * d);
        Eigen::VectorXd t(nodes);
        for (int i = 0; i < nodes; ++i) {
            t(i) = 0.1 * i;
            for (int k = 0; k < d; ++k) {
                q(i, k) = std::sin(i + 0.7 * k);
                v(i, k) = std::cos(i - 0.3 * k);
            }
        }
        g.firsts(g.model.get(), t.data(), nodes, q.data(), firsts.data());
        F.values(F.model.get(), t.data(), nodes, q.data(), v.data(), forces.data());
        F.derivatives(F.model.get(), t.data(), nodes, q.data(), v.data(), derivatives.data());
        Eigen::RowVectorXd one(n * (1 + d)), byTime(n), force(d), byState(2 * d * d);
        for (int i = 0; i < nodes; ++i) {
            const Eigen::VectorXd place = q.row(i).transpose(), velocity = v.row(i).transpose();
            g.first(g.model.get(), t(i), place.data(), one.data(), one.data() + n, byTime.data());
            F.first(F.model.get(), t(i), place.data(), velocity.data(), force.data(), byState.data());
            // Sines of eight numbers together differ from those of one in the last place.
            QVERIFY((firsts.row(i) - one).cwiseAbs().maxCoeff() < 1e-14);
            QVERIFY((forces.row(i) - force).cwiseAbs().maxCoeff() < 1e-14);
            QVERIFY((derivatives.row(i) - byState).cwiseAbs().maxCoeff() < 1e-14);
        }
        QVERIFY(derivatives.cwiseAbs().maxCoeff() > 0.1 && firsts.cwiseAbs().maxCoeff() > 0.1);
    }
};

EXTREMAL_TEST(NewtonStartTest)
}  // namespace extremal::newton_start_test
#include "newton_start_test.moc"
