// SPDX-License-Identifier: GPL-3.0-or-later
/// The slope sin u of the sine-Gordon potential has the bits of lanes_trigonometry.hpp, however large its
/// neighbours are.
#include <QTest>

#include <cmath>
#include <cstring>
#include <vector>

#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/model/field/potential.hpp"
#include "tests/tools/test.hpp"

namespace extremal::sine_gordon_test {

class SineGordonTest : public QObject {
    Q_OBJECT
private slots:
    /// At rest but for a pulse, at rest, and large everywhere; with places left over beside the packs.
    void slopesHaveOneValueEverywhere() {
        const FieldPotential potential("sine-gordon", 1, "");
        for (const double height : {7.0, 0.7, 0.0})
            for (const double ground : {0.0, 20.0})
                for (const std::size_t n : {5, 32, 100, 224}) {
                    std::vector<double> u(n), slope(n);
                    for (std::size_t i = 0; i < n; ++i) {
                        const double x = static_cast<double>(i) - 45;
                        u[i] = ground + height * std::exp(-x * x / 20) - 0.001 * x;
                    }
                    potential.evaluate(u.data(), n, nullptr, slope.data(), nullptr);
                    for (std::size_t i = 0; i < n; ++i) {
                        const double alone = sin(Lanes(u[i])).lane[0];
                        QVERIFY(std::memcmp(&slope[i], &alone, sizeof(double)) == 0);
                    }
                }
    }
    /// One large value in the middle of small ones, where the ends do not tell.
    void aLonelyPeakIsSeen() {
        const FieldPotential potential("sine-gordon", 1, "");
        for (std::size_t peak = 0; peak < 64; ++peak) {
            std::vector<double> u(64, 0.1), slope(64);
            u[peak] = 5;
            potential.evaluate(u.data(), u.size(), nullptr, slope.data(), nullptr);
            QCOMPARE(slope[peak], sin(Lanes(5.0)).lane[0]);
        }
    }
};

EXTREMAL_TEST(SineGordonTest)

}  // namespace extremal::sine_gordon_test

#include "sine_gordon_test.moc"
