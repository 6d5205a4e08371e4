// SPDX-License-Identifier: GPL-3.0-or-later
/// A hundred thousand steps of wave functions, the scene norm-long: what is kept, a solve and in all, and
/// that a solver which is not exact would be seen.
#include <QTest>

#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::wave_long_test {
namespace {

constexpr double normEach = 2e-16, energyInAll = 1e-10;

struct Kept {
    double normEach = 0;  ///< of the largest change of the norm, by the number of solves
    double energy = 0;    ///< relative
};
/// `each` says how many solves a step has.
Kept keptBy(const SchemeResult& scheme, int each) {
    const Summary& s = scheme.summary;
    return {s.maxNormError / (each * static_cast<double>(s.steps)),
            s.maxEnergyError / std::abs(scheme.trajectory["energy"][0])};
}

}  // namespace

class WaveLongTest : public QObject {
    Q_OBJECT
private slots:
    void normAndEnergyAreKept() {
        const Comparison comparison = run(readScene(loadSceneText("preset:norm-long")).scene);
        QCOMPARE(comparison.schemes.size(), std::size_t(4));
        const int solves[] = {4, 14, 1, 1};  // of split-step methods: kicks
        for (std::size_t i = 0; i < 4; ++i) {
            const SchemeResult& scheme = *comparison.schemes[i];
            const Kept kept = keptBy(scheme, solves[i]);
            qInfo("%s: norm %.2g a solve, energy %.2g", scheme.spec.label.c_str(), kept.normEach,
                  kept.energy);
            QCOMPARE(scheme.summary.status, RunStatus::done);
            QCOMPARE(scheme.summary.steps, 100000LL);
            QCOMPARE(scheme.trajectory.nodes.back(), 1e5);
            QVERIFY(kept.normEach < normEach);  // measured 3.8e-17, 4.9e-17, 4.9e-17, 7.8e-17
            // Strang keeps an energy of its own, and that of the problem within the error of the splitting.
            if (scheme.spec.label == "Strang")
                QVERIFY(kept.energy > 1e-5 && kept.energy < 1e-3);  // 6.1e-4
            else
                QVERIFY(kept.energy < energyInAll);  // 1.4e-12, 8.0e-13, 7.6e-13
        }
    }
    /// The same run, shorter, with a solver that stops at 1e-8.
    void aSolverThatStopsEarlyIsSeen() {
        Scene scene = readScene(loadSceneText("preset:norm-long")).scene;
        scene.end.value = 10;
        scene.schemes.resize(1);
        const Kept exact = keptBy(*run(scene).schemes.at(0), 4);
        scene.schemes[0].solver = {"krylov", {{"tolerance", 1e-8}}, {}};
        const Kept kept = keptBy(*run(scene).schemes.at(0), 4);
        qInfo("norm %.2g a solve, energy %.2g", kept.normEach, kept.energy);
        QVERIFY(exact.normEach < normEach && exact.energy < energyInAll);
        QVERIFY(kept.normEach > 10 * normEach && kept.energy > energyInAll);
    }
};

EXTREMAL_TEST(WaveLongTest)
}  // namespace extremal::laws::wave_long_test

#include "wave_long_test.moc"
