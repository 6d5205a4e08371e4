// SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinates that stay at round-off, and momenta far larger than the mass times the velocity, do not keep a
/// step from its end; an iteration that fails is still seen.
///
/// The problems are of other people: a ring of masses whose symmetry keeps two of them at rest, chains in
/// modes with nodes, and Lagrangians with a large total derivative, which changes momenta and not the motion.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/scene_steps.hpp"
#include "tests/tools/test.hpp"

namespace extremal::buried_coordinates_test {
namespace {

using tests::after;

const std::vector<std::string> solved = {
    "'scheme': 'midpoint'",
    "'scheme': 'galerkin-gauss-2'",
    "'scheme': 'galerkin-gauss-4'",
    "'scheme': 'galerkin-gauss-4', 'solver': {'method': 'newton'}",
    "'scheme': 'galerkin-gauss-2', 'solver': {'method': 'fixed-point'}",
    "'scheme': 'galerkin-lobatto-3'",
    "'space': {'type': 'spline', 'degree': 2, 'cells': 3}, 'quadrature': {'type': 'gauss', 'nodes': 2}",
    "'scheme': 'sem-2'",
    "'baseline': 'gauss-collocation'",
    "'baseline': 'implicit-midpoint'",
    "'baseline': 'average-vector-field'",
    "'baseline': 'stormer-verlet'"};

/// JSON in single quotes.
std::string scene(const std::string& model, const std::string& initial, const std::string& scheme,
                  double step) {
    std::string json = "{'extremal': 1, 'time': {'end': 1000}, 'model': " + model +
                       ", 'initial': " + initial + ", 'schemes': [{" + scheme +
                       ", 'step': " + std::to_string(step) + "}]}";
    std::replace(json.begin(), json.end(), '\'', '"');
    return json;
}

std::vector<double> run(const std::string& model, const std::string& initial, const std::string& scheme,
                        double step, int steps) {
    return after(readScene(scene(model, initial, scheme, step)), steps);
}

std::string typed(const std::string& coordinates, const std::string& lagrangian) {
    return "{'type': 'lagrangian', 'coordinates': [" + coordinates + "], 'lagrangian': '" + lagrangian + "'}";
}

const std::string ring =
    typed("'a', 'b', 'c', 'd'",
          "(a_t^2 + b_t^2 + c_t^2 + d_t^2)/2 - exp(a - b) - exp(b - c) - exp(c - d) - exp(d - a)");

/// Masses with hardening springs and free ends.
std::string longChain(int masses) {
    const std::string n = std::to_string(masses), last = std::to_string(masses - 1);
    std::string names;
    for (int i = 1; i <= masses; ++i) names += (i > 1 ? ", 'x" : "'x") + std::to_string(i) + "'";
    return typed(names, "sum(i, 1.." + n + ", x[i]_t^2/2) - sum(i, 1.." + last +
                            ", (x[i+1] - x[i])^2/2 + (x[i+1] - x[i])^4/4)");
}

/// Masses with cubic springs between walls, and their second mode, which has a node in the middle.
std::string chain(int masses) {
    std::string names, kinetic, potential;
    for (int i = 1; i <= masses + 1; ++i) {
        const std::string left = i == 1 ? "0" : "x" + std::to_string(i - 1),
                          right = i > masses ? "0" : "x" + std::to_string(i),
                          stretch = "(" + right + " - " + left + ")";
        potential += (i > 1 ? " - " : "") + stretch + "^2/2 - " + stretch + "^3/12";
        if (i > masses) break;
        names += (i > 1 ? ", 'x" : "'x") + std::to_string(i) + "'";
        kinetic += (i > 1 ? " + x" : "x") + std::to_string(i) + "_t^2";
    }
    return typed(names, "(" + kinetic + ")/2 - " + potential);
}
std::string secondMode(int masses) {
    std::string q;
    for (int i = 1; i <= masses; ++i)
        q += (i > 1 ? ", 'sin(" : "'sin(") + std::to_string(2 * i) + "*pi/" + std::to_string(masses + 1) +
             ")'";
    return "{'q': [" + q + "]}";
}

}  // namespace

class BuriedCoordinatesTest : public QObject {
    Q_OBJECT

private slots:
    void aRingKeepsItsSymmetry_data() {
        QTest::addColumn<double>("step");
        for (const double step : {0.3, 0.11, 0.01, 0.001}) QTest::addRow("h = %g", step) << step;
    }
    /// a = c = 0 and b = -d by symmetry: b moves like one mass with L = b_t^2 - 4 cosh b.
    void aRingKeepsItsSymmetry() {
        QFETCH(double, step);
        const std::string one = typed("'b'", "b_t^2 - 4*cosh(b)");
        for (const std::string& scheme : solved) {
            if (scheme.find("stormer") != std::string::npos && step > 0.2) continue;  // unstable
            const auto x = run(ring, "{'q': [0, 2, '2*sin(pi)', -2]}", scheme, step, 20);
            // From rest the energy hardly determines the steps where these are unknowns.
            if (scheme.find("sem") != std::string::npos) continue;
            const auto b = run(one, "{'q': [2]}", scheme, step, 20);
            QVERIFY2(x.size() == 8 || x.size() == 9, scheme.c_str());
            // Measured: at most 6e-14, as the instability of the motion lets round-off grow.
            QVERIFY2(std::abs(x[0]) < 1e-12 && std::abs(x[2]) < 1e-12 && std::abs(x[1] + x[3]) < 1e-12,
                     scheme.c_str());
            QVERIFY2(!b.empty() && std::abs(x[1] - b[0]) < 2e-12, scheme.c_str());
        }
    }
    void modesWithNodesMove_data() {
        QTest::addColumn<int>("masses");
        for (const int masses : {3, 7, 31}) QTest::addRow("%d masses", masses) << masses;
    }
    void modesWithNodesMove() {
        QFETCH(int, masses);
        for (const std::string& scheme : solved)
            QVERIFY2(!run(chain(masses), secondMode(masses), scheme, 0.1, 50).empty(), scheme.c_str());
    }
    /// At rest in an equilibrium whose forces cancel to round-off alone.
    void anEquilibriumIsNoFailure() {
        const std::string balanced =
            typed("'x', 'y'", "(x_t^2 + y_t^2)/2 - exp(x - y)/2 - exp(x + y)/2 - exp(-x)");
        for (const std::string& scheme : solved) {
            if (scheme.find("sem") != std::string::npos) continue;  // at rest every step has the energy
            for (const char* initial : {"{'q': [1, 1e-17]}", "{'q': [0, 3e-17]}"})
                QVERIFY2(!run(balanced, initial, scheme, 0.5, 40).empty(), (scheme + initial).c_str());
        }
    }
    void aTotalDerivativeDoesNotChangeTheMotion_data() {
        QTest::addColumn<QString>("derivative");
        QTest::addColumn<double>("tolerance");
        QTest::newRow("of 1e3 x") << "+ 1e3*x_t" << 1e-11;
        QTest::newRow("of 1e6 x") << "+ 1e6*x_t" << 1e-8;
        QTest::newRow("of 1e4 x^2") << "+ 2e4*x*x_t" << 1e-9;
        QTest::newRow("of -1e3 sin x") << "- 1e3*cos(x)*x_t" << 1e-8;
    }
    void aTotalDerivativeDoesNotChangeTheMotion() {
        QFETCH(QString, derivative);
        QFETCH(double, tolerance);
        const std::string plain = "x_t^2/2 - x^2/2 - x^4/8";
        for (const std::string& scheme : solved) {
            if (scheme.find("fixed-point") != std::string::npos) continue;  // is for separable ones
            // The average along the chord, and symplectic Euler's steps, change with the derivative.
            if (scheme.find("baseline") != std::string::npos && scheme.find("gauss") == std::string::npos)
                continue;
            // So does what a rule sees of one that is not linear, or not a polynomial of low degree.
            const bool isExact = derivative.contains("e3*x_t") || derivative.contains("e6*x_t");
            // Sweeps over velocities (p - A)/m do not contract where h A' is large.
            if (!isExact && scheme.find("collocation") != std::string::npos) continue;
            const auto x =
                run(typed("'x'", plain + derivative.toStdString()), "{'q': [1], 'v': [0]}", scheme, 0.05, 60);
            QVERIFY2(!x.empty(), scheme.c_str());
            if (!isExact || scheme.find("sem") != std::string::npos) continue;
            const auto y = run(typed("'x'", plain), "{'q': [1], 'v': [0]}", scheme, 0.05, 60);
            QVERIFY2(std::abs(x[0] - y[0]) < tolerance,
                     qPrintable(QString("%1: %2").arg(scheme.c_str()).arg(x[0] - y[0])));
        }
    }
    /// A light body beside a heavy one is far below it in the metric of the kinetic energy, and has to
    /// converge all the same: its motion does not depend on its mass.
    void aLightBodyConverges() {
        const auto pair = [](const std::string& mass) {
            return typed("'x', 'y', 'X'", "5e23*X_t^2 - 5e23*X^2 + " + mass +
                                              "*((x_t^2 + y_t^2)/2 + 1/sqrt(x^2 + y^2) - x*X/10)");
        };
        const std::string initial = "{'q': [0.4, 0, 1e-3], 'v': [0, 2, 0]}";
        for (const std::string& scheme : solved) {
            if (scheme.find("sem") != std::string::npos) continue;  // its steps follow the energy
            const auto light = run(pair("1e-3"), initial, scheme, 0.05, 100),
                       heavy = run(pair("1e12"), initial, scheme, 0.05, 100);
            QVERIFY2(!light.empty() && !heavy.empty(), scheme.c_str());
            for (std::size_t k = 0; k < 2; ++k)
                QVERIFY2(std::abs(light[k] - heavy[k]) < 1e-9,
                         qPrintable(QString("%1: %2").arg(scheme.c_str()).arg(light[k] - heavy[k])));
        }
    }
    /// Far from a kick the masses of a chain move by 1e-20, 1e-40, .., each of which the next sweep finds:
    /// that is not waited for, and no reason for Newton's method. Seen failing: 400 masses took 40 sweeps a
    /// step and dense Jacobians in between.
    void aKickInALongChain_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("nodes");
        QTest::newRow("midpoint") << "midpoint" << 1;
        QTest::newRow("Gauss 4") << "galerkin-gauss-2" << 2;
        QTest::newRow("Gauss 8") << "galerkin-gauss-4" << 4;
        QTest::newRow("Lobatto 6") << "galerkin-lobatto-3" << 4;
    }
    void aKickInALongChain() {
        QFETCH(QString, scheme);
        QFETCH(int, nodes);
        const auto kicked = [](int masses) {
            std::string q;
            for (int i = 1; i <= masses; ++i)
                q += std::string(i > 1 ? ", " : "") + (i == masses / 2 ? "0.3" : "0");
            return "{'q': [" + q + "]}";
        };
        const std::string named = "'scheme': '" + scheme.toStdString() + "'";
        const auto sweeps = run(longChain(50), kicked(50), named, 0.1, 60),
                   newton =
                       run(longChain(50), kicked(50), named + ", 'solver': {'method': 'newton'}", 0.1, 60);
        QVERIFY(!sweeps.empty() && sweeps.size() == newton.size());
        double most = 0;
        for (std::size_t k = 0; k < sweeps.size(); ++k)
            most = std::max(most, std::abs(sweeps[k] - newton[k]));
        qInfo("%.1e", most);
        QVERIFY(most < 1e-14);

        constexpr int masses = 400, steps = 20;
        const ReadScene read = readScene(scene(longChain(masses), kicked(masses), named, 0.1));
        const auto integrator = tests::integratorOf(read);
        State state = read.resolved->initial;
        integrator->begin(state);
        long long evaluations = 0, solves = 0;
        for (int k = 0; k < steps; ++k) {
            const StepReport report = integrator->advance(state, (k + 1) * 0.1);
            QCOMPARE(report.outcome, Outcome::converged);
            evaluations += report.cost.evaluations;
            solves += report.cost.linearSolves;
        }
        const double each = static_cast<double>(evaluations) / (steps * nodes);
        qInfo("%.1f sweeps a step", each);
        QVERIFY(solves == 0 && each < 16);
    }
    /// An iteration that does not converge is not taken for one at round-off.
    void aStepThatIsTooLongFails() {
        const std::string stiff = typed("'x', 'y'", "(x_t^2 + y_t^2)/2 - exp(8*x) - exp(-8*x) - y^2/2");
        const ReadScene read =
            readScene(scene(stiff, "{'q': [1.5, 0]}", "'scheme': 'galerkin-gauss-6'", 2.5));
        const auto integrator = tests::integratorOf(read);
        State state = read.resolved->initial;
        integrator->begin(state);
        QVERIFY(integrator->advance(state, 2.5).outcome != Outcome::converged);
    }
};

EXTREMAL_TEST(BuriedCoordinatesTest)

}  // namespace extremal::buried_coordinates_test

#include "buried_coordinates_test.moc"
