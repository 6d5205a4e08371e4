// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs check their own motion: what has left the motion is lost, and nothing else is.
#include <QTest>

#include <cmath>

#include "engine/run/march/motion_check.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::motion_check_test {
namespace {

/// The result of the only scheme.
SchemeResult resultOf(const std::string& text) {
    const ReadScene read = readScene(text);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *run(read.scene).schemes.front();
}

std::string oscillator(const std::string& scheme, double end) {
    return R"({"extremal":1,"model":{"type":"harmonic-oscillator"},"initial":{"q":[1]},"time":{"end":)" +
           std::to_string(end) +
           R"(},"reference":"none","observe":["energy"],"schemes":[{"allow_unstable":true,)" + scheme + "}]}";
}

std::string eccentric(const std::string& scheme, const char* end = "1") {
    return R"json({"extremal":1,"model":{"type":"kepler"},"initial":{"q":["1-0.9999",0],
        "p":[0,"sqrt((1+0.9999)/(1-0.9999))"]},"reference":"none","observe":["energy"],"time":{"end":)json" +
           std::string(end) + R"(},"schemes":[{)" + scheme + "}]}";
}

const std::string growingWave = R"json({"extremal":1,
    "model":{"type":"schrodinger","modes":64,"potential":"cos(x)"},
    "initial":{"psi":{"packet":"gaussian","centre":3,"width":0.3,"wave_number":5}},"time":{"end":20},
    "reference":"none","observe":["norm"],
    "schemes":[{"step":0.01,"baseline":"leapfrog","allow_unstable":true}]})json";

const std::string fromRest = R"({"extremal":1,"model":{"type":"pendulum"},
    "initial":{"q":["pi/2"]},"time":{"end":100},"reference":"none","observe":["energy"],
    "schemes":[{"step":STEP,"baseline":"stormer-verlet"}]})";

/// Over the pole, whose barrier a step of 0.2 does not see.
const std::string overThePole = R"json({"extremal":1,"model":{"type":"lagrangian",
    "coordinates":["theta","phi"],"lagrangian":"(theta_t^2+sin(theta)^2*phi_t^2)/2+cos(theta)"},
    "initial":{"q":[0.3,0],"v":[0,V]},"time":{"end":100},"reference":"none","observe":["energy"],
    "schemes":[{"step":H,"baseline":"BASELINE"}]})json";

const std::string forced = R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":["x"],
    "lagrangian":"x_t^2/2-x^2/2+x*cos(2*t)"},"initial":{"q":[1]},"time":{"end":10},"reference":"none",
    "observe":["energy"],"schemes":[{"step":0.1,"scheme":"midpoint"}]})json";

}  // namespace

class MotionCheckTest : public QObject {
    Q_OBJECT
private slots:
    /// Blocks are as long as the clock makes them: the verdict must not depend on that.
    void blocksDoNotMatter() {
        const ReadScene read = readScene(oscillator(R"("step":0.1,"baseline":"stormer-verlet")", 30));
        const System& system = *read.resolved->system;
        const State start{0, 0, {1, 0}};
        constexpr int nodes = 300;
        for (const std::size_t size : {1u, 7u, 50u, 64u, 300u}) {
            MotionCheck judge(system, start, 0.1);
            NodeBlock block(2, size);
            long long sound = -1;
            for (int k = 1; k <= nodes && sound < 0; ++k) {
                // A peak between nodes that are looked at, and growth from node 100 on.
                const double x = k == 70 ? 1e3 : k < 100 ? 1 : std::exp(0.2 * (k - 100));
                block.push(State{0.1 * k, k, {x, 0}}, {});
                if (block.size() < size && k < nodes) continue;
                const std::size_t good = judge.soundNodes(block, k == nodes);
                if (good < block.size()) sound = block.node(good) - 1;
                block.clear();
            }
            QCOMPARE(sound, 111LL);
        }
    }
    void schemesBeyondTheirLimitsAreLost() {
        for (const char* scheme :
             {R"("step":2.05,"baseline":"stormer-verlet")", R"("step":3,"baseline":"rk4")",
              R"("step":100,"baseline":"stormer-verlet")"}) {
            const Summary s = resultOf(oscillator(scheme, 2000)).summary;
            QCOMPARE(s.status, RunStatus::failed);
            QCOMPARE(s.cause, Outcome::lost);
            QVERIFY(s.failedAt < 500 && s.tEnd == s.failedAt);
        }
    }
    void schemesBelowTheirLimitsAreNot() {
        // Energies 50 times those of the motion, but for ever: h w = 1.98.
        const Summary s = resultOf(oscillator(R"("step":1.98,"baseline":"stormer-verlet")", 2e4)).summary;
        QCOMPARE(s.status, RunStatus::done);
        QCOMPARE(resultOf(oscillator(R"("step":1000,"scheme":"midpoint")", 1e6)).summary.status,
                 RunStatus::done);
    }
    void theZeroOfTheEnergyDoesNotMatter() {
        // H(0) = 6e-16, at rest, and a step close to the limit: 60 % of the energies, and bounded.
        const auto fall = [](const char* step) {
            return resultOf(QByteArray::fromStdString(fromRest).replace("STEP", step).toStdString()).summary;
        };
        const Summary s = fall("0.4");
        QCOMPARE(s.status, RunStatus::done);
        QVERIFY(s.maxEnergyError > 1);
        // Nothing holds it there at last: the pendulum turns over with 15 times the energy.
        const Summary over = fall("0.5");
        QCOMPARE(over.cause, Outcome::lost);
        QVERIFY(over.maxEnergyError > 100);
    }
    void aRootThatJumpsOverTheForceIsRefused() {
        for (const std::string scheme :
             {"galerkin-gauss-4", "galerkin-gauss-3", "galerkin-lobatto-4", "midpoint"}) {
            const Summary s = resultOf(eccentric("\"step\":0.05,\"scheme\":\"" + scheme + "\"")).summary;
            qInfo("%s: %s, failed at %g, energy error %g", scheme.c_str(), name(s.cause).data(), s.failedAt,
                  s.maxEnergyError);
            QVERIFY(s.status == RunStatus::failed);
        }
        QCOMPARE(resultOf(eccentric(R"("step":0.05,"scheme":"galerkin-gauss-4")")).summary.cause,
                 Outcome::lost);
    }
    void stepsThatResolveTheForceAreTaken() {
        const Summary s = resultOf(eccentric(R"("step":1e-7,"scheme":"galerkin-gauss-4")", "1e-4")).summary;
        QCOMPARE(s.status, RunStatus::done);
        QVERIFY(s.maxEnergyError < 1e-4);  // of energies of 10^4
    }
    void wavesAreJudgedByTheirNorm() {
        const Summary s = resultOf(growingWave).summary;
        QCOMPARE(s.status, RunStatus::failed);
        QCOMPARE(s.cause, Outcome::lost);
    }
    /// They had seven times the energy for half of the run, and were done: by then it was twice as much.
    void energyThatCameFromNowhereIsNotForgotten() {
        const auto motion = [](const char* v, const char* h, const char* baseline) {
            return resultOf(QByteArray::fromStdString(overThePole)
                                .replace("V]", QByteArray(v) + "]")
                                .replace("\"step\":H", QByteArray("\"step\":") + h)
                                .replace("BASELINE", baseline)
                                .toStdString())
                .summary;
        };
        for (const char* v : {"0.01", "0.02"}) {
            const Summary s = motion(v, "0.2", "stormer-verlet");
            qInfo("v = %s: %s at t = %g, energy error %g", v, name(s.cause).data(), s.failedAt,
                  s.maxEnergyError);
            QCOMPARE(s.cause, Outcome::lost);
            QVERIFY(s.advice.find("pole of the coordinates") != std::string::npos);
        }
        const Summary s = motion("0.02", "0.001", "stormer-verlet");
        QCOMPARE(s.status, RunStatus::done);
        QVERIFY(s.maxEnergyError < 0.05);
    }
    /// Close to the limit the error beats; it does not stay.
    void beatsAreNotShifts() {
        for (const char* h : {"1.9", "1.98", "1.985"}) {
            const Summary s =
                resultOf(oscillator(std::string("\"step\":") + h + R"(,"baseline":"stormer-verlet")", 500))
                    .summary;
            QCOMPARE(s.status, RunStatus::done);
        }
    }
    void whatIsNotConservedHasNoError() {
        const Summary s = resultOf(forced).summary;
        QVERIFY(std::isnan(s.maxEnergyError) && std::isnan(s.energyDrift));
    }
};

EXTREMAL_TEST(MotionCheckTest)
}  // namespace extremal::motion_check_test
#include "motion_check_test.moc"
