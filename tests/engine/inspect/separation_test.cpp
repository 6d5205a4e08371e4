// SPDX-License-Identifier: GPL-3.0-or-later
/// Two copies of a motion: their distance grows at the rate that is known.
#include <QTest>

#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/inspect/separation.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::separation_test {

class SeparationTest : public QObject {
    Q_OBJECT

    static Scene sceneOf(const std::string& parts) {
        const ReadScene read = readScene(R"({"extremal":1,)" + parts + "}");
        if (!read.errors.empty()) throw InvalidScene(read.errors);
        return read.scene;
    }

private slots:
    /// Near the top of a pendulum a distance grows as exp(sqrt(g/l) t).
    void itGrowsAsTheUnstablePointSays() {
        const Scene scene = sceneOf(
            R"("model":{"type":"pendulum","g":4,"l":1,"m":1},"initial":{"q":["pi"],"p":[0]},"time":{"end":5},)"
            R"("schemes":[{"label":"G","step":0.05,"scheme":"galerkin-gauss-3"}])");
        const Separation s = separationOf(scene, 0, 1e-8);
        QVERIFY2(std::fabs(s.rate - 2) < 0.1, qPrintable(QString::number(s.rate)));
        QCOMPARE(s.pair.schemes.size(), std::size_t{2});
        const Series& line = s.distance.series().front();
        QVERIFY(std::fabs(line.y.front() - 1e-8) < 1e-14);
        QVERIFY(line.y.back() > 1e-8 * std::exp(2 * 4.5));
        QVERIFY(s.pair.schemes[0]->style != s.pair.schemes[1]->style);
    }
    void itStaysOnARegularMotion() {
        const Scene scene =
            sceneOf(R"("model":{"type":"harmonic-oscillator"},"initial":{"q":[1],"p":[0]},"time":{"end":20},)"
                    R"("schemes":[{"label":"a","step":0.1,"scheme":"midpoint"}])");
        const Separation s = separationOf(scene, 0, 1e-6);
        QVERIFY(std::fabs(s.rate) < 0.02);
    }
    void whatHasNoCopiesSaysSo() {
        const Scene waves = readScene(findPreset("coherent-state")->json).scene;
        QVERIFY_THROWS_EXCEPTION(InvalidScene, separationOf(waves, 0, 1e-6));
        const Scene adaptive = sceneOf(
            R"("model":{"type":"pendulum"},"time":{"end":1},"schemes":[{"label":"a","tolerance":1e-6,"baseline":"dopri5"}])");
        QVERIFY_THROWS_EXCEPTION(InvalidScene, separationOf(adaptive, 0, 1e-6));
    }
};

EXTREMAL_TEST(SeparationTest)

}  // namespace extremal::separation_test

#include "separation_test.moc"
