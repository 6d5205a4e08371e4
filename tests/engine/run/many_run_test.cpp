// SPDX-License-Identifier: GPL-3.0-or-later
/// Many motions at once have the bits of each by itself: over all schemes that take them together, on all
/// models that can be, and however a motion ends.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>

#include "engine/integrator/many_states.hpp"
#include "engine/run/cases/many_run.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::many_run_test {
namespace {

using Starts = std::vector<std::vector<double>>;

std::shared_ptr<const ResolvedScene> sceneOf(const std::string& model, const std::string& scheme, double end,
                                             const std::string& more = {}) {
    const ReadScene read =
        readScene(R"({"extremal":1,"model":)" + model + R"(,"time":{"end":)" + std::to_string(end) +
                  R"(},"reference":"none","observe":[],"schemes":[)" + scheme + "]" + more + "}");
    return read.resolved;
}

/// Around the start of the scene.
Starts startsOf(const ResolvedScene& scene, std::size_t count, double spread) {
    std::mt19937 random(7);
    Starts starts(count, scene.initial.x);
    for (auto& start : starts)
        for (double& x : start) x += spread * (static_cast<double>(random()) / 0x1p31 - 1);
    return starts;
}

/// The motion from a start by a run of its own.
State lastOf(const ResolvedScene& scene, const std::vector<double>& start) {
    State state{scene.scene.start.value, 0, start, {}};
    const auto integrator = scene.schemes[0].make(*scene.system, scene.schemes[0].spec.step.value, state);
    const long long steps =
        stepCount(scene.scene.start.value, scene.scene.end.value, scene.schemes[0].spec.step.value);
    while (state.node < steps && advance(*integrator, state).outcome == Outcome::converged) {
    }
    return state;
}

const std::vector<std::string> explicitSchemes{
    R"({"step":0.02,"baseline":"stormer-verlet"})", R"({"step":0.02,"baseline":"symplectic-euler"})",
    R"({"step":0.05,"baseline":"yoshida-4"})", R"({"step":0.05,"baseline":"srkn-11b"})",
    R"({"step":0.05,"scheme":"free-motion-2"})"};

}  // namespace

class ManyRunTest : public QObject {
    Q_OBJECT
private slots:
    void bitsAreThoseOfEachByItself_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<bool>("isTogether");
        QTest::newRow("kepler") << R"({"type":"kepler"})" << true;
        QTest::newRow("henon-heiles") << R"({"type":"henon-heiles"})" << true;
        QTest::newRow("typed")
            << R"({"type":"lagrangian","coordinates":["x","y"],)"
               R"("lagrangian":"x_t^2/2 + y_t^2/2 - 1/sqrt(1 + x^2) - x^2/2 - y^2 - x^2*y^2"})"
            << true;
        // They have no forces at many places at once.
        QTest::newRow("oscillator") << R"({"type":"harmonic-oscillator"})" << false;
        QTest::newRow("chain") << R"({"type":"fput-chain"})" << false;
        // A sine in lanes may round in another way.
        QTest::newRow("pendulum") << R"({"type":"pendulum"})" << false;
        // Its kinetic energy depends on the place.
        QTest::newRow("double-pendulum") << R"({"type":"double-pendulum"})" << false;
    }
    void bitsAreThoseOfEachByItself() {
        QFETCH(const QString, model);
        QFETCH(const bool, isTogether);
        for (const std::string& scheme : explicitSchemes) {
            const auto scene = sceneOf(model.toStdString(), scheme, 5);
            if (!scene) continue;  // the model has no such scheme
            const Starts starts = startsOf(*scene, 70, 0.05);
            const ManyMotions many = runMany(*scene, 0, starts, {2, true, {}}, {});
            const ManyMotions alone = runMany(*scene, 0, starts, {1, false, {}}, {});
            QCOMPARE(alone.together, std::size_t{0});
            if (isTogether) QVERIFY2(many.together == starts.size(), scheme.c_str());
            for (std::size_t i = 0; i < starts.size(); ++i) {
                QVERIFY(many.all[i].outcome == alone.all[i].outcome);
                QVERIFY2(many.all[i].x == alone.all[i].x, scheme.c_str());
                QCOMPARE(many.all[i].steps, alone.all[i].steps);
                QCOMPARE(many.all[i].t, alone.all[i].t);
                QCOMPARE(many.all[i].energyError, alone.all[i].energyError);
            }
            QVERIFY(many.all[69].x == lastOf(*scene, starts[69]).x);  // by another route
        }
    }

    void implicitAndAdaptiveSchemesGoAlone() {
        for (const char* scheme :
             {R"({"step":0.02,"scheme":"midpoint"})", R"({"baseline":"dopri5","tolerance":1e-8})"}) {
            const auto scene = sceneOf(R"({"type":"kepler"})", scheme, 3);
            const Starts starts = startsOf(*scene, 5, 0.01);
            const ManyMotions many = runMany(*scene, 0, starts, {}, {});
            QCOMPARE(many.together, std::size_t{0});
            for (const auto& motion : many.all) {
                QVERIFY(motion.outcome == Outcome::converged);
                QVERIFY(std::abs(motion.t - 3) < 1e-9 && std::abs(motion.energyError) < 1e-2);
            }
        }
    }

    /// Of starts that escape, collide or become infinite each ends as it would by itself.
    void whateverEndsAMotionIsFound() {
        const auto scene =
            sceneOf(R"({"type":"henon-heiles"})", R"({"step":0.2,"baseline":"stormer-verlet"})", 200);
        Starts starts = startsOf(*scene, 40, 0.02);
        starts[3] = {3, 3, 0, 0};     // beyond the saddles: it escapes to infinity
        starts[17] = {0, 1.2, 0, 5};  // likewise
        const ManyMotions many = runMany(*scene, 0, starts, {1, true, {}}, {});
        const ManyMotions alone = runMany(*scene, 0, starts, {1, false, {}}, {});
        QVERIFY(many.together > 30 && many.together < starts.size());
        QVERIFY(many.all[3].outcome != Outcome::converged && many.all[3].steps < 1000);
        for (std::size_t i = 0; i < starts.size(); ++i) {
            QVERIFY(many.all[i].outcome == alone.all[i].outcome);
            QCOMPARE(many.all[i].steps, alone.all[i].steps);
            QVERIFY(many.all[i].x == alone.all[i].x);
        }
    }

    void startsAreChecked() {
        const auto scene = sceneOf(R"({"type":"kepler"})", explicitSchemes[0], 1);
        const auto messageOf = [&](const Starts& starts) -> std::string {
            try {
                (void)runMany(*scene, 0, starts, {}, {});
            } catch (const InvalidScene& e) {
                return e.problems().front().pointer + " " + e.problems().front().message;
            }
            return "";
        };
        QCOMPARE(messageOf({{1, 0, 0, 1}, {1, 0, 0}}), std::string("/starts/1 must have 4 numbers, got 3"));
        QCOMPARE(messageOf({{1, 0, std::nan(""), 1}}), std::string("/starts/0/2 must be a finite number"));
        QCOMPARE(messageOf({}), std::string());
    }

    void aStopIsObeyed() {
        const auto scene =
            sceneOf(R"({"type":"kepler"})", R"({"step":1e-6,"baseline":"stormer-verlet"})", 1e4);
        std::stop_source stop;
        std::jthread later([&] { stop.request_stop(); });
        const ManyMotions many =
            runMany(*scene, 0, startsOf(*scene, 40, 0.01), {2, true, {}}, stop.get_token());
        for (const auto& motion : many.all) QVERIFY(motion.outcome == Outcome::stopped);
    }
};

EXTREMAL_TEST(ManyRunTest)

}  // namespace extremal::many_run_test

#include "many_run_test.moc"
