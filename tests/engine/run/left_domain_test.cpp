// SPDX-License-Identifier: GPL-3.0-or-later
/// A step that jumps to a finite state outside of where the Lagrangian is defined ends the run, as lost, at
/// the node before: of every family and baseline, whether the energy was asked for or not.
#include <QTest>

#include <cmath>
#include <utility>
#include <vector>

#include "engine/model/conservative.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/stability/stability.hpp"
#include "tests/tools/test.hpp"

namespace extremal::left_domain_test {
namespace {

/// The text with words in place of LAGRANGIAN, SCHEME, ...
std::string filled(const char* text, const std::vector<std::pair<const char*, std::string>>& words) {
    QByteArray all(text);
    for (const auto& [name, word] : words) all.replace(name, QByteArray::fromStdString(word));
    return all.toStdString();
}

std::string motion(const std::string& lagrangian, const std::string& scheme, const std::string& observe,
                   const std::string& initial = "0.05") {
    return filled(
        R"json({"extremal":1,
        "model":{"type":"lagrangian","coordinates":["x"],"lagrangian":"LAGRANGIAN"},
        "initial":{"q":[INITIAL]},"time":{"end":10},"reference":"none","observe":OBSERVE,
        "schemes":[{"allow_unstable":true,SCHEME}]})json",
        {{"LAGRANGIAN", lagrangian}, {"SCHEME", scheme}, {"OBSERVE", observe}, {"INITIAL", initial}});
}

SchemeResult resultOf(const std::string& text) {
    const ReadScene read = readScene(text);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *run(read.scene).schemes.front();
}

const std::string wall = "x_t^2/2-(x-log(x))";
const std::string gauss4 = R"("step":0.4,"scheme":"galerkin-gauss-4")";

const std::string charged = R"json({"extremal":1,"model":{"type":"charged-particle",
    "scalar_potential":"x-log(x)","vector_potential":["0","0.1*x","0"]},"initial":{"q":[0.05,0,0]},
    "time":{"end":10},"reference":"none","observe":["energy"],
    "schemes":[{"tolerance":0.1,"baseline":"dopri5"}]})json";

std::string body(const std::string& scheme) {
    return filled(R"json({"extremal":1,"model":{"type":"rigid-body-se3","inertia":[1,2,3],"mass":1,
        "potential":"x-log(x)"},"initial":{"position":[0.05,0,0],"omega":[0.1,0.2,0.3]},"time":{"end":10},
        "reference":"none","observe":["energy"],"schemes":[{SCHEME}]})json",
                  {{"SCHEME", scheme}});
}

std::string field(const std::string& scheme, const std::string& boundary) {
    return filled(R"json({"extremal":1,"model":{"type":"field","wave_speed":1,"potential":"u-log(u)",
        "domain":[0,1],"cells":16,"boundary":"BOUNDARY"},
        "initial":{"u":"0.05+0.001*sin(pi*x)^2","u_t":"0"},"time":{"end":10},"reference":"none",
        "observe":["energy"],"schemes":[{"allow_unstable":true,SCHEME}]})json",
                  {{"BOUNDARY", boundary}, {"SCHEME", scheme}});
}

}  // namespace

class LeftDomainTest : public QObject {
    Q_OBJECT

    static void verifyLost(const std::string& text) {
        const SchemeResult r = resultOf(text);
        const Summary& s = r.summary;
        qInfo("%s, %s at t = %g, energy error %g: %s", name(s.status), name(s.cause).data(), s.failedAt,
              s.maxEnergyError, s.advice.c_str());
        QCOMPARE(s.status, RunStatus::failed);
        QCOMPARE(s.cause, Outcome::lost);
        QVERIFY(std::isfinite(s.maxEnergyError));
        QVERIFY(s.advice.find("not a number") != std::string::npos);
    }

private slots:
    void theFirstNodeBeyondEndsTheRun_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* scheme :
             {R"("step":0.4,"scheme":"galerkin-gauss-4")", R"("step":0.4,"scheme":"galerkin-gauss-2")",
              R"("step":0.4,"baseline":"stormer-verlet")"})
            QTest::addRow("%s", scheme) << QString(scheme);
    }
    /// Every row has an energy, and a run without energies ends at the same node.
    void theFirstNodeBeyondEndsTheRun() {
        QFETCH(QString, scheme);
        for (const std::string& lagrangian : {wall, std::string("x_t^2/2-(x-log(x))+1e-3*x*sin(t)")}) {
            const SchemeResult with = resultOf(motion(lagrangian, scheme.toStdString(), R"(["energy"])")),
                               without = resultOf(motion(lagrangian, scheme.toStdString(), "[]"));
            QCOMPARE(with.summary.status, RunStatus::failed);
            QCOMPARE(with.summary.cause, Outcome::lost);
            for (const double e : with.trajectory.find("energy")->values) QVERIFY(std::isfinite(e));
            QCOMPARE(without.summary.cause, Outcome::lost);
            QCOMPARE(without.summary.steps, with.summary.steps);
            QCOMPARE(without.summary.failedAt, with.summary.failedAt);
            QCOMPARE(with.summary.tEnd, with.summary.failedAt);
        }
    }
    void theStepThatIsAdvisedWorks() {
        const std::string advice = resultOf(motion(wall, gauss4, "[]")).summary.advice;
        QVERIFY(advice.ends_with("Try h ≤ 0.025."));
        const Summary s =
            resultOf(motion(wall, R"("step":0.025,"scheme":"galerkin-gauss-4")", R"(["energy"])")).summary;
        QCOMPARE(s.status, RunStatus::done);
        QVERIFY(s.maxEnergyError < 1e-8);  // 4.6e-9
    }
    void theReasonMayBeTheTimeAlone() {
        for (const char* scheme :
             {R"("step":0.1,"scheme":"galerkin-gauss-4")", R"("step":0.1,"baseline":"stormer-verlet")",
              R"("tolerance":1e-6,"baseline":"dopri5")"}) {
            const Summary s = resultOf(motion("x_t^2/2-x^2/2+log(5-t)", scheme, "[]", "1")).summary;
            QCOMPARE(s.cause, Outcome::lost);
            QVERIFY(s.failedAt < 5 && s.failedAt > 4.5);
            QVERIFY(s.advice.find("Try an end before that") != std::string::npos);
        }
    }
    void chargesBodiesAndFieldsToo() {
        verifyLost(charged);
        verifyLost(body(R"("step":0.4,"scheme":"lie-2")"));
        verifyLost(body(R"("step":0.4,"baseline":"rigid-splitting")"));
        verifyLost(field(R"("step":0.4,"baseline":"leapfrog")", "periodic"));
        verifyLost(field(R"("step":0.4,"baseline":"method-of-lines-rk4")", "periodic"));
        verifyLost(field(R"("space":{"type":"tent","degree":{"space":1,"time":2}},"step":0.4)", "periodic"));
        verifyLost(field(R"("step":0.2,"space":{"type":"moving-mesh","nodes":7})", "dirichlet"));
    }
    /// On blocks of every length, with an edge that is met once between the nodes that are sampled.
    void blocksDoNotMatter() {
        const ReadScene read = readScene(motion(wall, gauss4, "[]"));
        const System& system = *read.resolved->system;
        for (const std::size_t size : {1u, 7u, 64u, 200u}) {
            MotionCheck judge(system, State{0, 0, {0.05, 0}}, 0.4);
            NodeBlock block(2, size);
            long long sound = -1;
            for (int k = 1; k <= 200 && sound < 0; ++k) {
                block.push(State{0.4 * k, k, {k == 90 ? -1.0 : 1.0, 0}}, {});
                if (block.size() < size && k < 200) continue;
                const std::size_t good = judge.soundNodes(block, k == 200);
                if (good < block.size()) sound = block.node(good) - 1;
                block.clear();
            }
            QCOMPARE(sound, 89LL);
            QVERIFY(judge.hasLeftDomain());
        }
    }
    void studiesOfStabilitySeeIt() {
        const ReadScene read = readScene(motion(wall, gauss4, "[]"));
        const StabilityResult r = runStability(read.scene, 0, {}, {});
        QCOMPARE(r.kind, StabilityClass::blowUp);
        QCOMPARE(r.cause, Outcome::lost);
    }
    void motionsWithinTheirDomainAreDone() {
        for (const char* scheme :
             {R"("step":0.01,"scheme":"galerkin-gauss-2")", R"("step":0.01,"baseline":"stormer-verlet")"}) {
            const Summary s = resultOf(motion(wall, scheme, R"(["energy"])")).summary;
            QCOMPARE(s.status, RunStatus::done);
            QVERIFY(s.maxEnergyError < 0.01);
        }
    }
};

EXTREMAL_TEST(LeftDomainTest)
}  // namespace extremal::left_domain_test
#include "left_domain_test.moc"
