// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes with a typed Lagrangian: reading, overrides, writing, and errors at their place.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::typed_scene_test {
namespace {

const std::string spring = R"({"extremal": 1,
  "model": {"type": "lagrangian", "coordinates": ["x"],
            "parameters": {"m": 2, "k": "m*w^2", "w": 3}, "lagrangian": "m/2*x_t^2 - k/2*x^2"},
  "initial": {"q": ["1/w"], "v": [0]}, "time": {"end": "2*pi/w"},
  "schemes": [{"label": "a", "step": 0.01, "scheme": "midpoint"}], "observe": ["energy"]})";

Problem firstError(const std::string& text, const std::vector<Override>& overrides = {}) {
    const ReadScene read = readScene(text, overrides);
    return read.errors.empty() ? Problem{} : read.errors.front();
}

std::vector<Override> set(const std::string& text) { return {parseOverride(text)}; }

}  // namespace

class TypedSceneTest : public QObject {
    Q_OBJECT
private slots:
    void parametersAreKnownToNumbersAndToEachOther() {
        const ReadScene read = readScene(spring);
        QVERIFY(read.errors.empty() && read.warnings.empty());
        QCOMPARE(read.scene.initial.q[0].value, 1.0 / 3);
        QCOMPARE(read.scene.model.find("parameters")->find("k")->asNumber(), 18.0);
        const ReadScene other = readScene(spring, set("/model/parameters/w=6"));
        QVERIFY(other.errors.empty());
        QCOMPARE(other.scene.model.find("parameters")->find("k")->asNumber(), 72.0);
        QCOMPARE(other.scene.initial.q[0].value, 1.0 / 6);
    }
    void writingKeepsExpressionsAndBytes() {
        const std::string once = writeScene(readScene(spring).scene);
        QVERIFY(once.find("\"k\": \"m*w^2\"") != std::string::npos);
        QCOMPARE(writeScene(readScene(once).scene), once);
    }
    void overridesReachTheLagrangianAndNoUnknownParameter() {
        QCOMPARE(firstError(spring, set("/model/lagrangian=m/2*x_t^2 - k/4*x^4")).message, std::string());
        const Problem unknown = firstError(spring, set("/model/parameters/kk=1"));
        QCOMPARE(unknown.message, std::string("unknown key \"kk\""));
        QCOMPARE(unknown.hint, std::string("did you mean \"k\"?"));
        QCOMPARE(firstError(spring, set(R"(/model/parameters={"m": 1, "k": 1, "w": 1, "extra": 2})")).message,
                 std::string());
        const Problem wrong = firstError(spring, set("/model/lagrangian=m/2*x_t^2 - j*x"));
        QCOMPARE(wrong.pointer, std::string("/model/lagrangian"));
        QCOMPARE(wrong.origin, std::string("/model/lagrangian"));
    }
    void errorsAreAtTheirPlace_data() {
        QTest::addColumn<QString>("override");
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("message");
        QTest::newRow("text as names") << "/model/coordinates=5"
                                       << "/model/coordinates"
                                       << "must be an array of names, got 5";
        QTest::newRow("number as name") << "/model/coordinates=[5]"
                                        << "/model/coordinates/0"
                                        << "must be a text in quotes, got 5";
        QTest::newRow("no coordinate") << "/model/coordinates=[]"
                                       << "/model/coordinates"
                                       << "needs at least one name";
        QTest::newRow("parameter") << "/model/parameters/m=true"
                                   << "/model/parameters/m"
                                   << "must be a finite number, got true";
        QTest::newRow("circle") << R"(/model/parameters={"m": "k", "k": "m", "w": 1})"
                                << "/model/parameters/m"
                                << "depends on itself: m -> k -> m";
        QTest::newRow("velocity in a number") << "/time/end=dot(x)"
                                              << "/time/end"
                                              << "dot(...), which stands for a velocity";
        QTest::newRow("degenerate") << "/model/lagrangian=x_t*x"
                                    << "/model/lagrangian"
                                    << "is degenerate";
        QTest::newRow("degenerate for a parameter") << "/model/parameters/m=0"
                                                    << "/model/lagrangian"
                                                    << "is degenerate";
        QTest::newRow("not finite at the start")
            << "/model/lagrangian=x_t^2 + log(x - 1)"
            << "/model/lagrangian"
            << "is not finite, or has no finite derivatives, at the initial data";
        QTest::newRow("degenerate at the start") << "/model/lagrangian=(x - 1/w)^2*x_t^2"
                                                 << "/model/lagrangian"
                                                 << "is degenerate at the initial data";
        QTest::newRow("at a pole") << "/model/lagrangian=x_t^2*(1 + sin(x - 1/w)^2)*sin(x - 1/w)^2 - x"
                                   << "/model/lagrangian"
                                   << "its second derivative with respect to x_t vanishes there";
        QTest::newRow("too many data") << "/initial/q=[1, 2]"
                                       << "/initial/q"
                                       << "must have 1 number (x), got 2";
        QTest::newRow("no wave function") << "/observe=[\"norm\"]"
                                          << "/observe/0"
                                          << "norm is not defined for lagrangian";
    }
    void errorsAreAtTheirPlace() {
        QFETCH(QString, override);
        QFETCH(QString, pointer);
        QFETCH(QString, message);
        const Problem problem = firstError(spring, set(override.toStdString()));
        QCOMPARE(QString::fromStdString(problem.pointer), pointer);
        QVERIFY2(QString::fromStdString(problem.message).contains(message), problem.message.c_str());
    }
    void requiredKeysAreMissed() {
        const std::string bare = R"({"extremal": 1, "model": {"type": "lagrangian"}, "time": {"end": 1},
                                     "schemes": [{"step": 0.1, "scheme": "midpoint"}]})";
        const ReadScene read = readScene(bare);
        QCOMPARE(read.errors.size(), std::size_t(2));
        QCOMPARE(read.errors[0].pointer, std::string("/model/coordinates"));
        QCOMPARE(read.errors[1].pointer, std::string("/model/lagrangian"));
    }
    void aCyclicCoordinateIsAColumn() {
        const std::string text = R"({"extremal": 1,
          "model": {"type": "lagrangian", "coordinates": ["r", "phi"],
                    "lagrangian": "(r_t^2 + r^2*phi_t^2)/2 + 1/r"},
          "initial": {"q": [1, 0], "v": [0, 1.1]}, "time": {"end": 5},
          "schemes": [{"label": "a", "step": 0.05, "scheme": "galerkin-gauss-2"}], "observe": ["momentum"]})";
        const Comparison result = run(readScene(text).scene);
        const Trajectory& t = result.schemes.at(0)->trajectory;
        const auto momentum = t["momentum.phi"];
        QVERIFY(momentum.size() > 50);
        QCOMPARE(momentum[0], 1.1);
        QVERIFY(result.schemes.at(0)->summary.maxMomentumError < 1e-14);  // measured: 6.7e-16
    }
    void energyOfAForcedSystemIsThatOfItsTime() {
        // L = x_t^2/2 + x cos t: x = 1 - cos t, H = x_t^2/2 - x cos t.
        const std::string text = R"~({"extremal": 1,
          "model": {"type": "lagrangian", "coordinates": ["x"], "lagrangian": "x_t^2/2 + x*cos(t)"},
          "initial": {"q": [0]}, "time": {"end": 3},
          "schemes": [{"label": "a", "step": 0.1, "scheme": "galerkin-gauss-6"},
                      {"label": "b", "step": 0.1, "baseline": "rk4"},
                      {"label": "c", "step": 0.01, "baseline": "stormer-verlet"},
                      {"label": "d", "tolerance": 1e-12, "baseline": "dopri5"}], "observe": ["energy"]})~";
        const Comparison result = run(readScene(text).scene);
        const double tolerance[] = {1e-13, 1e-5, 1e-4, 1e-10};  // measured: 2.2e-15, 2.1e-7, 1.7e-5, 2.1e-13
        for (std::size_t s = 0; s < 4; ++s) {
            const Trajectory& trajectory = result.schemes[s]->trajectory;
            const auto time = trajectory["t"], x = trajectory["q.x"], energy = trajectory["energy"];
            double worst = 0;
            for (std::size_t i = 0; i < time.size(); ++i) {
                const double t = time[i],
                             expected = std::sin(t) * std::sin(t) / 2 - (1 - std::cos(t)) * std::cos(t);
                worst = std::max({worst, std::abs(x[i] - 1 + std::cos(t)), std::abs(energy[i] - expected)});
            }
            qInfo("%s: %.2e", result.schemes[s]->summary.label.c_str(), worst);
            QVERIFY(worst < tolerance[s]);
        }
    }
};

EXTREMAL_TEST(TypedSceneTest)
}  // namespace extremal::typed_scene_test

#include "typed_scene_test.moc"
