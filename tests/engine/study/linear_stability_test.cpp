/// Limits of linear stability are those of theory, and of what schemes claim.
#include <QTest>

#include <cmath>
#include <numbers>

#include "engine/scene/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/linear_study.hpp"
#include "tests/tools/test.hpp"

namespace extremal::linear_stability_test {
namespace {

Scene sceneWith(const std::string& schemes, const std::string& model = R"("pendulum"},"initial":{"q":[1]})") {
    const ReadScene read = readScene(R"({"extremal":1,"model":{"type":)" + model +
                                     R"(,"time":{"end":1},"reference":"none","schemes":[)" + schemes + "]}");
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return read.scene;
}

const std::string wave =
    R"json("schrodinger","modes":32,"potential":"cos(x)"},"initial":{"psi":{"packet":"gaussian","centre":3,
       "width":0.5,"wave_number":0}})json";

}  // namespace

class LinearStabilityTest : public QObject {
    Q_OBJECT
private slots:
    void limitsAreThoseOfTheory_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("limit");
        const double none = HUGE_VAL;
        QTest::newRow("Störmer-Verlet") << R"("baseline":"stormer-verlet")" << 2.0;
        QTest::newRow("symplectic Euler") << R"("baseline":"symplectic-euler")" << 2.0;
        QTest::newRow("RK4") << R"("baseline":"rk4")" << 2 * std::numbers::sqrt2;
        QTest::newRow("midpoint") << R"("scheme":"midpoint")" << none;
        QTest::newRow("Gauss 3") << R"("scheme":"galerkin-gauss-3")" << none;
        // |tr/2| = |12 - 5 z^2 + z^4/4| / (12 + z^2) at 1 (Lobatto IIIA-IIIB of order 4).
        QTest::newRow("Lobatto 2") << R"("scheme":"galerkin-lobatto-2")" << 2 * std::numbers::sqrt2;
    }
    void limitsAreThoseOfTheory() {
        QFETCH(QString, scheme);
        QFETCH(double, limit);
        const LinearStability r =
            linearStability(sceneWith("{\"step\":0.01," + scheme.toStdString() + "}"), 0, {});
        QCOMPARE(r.reason, "");
        qInfo("%.12g", r.limit());
        QCOMPARE(r.hasLimit, std::isfinite(limit));
        if (r.hasLimit) QVERIFY(std::abs(r.limit() / limit - 1) < 1e-6);
    }
    void thePrintedWaveSchemeIsStableToTheRootOfThree() {
        const LinearStability r =
            linearStability(sceneWith(R"({"step":0.001,"scheme":"schrodinger-three-level"})", wave), 0, {});
        QCOMPARE(r.reason, "");
        qInfo("%.12g", r.limit());
        QVERIFY(std::abs(r.limit() - std::numbers::sqrt3) < 1e-5);
    }
    void gaussStepsOfWavesHaveNoLimit() {
        const LinearStability r =
            linearStability(sceneWith(R"({"step":0.001,"scheme":"schrodinger-gauss-2"})", wave), 0, {});
        QCOMPARE(r.reason, "");
        QVERIFY(!r.hasLimit);
    }
    void phaseErrorsAreThoseOfTheScheme() {
        const LinearStability r = linearStability(sceneWith(R"({"step":0.01,"scheme":"midpoint"})"), 0, {});
        for (const LinearStability::Point& p : r.points) {
            QVERIFY(std::abs(p.amplification - 1) < 1e-12);
            // tan(phase/2) = z/2
            QVERIFY(std::abs(p.phaseError - (2 * std::atan(p.z / 2) - p.z) / p.z) < 1e-12);
            if (p.z > 3) break;
        }
        const LinearStability rk = linearStability(sceneWith(R"({"step":0.01,"baseline":"rk4"})"), 0, {});
        const double z = rk.points[9].z, square = z * z;  // |R(iz)|^2 = 1 - z^6/72 + z^8/576
        QVERIFY(std::abs(rk.points[9].amplification - std::sqrt(1 - square * square * square / 72 +
                                                                square * square * square * square / 576)) <
                1e-13);
    }
    void whatHasNoLinearStepSaysWhy() {
        const auto reasonOf = [](const std::string& scheme) {
            return linearStability(sceneWith(scheme), 0, {}).reason;
        };
        QVERIFY(!reasonOf(R"({"tolerance":1e-6,"baseline":"dopri5"})").empty());
        QVERIFY(!reasonOf(R"({"step":0.1,"scheme":"sem-1"})").empty());
    }
    void aStudyIsReadBackFromItsLines() {
        const ReadScene read = readScene(
            toValue(sceneWith(R"({"step":0.01,"baseline":"rk4"},{"tolerance":1e-6,"baseline":"dopri5"})")));
        LinearStudy study(*read.resolved, {}), again(*read.resolved, {});
        runLines(study, [&](const std::string& line) { QVERIFY(takeLine(line, again)); }, {});
        QVERIFY(study.isComplete() && again.isComplete());
        const StudyEntry& entry = *findStudy("linear-stability");
        const auto texts = [&](const LinearStudy& s) {
            std::string text;
            for (const StudyTable& table : tablesOf(entry, s)) text += csvText(table);
            return text;
        };
        QCOMPARE(texts(again), texts(study));
        QVERIFY(texts(study).find("rk4") != std::string::npos);
    }
};

EXTREMAL_TEST(LinearStabilityTest)
}  // namespace extremal::linear_stability_test
#include "linear_stability_test.moc"
