// SPDX-License-Identifier: GPL-3.0-or-later
/// Running a scene: which nodes are rows, what the summary sees, how runs stop and fail.
#include <QTest>

#include <cmath>

#include "engine/observe/catalog.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/march/row_sampler.hpp"
#include "engine/run/run.hpp"
#include "engine/run/scheme_run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::run_test {
namespace {

Scene sceneFrom(const std::string& model, const std::string& initial, const std::string& end,
                const std::string& schemes, const std::string& rest) {
    const std::string text = "{\"extremal\":1,\"model\":" + model + ",\"initial\":" + initial +
                             ",\"time\":{\"end\":" + end + "},\"schemes\":[" + schemes + "]" + rest + "}";
    const ReadScene read = readScene(std::string_view(text));
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return read.scene;
}

const std::string kepler = R"({"type":"kepler"})";
const std::string keplerData = R"({"q":[0.4,0],"p":[0,2]})";

long long energyCalls = 0;
double (*realEnergy)(const void*, const double&, const double*, const double*) = nullptr;
double countedEnergy(const void* m, const double& t, const double* q, const double* p) {
    ++energyCalls;
    return realEnergy(m, t, q, p);
}

}  // namespace

class RunTest : public QObject {
    Q_OBJECT
private slots:
    void theStrideIsTheSmallestThatFits() {
        for (const long long steps :
             {0LL, 1LL, 1998LL, 1999LL, 2000LL, 2001LL, 3997LL, 3998LL, 3999LL, 5000LL, 10000000LL}) {
            const long long m = RowSampler::stride(steps);
            const auto rows = [&](long long k) { return steps / k + 1 + (steps % k != 0 ? 1 : 0); };
            QVERIFY(rows(m) <= 2000);
            if (m > 1) QVERIFY(rows(m - 1) > 2000);
        }
    }
    void rowsAreNodes_data() {
        QTest::addColumn<QString>("output");
        QTest::addColumn<QList<double>>("expected");
        QTest::newRow("every node") << "" << QList<double>{0, 0.25, 0.5, 0.75, 1, 1.25, 1.5, 1.75, 2};
        QTest::newRow("multiples that are nodes")
            << R"(,"output":{"every":0.5})" << QList<double>{0, 0.5, 1, 1.5, 2};
        QTest::newRow("first node at or after")
            << R"(,"output":{"every":0.6})" << QList<double>{0, 0.75, 1.25, 2};
        QTest::newRow("dense") << R"(,"output":{"every":0.6,"dense":true})"
                               << QList<double>{0, 0.6, 1.2, 1.8, 2};
    }
    void rowsAreNodes() {
        QFETCH(QString, output);
        QFETCH(QList<double>, expected);
        const Scene scene = sceneFrom(kepler, keplerData, "2.1",
                                      R"({"scheme":"galerkin-gauss-3","step":0.25})", output.toStdString());
        const Comparison c = run(scene);
        const auto t = c.schemes.at(0)->trajectory["t"];
        QCOMPARE(static_cast<qsizetype>(t.size()), expected.size());
        for (std::size_t i = 0; i < t.size(); ++i)
            QVERIFY(std::abs(t[i] - expected[static_cast<qsizetype>(i)]) < 1e-14);
        QCOMPARE(c.schemes[0]->summary.tEnd, 2.0);
        QCOMPARE(c.schemes[0]->summary.steps, 8LL);
    }
    void adaptiveCodesLandOnTheEnd() {
        const Scene scene =
            sceneFrom(kepler, keplerData, "7.7", R"({"baseline":"fehlberg78","tolerance":1e-10},
                                      {"baseline":"dopri5","tolerance":1e-6})",
                      R"(,"observe":["error"])");
        const Comparison c = run(scene);
        for (const auto& s : c.schemes) {
            QVERIFY(s->summary.status == RunStatus::done);
            QCOMPARE(s->summary.tEnd, 7.7);
            QVERIFY(s->trajectory.rows() <= 2000);
        }
        QVERIFY(c.schemes[0]->summary.maxError < 1e-8);
        QVERIFY(c.schemes[1]->summary.maxError < 1e-3);
    }
    void theSummarySeesEveryNode() {
        const std::string scheme = R"({"baseline":"stormer-verlet","step":0.01})";
        const Comparison coarse = run(sceneFrom(kepler, keplerData, "50", scheme,
                                                R"(,"observe":["energy","error"],"output":{"every":25})"));
        const Comparison all = run(sceneFrom(kepler, keplerData, "50", scheme,
                                             R"(,"observe":["energy","error"],"output":{"every":0.01})"));
        double worst = 0;
        for (const double e : all.schemes[0]->trajectory["energy_error"])
            worst = std::max(worst, std::abs(e));
        QCOMPARE(coarse.schemes[0]->trajectory.rows(), std::size_t(3));
        QCOMPARE(coarse.schemes[0]->summary.maxEnergyError, worst);
        QCOMPARE(coarse.schemes[0]->summary.maxError, all.schemes[0]->summary.maxError);
    }
    void onlyWhatIsAskedForIsComputed() {
        for (const bool asks : {false, true}) {
            const Scene scene = sceneFrom(kepler, keplerData, "5", R"({"scheme":"midpoint","step":0.01})",
                                          asks ? R"(,"observe":["energy"])" : R"(,"observe":["momentum"])");
            ResolvedScene resolved = resolve(scene);
            System system = *resolved.system;
            realEnergy = system.mechanics().energy;
            Mechanical counted = system.mechanics();
            counted.energy = &countedEnergy;
            system.parts.set(counted);
            energyCalls = 0;
            resolved.system = std::make_shared<const System>(system);
            const ProductPlan plan;
            SchemeRun task(resolved, 0, plan);
            task.run({}, nullptr, {});
            QVERIFY(task.latest()->summary.status == RunStatus::done);
            if (asks)
                QVERIFY(energyCalls >= 501);
            else
                // The start, 1 to 64, one of every 64 and the last: is it lost? And 32 states that are tried:
                // may steps jump out of where L is defined?
                QCOMPARE(energyCalls, 16 + 32);
        }
    }
    void resultsDoNotDependOnThreads() {
        const Scene scene = sceneFrom(R"({"type":"spring-pendulum"})", R"({"q":[0.05,1]})", "2",
                                      R"({"scheme":"midpoint","step":0.01},{"baseline":"rk4","step":0.001},
                                         {"scheme":"galerkin-lobatto-3","step":0.01},{"baseline":"fehlberg78","tolerance":1e-8})",
                                      R"(,"observe":["energy","error","effort","step"])");
        const Comparison one = run(scene, {1}), four = run(scene, {4});
        for (std::size_t i = 0; i < one.schemes.size(); ++i)
            QVERIFY(csvText(one.schemes[i]->trajectory) == csvText(four.schemes[i]->trajectory));
    }
    void aStoppedRunKeepsWhatIsDone_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("initial");
        QTest::addColumn<QString>("scheme");
        QTest::newRow("many cheap steps") << R"({"type":"kepler"})"
                                          << R"({"q":[0.4,0],"p":[0,2]})"
                                          << R"({"baseline":"stormer-verlet","step":1e-4})";
        QTest::newRow("Newton on a stiff system")
            << R"({"type":"spring-pendulum","k":1e8})"
            << R"({"q":[0.0005,1]})"
            << R"({"space":{"type":"polynomial","degree":12},"step":1e-3})";
    }
    /// Hours of work: the test ends only if the run stops.
    void aStoppedRunKeepsWhatIsDone() {
        QFETCH(QString, model);
        QFETCH(QString, initial);
        QFETCH(QString, scheme);
        for (const char* observe : {R"(,"observe":["energy"])", R"(,"observe":["error"])"}) {
            Run r(
                sceneFrom(model.toStdString(), initial.toStdString(), "9e6", scheme.toStdString(), observe));
            r.start();
            QTRY_VERIFY_WITH_TIMEOUT(r.fraction() > 0 || r.latest().schemes.at(0)->summary.steps > 0, 60000);
            r.stop();
            r.wait();
            const auto s = r.latest().schemes.at(0);
            QVERIFY(s->summary.status == RunStatus::partial && s->summary.steps > 0);
            QVERIFY(s->summary.tEnd > 0 && s->summary.tEnd < 9e6);
        }
    }
    /// Ten million rows inside one step: without a look at the stop between them all would be there.
    void aRunStopsBetweenTheRowsOfAStep() {
        Run r(sceneFrom(R"({"type":"harmonic-oscillator"})", R"({"q":[1],"p":[0]})", "1",
                        R"({"scheme":"midpoint","step":1})",
                        R"(,"observe":["energy"],"output":{"every":1e-7,"dense":true})"));
        r.start();
        (void)r.waitFor(std::chrono::milliseconds(20));
        r.stop();
        r.wait();
        const auto result = r.latest().schemes.at(0);
        QVERIFY(result->summary.status == RunStatus::partial && result->summary.cause == Outcome::stopped);
        QVERIFY(result->trajectory.rows() < 5'000'000);
    }
    /// Setting up a scheme takes long for wave functions of the plane: it is not done for nothing.
    void aSchemeThatHasNotBegunIsStoppedAtItsStart() {
        const Scene scene = sceneFrom(kepler, keplerData, "5", R"({"scheme":"midpoint","step":0.1})",
                                      R"(,"observe":["energy"])");
        const ResolvedScene resolved = resolve(scene);
        const ProductPlan plan;
        SchemeRun task(resolved, 0, plan);
        std::stop_source stop;
        stop.request_stop();
        task.run({}, nullptr, stop.get_token());
        const auto result = task.latest();
        QVERIFY(result->summary.status == RunStatus::partial && result->summary.cause == Outcome::stopped);
        QCOMPARE(result->summary.cost.evaluations, 0LL);
        QVERIFY2(csvText(result->trajectory) == "t,q.x,q.y,p.x,p.y\n0,0.4,0,0,2\n",
                 csvText(result->trajectory).c_str());
    }
    void troubleIsAnOutcomeAndOthersGoOn() {
        const Scene origin = sceneFrom(kepler, R"({"q":[0,0],"p":[0,1]})", "1",
                                       R"({"scheme":"midpoint","step":0.1},{"baseline":"rk4","step":0.1},
                                          {"baseline":"fehlberg78","tolerance":1e-8})",
                                       R"(,"observe":["energy","error"])");
        for (const auto& s : run(origin).schemes) {
            QVERIFY2(s->summary.status == RunStatus::failed, s->summary.label.c_str());
            QVERIFY(s->summary.cause != Outcome::converged && s->summary.cause != Outcome::stopped);
            QCOMPARE(s->summary.failedAt, 0.0);
        }
        const Scene stiff =
            sceneFrom(R"({"type":"spring-pendulum","k":1e6})", R"({"q":[0.005,1]})", "10",
                      R"({"baseline":"rk4","step":0.02},{"scheme":"galerkin-gauss-4","step":0.001},
                                         {"scheme":"galerkin-gauss-2","step":5})",
                      R"(,"observe":["energy"])");
        const Comparison c = run(stiff);
        QVERIFY(c.schemes[0]->summary.status == RunStatus::failed);
        QVERIFY(c.schemes[0]->summary.failedAt >= 0 && c.schemes[0]->summary.failedAt < 10);
        QVERIFY(!c.schemes[0]->summary.advice.empty());
        QVERIFY(c.schemes[1]->summary.status == RunStatus::done);
        QVERIFY(c.schemes[2]->summary.status == RunStatus::failed);  // Newton finds no such step
    }
    /// What a scheme turns out to be unable to do is not an outcome of its equations: here a potential that
    /// begins to depend on time after the scene was read.
    void whatASchemeCannotDoIsRefused() {
        Scene scene = sceneFrom(
            R"({"type":"schrodinger","modes":32,"potential":"1 - cos(x) "})",
            R"({"psi":{"packet":"periodic-gaussian","kappa":4,"centre":1,"wave_number":1}})", "0.01",
            R"({"baseline":"leapfrog","step":0.001},{"scheme":"schrodinger-gauss-1","step":0.001})",
            R"(,"reference":"none")");
        for (auto& [key, value] : scene.model.keys)
            if (key == "potential") value = "1 - cos(x - t)";
        const Comparison c = run(scene);
        const Summary& refused = c.schemes[0]->summary;
        QVERIFY(refused.status == RunStatus::failed);
        QCOMPARE(refused.cause, Outcome::refused);
        QVERIFY2(refused.advice.find("does not depend on t") != std::string::npos, refused.advice.c_str());
        QVERIFY(c.schemes[1]->summary.status == RunStatus::done);
    }
    void theOrderIsMeasuredBesideTheClaim() {
        const Scene scene = sceneFrom(kepler, keplerData, "3", R"({"scheme":"galerkin-gauss-2","step":0.02},
                                      {"baseline":"stormer-verlet","step":0.01},{"baseline":"rk4","step":0.01})",
                                      R"(,"observe":["order"])");
        for (const auto& s : run(scene).schemes)
            QVERIFY(std::abs(s->summary.orderMeasured - s->summary.orderClaimed) < 0.15);
    }
    /// Errors that are no larger than ten times the reference's own say nothing of the scheme.
    void noOrderIsMeasuredBelowTheReference() {
        const Scene scene = sceneFrom(
            kepler, keplerData, "3",
            R"({"scheme":"galerkin-gauss-2","step":0.02},{"baseline":"stormer-verlet","step":0.1})",
            R"(,"observe":["error","order"],"reference":{"type":"scheme","scheme":{"scheme":"midpoint","step":0.002}})");
        const Comparison c = run(scene);
        const Summary &fine = c.schemes[0]->summary, &coarse = c.schemes[1]->summary;
        const double own = c.reference.estimatedError;
        qInfo("the reference is good to %.1e; errors %.1e and %.1e, orders %.2f and %.2f", own, fine.maxError,
              coarse.maxError, fine.orderMeasured, coarse.orderMeasured);
        QVERIFY(fine.maxError > 0.1 * own && fine.maxError < 10 * own && coarse.maxError > 100 * own);
        QVERIFY(std::isnan(fine.orderMeasured));
        QVERIFY(std::abs(coarse.orderMeasured - 2) < 0.15);
    }
};

EXTREMAL_TEST(RunTest)
}  // namespace extremal::run_test

#include "run_test.moc"
