// SPDX-License-Identifier: GPL-3.0-or-later
/// The handbook's page of orders: its rows are those of the program, each measured order is the claimed one,
/// and some rows, measured again, are what the page says.
#include <QFile>
#include <QTest>

#include <algorithm>
#include <map>

#include "tests/tools/order_table.hpp"
#include "tests/tools/test.hpp"

namespace extremal::tools::orders_test {
namespace {

/// The text of every row, by section and rule.
std::map<QString, QStringList> rowsOfPage() {
    QFile file(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/orders.md"));
    std::map<QString, QStringList> rows;
    if (!file.open(QIODevice::ReadOnly)) return rows;
    QString section;
    for (const QString& line : QString::fromUtf8(file.readAll()).split('\n')) {
        if (line.startsWith("## ")) section = line.mid(3);
        if (!line.startsWith("| `")) continue;
        QStringList cells = line.mid(2, line.size() - 4).split(" | ");
        for (QString& cell : cells) cell = cell.trimmed();
        rows[section + ": " + cells[0]] = cells;
    }
    return rows;
}

QString keyOf(const OrderRow& row) { return QString::fromStdString(row.spaceText + ": " + row.ruleText); }

}  // namespace

class OrdersTest : public QObject {
    Q_OBJECT
    const std::map<QString, QStringList> page_ = rowsOfPage();
    const std::vector<OrderRow> rows_ = pairsOfTable();

private slots:
    void thePageHasTheRowsOfTheProgram() {
        QCOMPARE(page_.size(), rows_.size());
        for (const OrderRow& row : rows_) QVERIFY2(page_.count(keyOf(row)), qPrintable(keyOf(row)));
    }
    void everyMeasuredOrderIsTheClaimedOne() {
        for (const OrderRow& row : rows_) {
            const QStringList& cells = page_.at(keyOf(row));
            const int claimed = row.known.claims.order;
            QVERIFY2(row.known.refusal.empty() && cells[1].toInt() == claimed, qPrintable(keyOf(row)));
            for (int i = 2; i <= 5; ++i)  // measured: within 0.03
                QVERIFY2(std::abs(cells[i].toDouble() - claimed) < 0.05, qPrintable(keyOf(row)));
            QCOMPARE(cells[6].toInt(), row.known.curveOrder);
            QVERIFY2(std::abs(cells[7].toDouble() - row.known.curveOrder) < 0.1,
                     qPrintable(keyOf(row)));  // within 0.06
            QCOMPARE(cells[9], row.known.claims.isSymmetric ? "yes" : "no");
        }
    }
    void someRowsMeasuredAgainAreWhatThePageSays_data() {
        QTest::addColumn<int>("index");
        // Of every kind one, those whose orders the rule's own order does not give among them.
        for (const char* name :
             {"Polynomials of degree 1: `radau` 1", "Polynomials of degree 2: `gauss` 2",
              "Polynomials of degree 2: `midpoint`, panels: 2", "Polynomials of degree 3: `lobatto` 3",
              "Polynomials of degree 4: `clenshaw-curtis` 4", "Polynomials of degree 5: `clenshaw-curtis` 6",
              "Polynomials of degree 6: `gauss` 6", "Splines of degree 3 with 2 cells: `gauss` 3"}) {
            const auto found =
                std::find_if(rows_.begin(), rows_.end(), [&](const OrderRow& r) { return keyOf(r) == name; });
            QVERIFY2(found != rows_.end(), name);
            QTest::newRow(name) << static_cast<int>(found - rows_.begin());
        }
    }
    void someRowsMeasuredAgainAreWhatThePageSays() {
        QFETCH(int, index);
        OrderRow row = rows_[static_cast<std::size_t>(index)];
        measure(row, orderBudget);
        const QStringList& cells = page_.at(keyOf(row));
        const std::vector<std::pair<int, double>> measured = {{2, row.kepler.q},      {3, row.kepler.p},
                                                              {4, row.pendulum.q},    {5, row.pendulum.p},
                                                              {7, row.kepler.curveQ}, {8, row.kepler.curveP}};
        for (const auto& [cell, value] : measured) {
            qInfo("%s: page %s, now %.3f", qPrintable(keyOf(row)), qPrintable(cells[cell]), value);
            QVERIFY(std::abs(cells[cell].toDouble() - value) < 0.011);  // two digits behind the point
        }
    }
    void aBrokenWeightIsSeen() {
        // Teeth: half a panel more weight on one side costs the order, and the fit notices.
        const Settings space{"polynomial", {{"degree", 2.0}, {"basis", "lobatto"}}, {}};
        const Orders two = measureOrders(space, {"gauss", {{"nodes", 2.0}}, {}}, Motion::kepler, 2000);
        const Orders lobatto = measureOrders(space, {"lobatto", {{"nodes", 2.0}}, {}}, Motion::kepler, 2000);
        QVERIFY(std::abs(two.q - 4) < 0.1);
        QVERIFY(std::abs(lobatto.q - 4) > 1);
    }
};

EXTREMAL_TEST(OrdersTest)
}  // namespace extremal::tools::orders_test

#include "orders_test.moc"
