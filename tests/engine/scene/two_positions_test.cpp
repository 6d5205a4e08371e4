// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::two_positions_test {
namespace {

std::string sceneText(const std::string& initial, const std::string& schemes, const std::string& more = "") {
    return R"({"extremal":1,"model":{"type":"kepler"},"initial":)" + initial +
           R"(,"time":{"end":4},"schemes":[)" + schemes + "]" + more + "}";
}
const std::string twoPositions = R"({"q":[0.4,0],"q1":[0.38,0.19]})";
const std::string threeSchemes =
    R"({"step":0.1,"scheme":"midpoint"},{"step":0.1,"baseline":"stormer-verlet"},{"tolerance":1e-10,"baseline":"fehlberg78"})";

std::string firstError(const std::string& text) {
    const ReadScene read = readScene(text);
    return read.errors.empty() ? "" : read.errors[0].pointer + ": " + read.errors[0].message;
}

}  // namespace

class TwoPositionsTest : public QObject {
    Q_OBJECT
private slots:
    void theTimeBetweenThemIsTheCommonStep() {
        const ReadScene read = readScene(sceneText(twoPositions, threeSchemes));
        QVERIFY(read.errors.empty());
        QCOMPARE(read.scene.initial.at->value, 0.1);
        const ReadScene again = readScene(writeScene(read.scene));
        QVERIFY(again.scene == read.scene);
    }
    void whatCannotBeIsSaid_data() {
        QTest::addColumn<QString>("initial");
        QTest::addColumn<QString>("schemes");
        QTest::addColumn<QString>("start");
        const QString one = R"({"step":0.1,"scheme":"midpoint"})",
                      two = one + R"(,{"step":0.05,"scheme":"midpoint"})";
        const QString good = QString::fromStdString(twoPositions);
        QTest::newRow("different steps") << good << two << "/initial/at: is required";
        QTest::newRow("a step that does not divide the time")
            << R"({"q":[0.4,0],"q1":[0.38,0.19],"at":0.12})" << one << "/schemes/0/step: 0.1 does not reach";
        QTest::newRow("no step at all") << good << R"({"tolerance":1e-8,"baseline":"dopri5"})"
                                        << "/initial/at: is required";
        QTest::newRow("momentum as well")
            << R"({"q":[0.4,0],"q1":[0.38,0.19],"p":[0,2]})" << one << "/initial: has both p and q1";
        QTest::newRow("time alone") << R"({"q":[0.4,0],"at":0.1})" << one << "/initial/at: requires q1";
        QTest::newRow("a time that is not a time") << R"({"q":[0.4,0],"q1":[0.38,0.19],"at":-1})" << one
                                                   << "/initial/at: must be a positive finite number, got -1";
        QTest::newRow("a position too short")
            << R"({"q":[0.4,0],"q1":[0.38]})" << one << "/initial/q1: must have 2 numbers";
        // Through the centre of attraction there is no motion.
        QTest::newRow("the other side of the centre")
            << R"({"q":[0.4,0],"q1":[-0.4,0]})" << one << "/initial/q1: no motion";
    }
    void whatCannotBeIsSaid() {
        QFETCH(QString, initial);
        QFETCH(QString, schemes);
        QFETCH(QString, start);
        const std::string error = firstError(sceneText(initial.toStdString(), schemes.toStdString()));
        QVERIFY2(error.starts_with(start.toStdString()), error.c_str());
    }
    void theExactMotionPassesThroughBoth() {
        const Scene scene = readScene(sceneText(twoPositions, threeSchemes)).scene;
        const System system = makeSystem(scene);
        const State start = exactStart(scene, system);
        std::vector<double> x(4);
        system.exact(start)(0.1, x);
        QVERIFY(std::hypot(x[0] - 0.38, x[1] - 0.19) < 1e-14);
    }
    void everySchemePassesThroughBoth_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("step");
        for (const char* scheme :
             {R"("scheme":"midpoint")", R"("scheme":"galerkin-lobatto-3")",
              R"("space":{"type":"spline","degree":2})", R"("baseline":"stormer-verlet")",
              R"("baseline":"rk4")", R"("baseline":"symplectic-euler")"})
            for (const int n : {1, 2, 5, 50})  // 50: beyond the nodal equations, by shooting
                QTest::addRow("%s, %d steps", scheme, n) << QString(scheme) << 0.1 / n;
    }
    void everySchemePassesThroughBoth() {
        QFETCH(QString, scheme);
        QFETCH(double, step);
        const std::string text =
            sceneText(R"({"q":[0.4,0],"q1":[0.38,0.19],"at":0.1})",
                      "{" + scheme.toStdString() + ",\"step\":" + std::to_string(step) + "}");
        const ReadScene read = readScene(text);
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const System system = makeSystem(read.scene);
        const SchemeSpec& spec = read.scene.schemes[0];
        State state = schemeStart(*read.resolved, read.resolved->schemes[0], step);
        const double own = std::hypot(state.x[2] - 0.1, state.x[3] - 1.95);
        const auto integrator = resolve(spec).make(system, step, state);
        while (state.t < 0.1 - 1e-9) QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
        const double miss = std::hypot(state.x[0] - 0.38, state.x[1] - 0.19);
        qInfo("misses by %.1e", miss);
        QVERIFY(miss < 1e-14);
        QVERIFY(own < 0.8);
    }
    void theMultiplierIsTheMomentumInEveryRow() {
        const std::string schemes =
            R"({"step":0.1,"scheme":"galerkin-gauss-2"},{"step":0.1,"baseline":"stormer-verlet"})";
        const Comparison c =
            run(readScene(sceneText(twoPositions, schemes, R"(,"observe":["multiplier"])")).scene);
        const Trajectory& discretization = c.schemes[0]->trajectory;
        QCOMPARE(discretization["multiplier"].size(), std::size_t(41));
        for (std::size_t r = 0; r < 41; ++r) {
            QVERIFY(discretization["multiplier_error"][r] < 1e-14);  // measured: below 3e-15
            QVERIFY(std::abs(discretization["multiplier.x"][r] - discretization["p.x"][r]) < 1e-14);
        }
        for (const double v : c.schemes[1]->trajectory["multiplier"]) QVERIFY(std::isnan(v));
    }
};

EXTREMAL_TEST(TwoPositionsTest)
}  // namespace extremal::two_positions_test

#include "two_positions_test.moc"
