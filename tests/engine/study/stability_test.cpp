// SPDX-License-Identifier: GPL-3.0-or-later
/// Stability over numbers of a scene: classes of known cases, limits that theory gives, and shards that make
/// the whole.
#include <QTest>

#include <cmath>

#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/stability/stability_study.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::stability_test {
namespace {

ResolvedScene oscillator(const std::string& schemes, double end = 2000) {
    const ReadScene read =
        readScene(std::string(R"({"extremal":1,"model":{"type":"harmonic-oscillator","m":1,"k":1},
        "initial":{"q":[1],"p":[0]},"time":{"end":)") +
                  std::to_string(end) + R"(},"schemes":[)" + schemes + "]}");
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}
const std::string three = R"({"label":"SV","step":0.1,"baseline":"stormer-verlet"},
    {"label":"midpoint","step":0.1,"scheme":"midpoint"},{"label":"RK4","step":0.1,"baseline":"rk4"})";

StabilityOptions along(const std::string& x) {
    StabilityOptions options;
    options.x = parseAxis(x, "--x");
    return options;
}

}  // namespace

class StabilityTest : public QObject {
    Q_OBJECT
private slots:
    void axesReadAsTheyAreWritten() {
        const VariedNumber a = parseAxis("/model/k=1:1e4:5:log", "--x");
        QCOMPARE(textOf(a), "/model/k=1:10000:5:log");
        QVERIFY(std::abs(a.values()[1] - 10) < 1e-12 && a.values().back() == 1e4);
        QCOMPARE(parseAxis("/time/end=1:2:3", "--y").values()[1], 1.5);
        for (const char* bad :
             {"", "/model/k", "/model/k=1:2", "/model/k=1:2:x", "/model/k=2:1:3", "/model/k=1:2:1",
              "/model/k=0:2:3:log", "/model/k=1:2:3:lin", "/model/k=1:2:3:log:4"})
            QVERIFY2(pointerOf([&] { (void)parseAxis(bad, "--x"); }) == "--x", bad);
        QCOMPARE(pointerOf([] { StabilityStudy(oscillator(three), along("/model/kk=1:2:3")); }), "--x");
    }
    void classesAreThoseOfKnownCases() {
        const Scene scene = oscillator(three).scene;
        const auto classOf = [&](std::size_t scheme, double step) {
            return runStability(scene, scheme, {{"/schemes/*/step", step}}, {}).kind;
        };
        QCOMPARE(classOf(0, 1.9), StabilityClass::stable);
        QCOMPARE(classOf(0, 2.1), StabilityClass::blowUp);
        QCOMPARE(classOf(1, 50), StabilityClass::stable);
        QCOMPARE(classOf(2, 0.05), StabilityClass::drifting);
        QCOMPARE(classOf(2, 3), StabilityClass::blowUp);
        const StabilityResult blown = runStability(scene, 0, {{"/schemes/*/step", 2.1}}, {});
        // The larger root of z + 1/z = 2 - h^2 in magnitude gives the growth.
        const double sum = 2.1 * 2.1 - 2, root = (sum + std::sqrt(sum * sum - 4)) / 2;
        qInfo("growth %.4f, of the root %.4f", blown.growth, std::log(root) / 2.1);
        QVERIFY(std::abs(blown.growth / (std::log(root) / 2.1) - 1) < 0.1);  // 0.05 off, by the start
        QCOMPARE(blown.cause, Outcome::lost);
        const StabilityResult none = runStability(scene, 0, {{"/schemes/*/step", -1}}, {});
        QCOMPARE(none.kind, StabilityClass::refused);
        QVERIFY(!none.reason.empty());
    }
    void limitsAreThoseOfTheory() {
        const Scene scene = oscillator(three, 100000).scene;
        const VariedNumber steps = parseAxis("/schemes/*/step=1:3:5", "--x");
        const StabilityLimit verlet = findLimit(scene, 0, steps, {}, {});
        const StabilityLimit rk4 = findLimit(scene, 2, steps, {}, {});
        qInfo("Verlet %.5f, RK4 %.5f", verlet.limit, rk4.limit);
        QVERIFY(std::abs(verlet.limit - 2) < 2e-4);                // 2.00003
        QVERIFY(std::abs(rk4.limit - 2 * std::sqrt(2.0)) < 3e-4);  // 2.8285
        QVERIFY(verlet.high - verlet.low < 1e-4 * verlet.high);
        QVERIFY(std::isnan(findLimit(scene, 1, steps, {}, {}).limit));  // the midpoint rule has none
        // h w = 2 along the spring constant as well, with the step as the other number.
        const StabilityLimit stiff =
            findLimit(scene, 0, parseAxis("/model/k=1:1000:4:log", "--x"), {{"/schemes/*/step", 0.1}}, {});
        QVERIFY(std::abs(stiff.limit - 400) < 0.1);
    }
    void shardsMakeTheWhole() {
        StabilityOptions options = along("/schemes/*/step=0.5:3:4");
        options.y = parseAxis("/model/k=0.5:2:2", "--y");
        options.findsLimits = true;
        StabilityStudy whole(oscillator(three, 200), options);
        runLines(whole, [](const std::string&) {}, {});
        QVERIFY(whole.isComplete());
        QCOMPARE(whole.rows().size(), 24UL);
        QCOMPARE(whole.limits().size(), 6UL);
        StabilityStudy merged(oscillator(three, 200), options);
        for (int i = 1; i <= 2; ++i) {
            options.shard = {i, 2};
            StabilityStudy part(oscillator(three, 200), options);
            runLines(part, [&](const std::string& line) { QVERIFY(takeLine(line, merged)); }, {});
            QVERIFY(!part.isComplete());
        }
        QVERIFY(merged.isComplete());
        const StudyEntry& study = *findStudy("stability");
        for (std::size_t i = 0; i < 2; ++i)
            QCOMPARE(csvText(tablesOf(study, merged)[i]), csvText(tablesOf(study, whole)[i]));
    }
};

EXTREMAL_TEST(StabilityTest)
}  // namespace extremal::stability_test
#include "stability_test.moc"
