// SPDX-License-Identifier: GPL-3.0-or-later
/// Elliptic integrals of arguments that are not numbers do not compute for seconds.
#include "engine/core/algebra/carlson.hpp"

#include <QTest>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/tools/test.hpp"

namespace extremal::carlson_test {

class CarlsonTest : public QObject {
    Q_OBJECT
private slots:
    void valuesAreThoseOfTheIntegrals() {
        QVERIFY(std::abs(carlsonRf(1, 1, 1) - 1) < 1e-15);
        QVERIFY(std::abs(carlsonRf(0, 1, 1) - std::numbers::pi / 2) < 1e-15);
        QVERIFY(std::abs(carlsonRj(4, 4, 4, 4) - 0.125) < 1e-15);
    }
    /// Some thousand of them: one took four seconds.
    void theRestIsNotANumber() {
        const double nan = std::numeric_limits<double>::quiet_NaN(),
                     infinity = std::numeric_limits<double>::infinity();
        for (const double bad : {nan, infinity, -infinity})
            for (int i = 0; i < 1000; ++i) {
                QVERIFY(std::isnan(carlsonRf(bad, 0.5, 1)) && std::isnan(carlsonRf(0.5, 1, bad)));
                QVERIFY(std::isnan(carlsonRj(bad, 0.5, 1, 0.3)) && std::isnan(carlsonRj(0.5, 0.5, 1, bad)));
            }
    }
};

EXTREMAL_TEST(CarlsonTest)
}  // namespace extremal::carlson_test
#include "carlson_test.moc"
