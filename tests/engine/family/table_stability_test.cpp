// SPDX-License-Identifier: GPL-3.0-or-later
/// The linear stability of tables: rules of many nodes are condensed to the unknowns of the step.
#include <QTest>

#include <cmath>

#include "engine/core/work.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/stability_check.hpp"
#include "tests/tools/test.hpp"

namespace extremal::table_stability_test {
namespace {

/// Degree 3 with Gauss nodes; as exact for the quadratic action of an oscillator from four nodes on.
Discretization withNodes(int nodes) {
    Discretization d = *namedScheme("galerkin-gauss-3");
    for (auto& [key, value] : d.quadrature.keys)
        if (key == "nodes") value = Value(static_cast<double>(nodes));
    return d;
}

}  // namespace

class TableStabilityTest : public QObject {
    Q_OBJECT
private slots:
    void doesNotDependOnTheNumberOfNodes() {
        const auto few = tableStability(withNodes(5)), many = tableStability(withNodes(160));
        QVERIFY(!few->intervals.empty());
        QCOMPARE(many->intervals.size(), few->intervals.size());
        for (std::size_t i = 0; i < few->intervals.size(); ++i)
            QVERIFY(std::abs(many->intervals[i].low / few->intervals[i].low - 1) < 1e-10);
    }
    void costsLittleForManyNodes() {
        const work::Account account(1e12);
        tableStability(withNodes(700));
        QVERIFY2(account.spent() < 3e9, qPrintable(QString::number(account.spent())));
    }
};

EXTREMAL_TEST(TableStabilityTest)
}  // namespace extremal::table_stability_test
#include "table_stability_test.moc"
