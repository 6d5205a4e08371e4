// SPDX-License-Identifier: GPL-3.0-or-later
/// Whole steps are counted although quotients of decimal fractions are rounded.
#include <QTest>

#include "engine/scene/bind.hpp"
#include "tests/tools/test.hpp"

namespace extremal::bind_test {

class BindTest : public QObject {
    Q_OBJECT
private slots:
    void wholeStepsAreCounted() {
        QVERIFY(0.3 / 0.1 < 3);  // why there is a slack
        QCOMPARE(stepCount(0, 0.3, 0.1), 3);
        QCOMPARE(stepCount(0, 0.7, 0.1), 7);
        QCOMPARE(stepCount(0, 1, 0.1), 10);
        QCOMPARE(stepCount(-1, 2, 0.5), 6);
    }
    void aPartOfAStepIsNone() {
        QCOMPARE(stepCount(0, 0.29, 0.1), 2);
        QCOMPARE(stepCount(0, 1 - 1e-6, 1), 0);
    }
};

EXTREMAL_TEST(BindTest)

}  // namespace extremal::bind_test

#include "bind_test.moc"
