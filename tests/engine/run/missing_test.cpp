// SPDX-License-Identifier: GPL-3.0-or-later
/// What was asked for and could not be had is said, with the reason; and what does not depend on rows.
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>

#include "engine/run/files/export.hpp"
#include "engine/run/missing.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::missing_test {
namespace {

Comparison resultsOf(const QByteArray& text) {
    const ReadScene read = readScene(text.toStdString());
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return run(read.scene);
}

QByteArray scene(const char* model, const char* initial, const char* end, const char* schemes,
                 const char* further) {
    return QByteArray("{\"extremal\":1,\"model\":") + model + ",\"initial\":" + initial +
           ",\"time\":{\"end\":" + end + "},\"schemes\":" + schemes + further + "}";
}

const char *const oscillator = R"({"type":"harmonic-oscillator"})", *const kepler = R"({"type":"kepler"})",
                  *const orbit = R"({"q":[0.4,0],"p":[0,2]})";
/// x grows beyond all bounds at t = 0.93.
const char* const runaway = R"({"type":"lagrangian","coordinates":["x"],"lagrangian":"x_t^2/2+x^4"})";

/// The reasons by observable, of the scheme.
std::string reason(const Comparison& comparison, std::size_t scheme, const char* observable) {
    for (const Missing& m : missingFrom(comparison, *comparison.schemes[scheme]))
        if (m.observable == observable) return m.reason;
    return {};
}

}  // namespace

class MissingTest : public QObject {
    Q_OBJECT
private slots:
    void aReferenceThatEndsEarlySaysSo() {
        const Comparison c =
            resultsOf(scene(runaway, R"({"q":[1]})", "3", R"([{"scheme":"midpoint","step":0.1}])",
                            R"(,"observe":["error","energy"])"));
        QVERIFY(!c.reference.problems.empty());
        const std::string& message = c.reference.problems.front().message;
        QVERIFY2(message.find("ends at t = 0.92") != std::string::npos, message.c_str());
        QCOMPARE(reason(c, 0, "error"), "there is no reference: " + message);
        QCOMPARE(reason(c, 0, "energy"), std::string());
        const Value summary = summaryValue(c);
        QCOMPARE(summary.find("reference")->find("problem")->asString(), message);
        QVERIFY(summary.find("schemes")->asArray()[0].find("missing")->find("error"));
    }
    void ordersSayWhyTheyAreNotMeasured() {
        // At round-off; under error control; by companions; and one that is measured.
        const char* const schemes = R"([{"scheme":"galerkin-gauss-8","step":0.05},
            {"baseline":"dopri5","tolerance":1e-6},{"baseline":"stormer-verlet","step":0.05}])";
        const Comparison c =
            resultsOf(scene(oscillator, R"({"q":[1]})", "10", schemes, R"(,"observe":["error","order"])"));
        QVERIFY(reason(c, 0, "order").find("round-off") != std::string::npos ||
                reason(c, 0, "order").find("reference") != std::string::npos);
        QVERIFY(reason(c, 1, "order").find("with a step") != std::string::npos);
        QCOMPARE(reason(c, 2, "order"), std::string());
        const Comparison companions =
            resultsOf(scene(kepler, orbit, "5", R"([{"scheme":"galerkin-gauss-2","step":0.05}])",
                            R"(,"observe":["error","order"],"reference":"companion")"));
        QVERIFY(reason(companions, 0, "order").find("companions") != std::string::npos);
    }
    void columnsWithoutAValueSaySo() {
        const Comparison c =
            resultsOf(scene(oscillator, R"({"q":[1e200]})", "1", R"([{"baseline":"rk4","step":0.1}])",
                            R"(,"observe":["energy","discrete-energy","error"])"));
        QVERIFY(reason(c, 0, "energy").find("at the start") != std::string::npos);
        QVERIFY(!reason(c, 0, "discrete-energy").empty());
        QCOMPARE(reason(c, 0, "error"), std::string());
    }
    /// The start alone says nothing of a scheme: of no quantity, in no file, and not in studies.
    void aRunWithoutAStepHasMeasuredNothing() {
        // The long step leaves the domain of the root at once, short ones do so later.
        const Comparison c = resultsOf(scene(
            R"~({"type":"lagrangian","coordinates":["x"],"lagrangian":"x_t^2/2+sqrt(1-x)"})~",
            R"({"q":[0.5],"p":[3]})", "1",
            R"([{"label":"none","scheme":"galerkin-gauss-2","step":0.5},{"label":"some","baseline":"rk4","step":0.01}])",
            R"(,"observe":["energy","error","symplecticity","step"],"reference":{"type":"scheme","scheme":{"baseline":"rk4","step":0.001}})"));
        const Summary& none = c.schemes[0]->summary;
        QCOMPARE(none.steps, 0LL);
        for (const double value : {none.maxEnergyError, none.energyDrift, none.maxError, none.finalError})
            QVERIFY(std::isnan(value));
        QVERIFY(!none.extremes.empty());
        for (const Summary::Extreme& extreme : none.extremes) QVERIFY(std::isnan(extreme.value));
        const Value row = summaryValue(c).find("schemes")->asArray()[0];
        for (const char* key : {"max_error", "final_error", "max_energy_error", "energy_drift_per_unit_time"})
            QVERIFY2(row.find(key)->isNull(), key);
        for (const Value::Member& extreme : row.find("extremes")->asObject())
            QVERIFY(extreme.second.isNull());
        for (const char* id : {"energy", "error", "symplecticity", "step"})
            QVERIFY2(reason(c, 0, id).find("no step was taken") != std::string::npos, id);
        QVERIFY(c.schemes[1]->summary.steps > 0 && std::isfinite(c.schemes[1]->summary.maxEnergyError));
    }
    void whatIsThereIsNotMissing() {
        const Comparison c = resultsOf(scene(kepler, orbit, "5", R"([{"scheme":"midpoint","step":0.05},
            {"baseline":"stormer-verlet","step":0.05},{"baseline":"dopri5","tolerance":1e-6}])",
                                             R"(,"observe":["energy","error","momentum","step"])"));
        for (const auto& s : c.schemes) QVERIFY(missingFrom(c, *s).empty());
        QVERIFY(!summaryValue(c).find("schemes")->asArray()[0].find("missing"));
    }
    /// The largest error over some of the nodes says of how many.
    void extremesSayWhatTheyDoNotSee() {
        QTemporaryDir folder;
        QFile file(folder.filePath("known.csv"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write("t,q.x,p.x\n");
        for (int k = 0; k <= 50; ++k) {
            const double t = k * 0.1;
            file.write(QByteArray::number(t, 'g', 17) + "," + QByteArray::number(std::cos(t), 'g', 17) + "," +
                       QByteArray::number(-std::sin(t), 'g', 17) + "\n");
        }
        file.close();
        const QByteArray reference =
            QByteArray(R"(,"observe":["error"],"reference":{"type":"file","path":"PATH"})")
                .replace("PATH", file.fileName().toUtf8());
        const Comparison c =
            resultsOf(scene(oscillator, R"({"q":[1]})", "10", R"([{"baseline":"stormer-verlet","step":0.1}])",
                            reference.constData()));
        const Summary& s = c.schemes[0]->summary;
        QVERIFY(std::isfinite(s.maxError));
        QVERIFY2(s.caution.find("is known at 51 of 101 nodes") != std::string::npos, s.caution.c_str());
    }
    void driftsDoNotDependOnRows() {
        const auto drift = [](const char* output) {
            return resultsOf(
                       scene(kepler, orbit, "50", R"([{"baseline":"rk4","step":0.02}])",
                             (std::string(R"(,"reference":"none","observe":["energy"])") + output).c_str()))
                .schemes[0]
                ->summary.energyDrift;
        };
        const double all = drift(R"(,"output":{"every":0.02})");
        QVERIFY(std::abs(all) > 1e-8);
        QCOMPARE(drift(R"(,"output":{"every":7})"), all);
        QCOMPARE(drift(""), all);
    }
};

EXTREMAL_TEST(MissingTest)
}  // namespace extremal::missing_test
#include "missing_test.moc"
