// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the powers of a map of the plane stop being bounded, of maps whose edges are known.
#include <QTest>

#include <cmath>

#include "engine/integrator/stability.hpp"
#include "tests/tools/test.hpp"

namespace extremal::bounded_powers_test {

class BoundedPowersTest : public QObject {
    Q_OBJECT
private slots:
    /// The half trace of the leapfrog scheme is 1 - z^2/2, that of two half steps in one the same at 2 z, of
    /// which only round-off is forgiven.
    void edgesAreThoseOfTheTrace() {
        for (const double edge : {2.0, 1.0, 0.2}) {
            const auto isStable = [edge](double z) {
                return hasBoundedPowers(1 - 2 * (z / edge) * (z / edge), z);
            };
            const StabilityEdge found = firstInstability(isStable);
            QVERIFY2(std::abs(found.low - edge) < 1e-8 * edge,
                     qPrintable(QString::number(found.low, 'g', 17)));
            QVERIFY(isStable(found.low) && !isStable(found.high));
            QCOMPARE(found.limit(), found.low);
        }
    }
    void roundOffIsForgivenAndNothingElse() {
        for (const double z : {0.1, 1.0, 30.0}) {
            const double roundOff = 1e-12 * (1 + z * z);
            for (const double side : {-1.0, 1.0}) {
                QVERIFY(hasBoundedPowers(side, z));
                QVERIFY(hasBoundedPowers(side * (1 + roundOff), z));
                QVERIFY(!hasBoundedPowers(side * (1 + 1e4 * roundOff), z));
            }
        }
        QVERIFY(!hasBoundedPowers(std::nan(""), 1));
    }
    void whatIsNeverOrAlwaysStableHasNoEdge() {
        QCOMPARE(firstInstability([](double) { return false; }).limit(), 0.0);
        QVERIFY(std::isinf(firstInstability([](double) { return true; }).limit()));
    }
};

EXTREMAL_TEST(BoundedPowersTest)

}  // namespace extremal::bounded_powers_test

#include "bounded_powers_test.moc"
