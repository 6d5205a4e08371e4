// SPDX-License-Identifier: GPL-3.0-or-later
/// The last force of a step, or of a part of a composition, is the first of the next where that begins at
/// exactly the same place: fewer evaluations, the same bits.
#include <QTest>

#include <cmath>
#include <numeric>

#include "engine/baseline/catalog.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::shared_force_test {

namespace {

/// Bogacki's and Shampine's method of order 3, whose last stage is where the next step begins.
constexpr const char* firstSameAsLast =
    R"json("baseline":{"type":"runge-kutta","a":[[],["1/2"],[0,"3/4"],["2/9","1/3","4/9"]],
    "b":["2/9","1/3","4/9",0]})json";
constexpr const char* kepler = R"json("model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]})json";
constexpr const char* pendulum = R"json("model":{"type":"pendulum"},"initial":{"q":[2.5],"p":[0]})json";
/// Its forces depend on time, and t + h may differ from the time of the next node by rounding.
constexpr const char* forced = R"json("model":{"type":"lagrangian","coordinates":["x"],
    "lagrangian":"x_t^2/2 - x^2/2 - x^4/4 + x*cos(3*t)"},"initial":{"q":[1]})json";

ReadScene sceneOf(const std::string& problem, const std::string& scheme) {
    return readScene("{\"extremal\":1," + problem +
                     ",\"time\":{\"end\":5},\"observe\":[\"energy\"],\"reference\":\"none\"," +
                     "\"schemes\":[{\"step\":0.05," + scheme + "}]}");
}

}  // namespace

class SharedForceTest : public QObject {
    Q_OBJECT
private slots:
    /// Of 100 steps. Seen failing: 599 to 601 of linear functions under the trapezoidal rule, which were
    /// iterated, 400 of the Runge-Kutta method, and 200 of Stoermer-Verlet in forces that depend on time.
    /// Where there is a range, the end of a step and the start of the next differ in their last bits at
    /// times. Of linear functions they did too (101 to 190), as the last node was rounded otherwise than the
    /// end of the step.
    void explicitSchemesEvaluateEachForceOnce_data() {
        QTest::addColumn<QString>("problem");
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<int>("least");
        QTest::addColumn<int>("most");
        const auto row = [](const char* problem, const QString& scheme, int least, int most) {
            QTest::addRow("%.24s, %s", problem, qPrintable(scheme)) << problem << scheme << least << most;
        };
        for (const char* problem : {kepler, pendulum, forced}) {
            const bool isForced = problem == forced;
            for (const char* scheme : {"trapezoidal", "stormer-verlet-pair", "galerkin-lobatto-1",
                                       "lobatto-iiia-iiib-2", "spectral-clenshaw-curtis-1"})
                row(problem, QString("\"scheme\":\"%1\"").arg(scheme), 101, isForced ? 190 : 101);
            const auto baseline = [&](const char* id, int count, int most) {
                row(problem, QString("\"baseline\":\"%1\"").arg(id), count, isForced ? most : count);
            };
            baseline("stormer-verlet", 101, 170);
            baseline("stormer-verlet-position", 100, 100);
            baseline("symplectic-euler", 100, 100);
            baseline("symplectic-euler-position", 100, 100);
            baseline("blanes-moan-s6", 601, 695);
            baseline("blanes-moan-s10", 1001, 1095);
            baseline("srkn-6b", 601, 695);
            baseline("srkn-11b", 1101, 1199);
            baseline("srkn-14a", 1400, 1400);
            baseline("rk4", 400, 400);
            row(problem, firstSameAsLast, 301, 360);
            for (const auto& [order, parts] : {std::pair{4, 3}, std::pair{6, 9}})
                row(problem,
                    QString(R"("scheme":"trapezoidal","composition":{"type":"yoshida","order":%1})")
                        .arg(order),
                    100 * parts + 1, 150 * parts);
        }
    }
    void explicitSchemesEvaluateEachForceOnce() {
        QFETCH(QString, problem);
        QFETCH(QString, scheme);
        QFETCH(int, least);
        QFETCH(int, most);
        const ReadScene read = sceneOf(problem.toStdString(), scheme.toStdString());
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const Summary summary = run(read.scene).schemes.at(0)->summary;
        QCOMPARE(summary.steps, 100LL);
        QVERIFY2(summary.cost.evaluations >= least && summary.cost.evaluations <= most,
                 qPrintable(QString::number(summary.cost.evaluations)));
    }
    /// With many coordinates one of them in another place was enough: 723 of 20 masses, 940 of 1000.
    void manyCoordinatesDoSo() {
        QString names, kinetic, potential = "-x1^2/2 - x20^2/2";
        for (int i = 1; i <= 20; ++i) {
            names += QString(R"j(%1"x%2")j").arg(i > 1 ? "," : "").arg(i);
            kinetic += QString(i > 1 ? " + x%1_t^2/2" : "x%1_t^2/2").arg(i);
            if (i > 1) potential += QString(" - (x%1-x%2)^2/2 - (x%1-x%2)^4/4").arg(i).arg(i - 1);
        }
        QStringList q;
        for (int i = 1; i <= 20; ++i) q += QString::number(0.3 * std::sin(1.3 * i * i));
        const QString problem =
            QString(R"j("model":{"type":"lagrangian","coordinates":[%1],"lagrangian":"%2"},
            "initial":{"q":[%3]})j")
                .arg(names, kinetic + potential, q.join(','));
        for (const char* scheme : {"trapezoidal", "stormer-verlet-pair"}) {
            const ReadScene read =
                sceneOf(problem.toStdString(), "\"scheme\":\"" + std::string(scheme) + "\"");
            QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
            QCOMPARE(run(read.scene).schemes.at(0)->summary.cost.evaluations, 101LL);
        }
    }
    /// Against integrators that know of no step before.
    void sharingKeepsTheBits_data() { explicitSchemesEvaluateEachForceOnce_data(); }
    void sharingKeepsTheBits() {
        QFETCH(QString, problem);
        QFETCH(QString, scheme);
        const ReadScene read = sceneOf(problem.toStdString(), scheme.toStdString());
        QVERIFY(read.errors.empty());
        const System& system = *read.resolved->system;
        const ResolvedScheme& resolved = read.resolved->schemes.front();
        if (resolved.family && !resolved.isComposed())
            QSKIP("carries what is lost to rounding from step to step");
        State together = read.resolved->initial, apart = together;
        const auto whole = resolved.make(system, 0.05, together);
        whole->begin(together);
        for (int k = 0; k < 100; ++k) {
            QCOMPARE(whole->advance(together, (k + 1) * 0.05).outcome, Outcome::converged);
            const auto alone = resolved.make(system, 0.05, apart);
            alone->begin(apart);
            QCOMPARE(alone->advance(apart, (k + 1) * 0.05).outcome, Outcome::converged);
            QVERIFY(together.x == apart.x);
        }
    }
    /// The trapezoidal rule is Stoermer-Verlet, whichever way its forces are found.
    void theTrapezoidalRuleIsVerlet() {
        for (const char* problem : {kepler, pendulum, forced}) {
            const auto endOf = [&](const char* scheme) {
                const Trajectory rows = run(sceneOf(problem, scheme).scene).schemes.at(0)->trajectory;
                return rows.columns[1].values.back();
            };
            const double difference =
                endOf(R"("scheme":"trapezoidal")") - endOf(R"("baseline":"stormer-verlet")");
            QVERIFY2(std::abs(difference) < 1e-13, qPrintable(QString::number(difference)));
        }
    }
    void compositionsEvaluateEachForceOnce() {
        const ReadScene read = readScene(std::string(R"json({"extremal":1,"model":{"type":"kepler"},
            "initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":10},"schemes":[{"scheme":"midpoint","step":0.1}]})json"));
        const System& system = *read.resolved->system;
        const BaselineEntry* verlet = findBaseline("stormer-verlet");
        for (const char* type : {"yoshida", "suzuki"}) {
            const Settings keys{type, {{"order", 4.0}}, {}};
            const std::vector<double> parts = compositionParts(keys, 2);
            constexpr double h = 0.1;
            constexpr int steps = 100;
            const auto whole = composed(parts, *verlet->make(system, {h, {}, 0, {}}));
            State together{0, 0, {0.4, 0, 0, 2}, {}}, apart = together;
            whole->begin(together);
            long long evaluations = 0;
            for (int k = 0; k < steps; ++k) {
                const StepReport report = whole->advance(together, (k + 1) * h);
                QCOMPARE(report.outcome, Outcome::converged);
                evaluations += report.cost.evaluations;
                for (const double part : parts) {
                    const auto alone = verlet->make(system, {part * h, {}, 0, {}});
                    QCOMPARE(alone->advance(apart, apart.t + part * h).outcome, Outcome::converged);
                }
            }
            QCOMPARE(evaluations, static_cast<long long>(steps * parts.size() + 1));
            QVERIFY(together.x == apart.x);
        }
    }
};

EXTREMAL_TEST(SharedForceTest)
}  // namespace extremal::shared_force_test
#include "shared_force_test.moc"
