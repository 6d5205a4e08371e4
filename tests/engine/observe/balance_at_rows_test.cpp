// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over steps at rows that are not nodes: rows inside a step add nothing, the last row adds nothing
/// again, and an event that stops the run counts the part of the step that was taken.
#include <QTest>

#include <cmath>
#include <string>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::balance_at_rows_test {
namespace {

/// Kepler's motion with a drag: forces work, and the angular momentum falls.
Comparison runWith(const std::string& keys) {
    const ReadScene read = readScene(
        R"json({"extremal":1,"model":{"type":"lagrangian","coordinates":["x","y"],
            "lagrangian":"(x_t^2+y_t^2)/2+1/sqrt(x^2+y^2)","forces":{
    "x" : "-x_t/50", "y" : "-y_t/50"}},
            "initial":{"q":[1,0],"v":[0,1.1]},"schemes":[{"scheme":"galerkin-gauss-3","step":0.1}],
            "observe":["balance","momentum-balance"],"time":{"end":10})json" +
        keys + "}");
    if (!read.errors.empty()) qFatal("%s %s", read.errors[0].pointer.c_str(), read.errors[0].message.c_str());
    return run(read.scene);
}
std::vector<double> columnOf(const Comparison& c, const std::string& name) {
    return c.schemes.at(0)->trajectory.find(name)->values;
}

}  // namespace

class BalanceAtRowsTest : public QObject {
    Q_OBJECT
private slots:
    void rowsInsideStepsAddNothing() {
        const Comparison nodes = runWith(""), dense = runWith(R"(,"output":{"every":0.025,"dense":true})");
        const auto work = columnOf(nodes, "work"), among = columnOf(dense, "work"), t = columnOf(dense, "t");
        QVERIFY(among.size() > 4 * work.size() - 8);
        for (const char* column : {"work", "balance", "momentum_balance"}) {
            const auto all = columnOf(nodes, column), inside = columnOf(dense, column);
            int known = 0;
            for (std::size_t i = 0; i < inside.size(); ++i) {
                const double node = t[i] / 0.1;
                const bool isNode = std::abs(node - std::round(node)) < 1e-9;
                QVERIFY2(isNode == std::isfinite(inside[i]), column);
                if (!isNode) continue;
                ++known;
                QCOMPARE(inside[i], all[static_cast<std::size_t>(std::lround(node))]);
            }
            QCOMPARE(known, 101);
        }
    }
    /// Rows at every 7th node: the last node is a row besides.
    void theLastRowAddsNothingAgain() {
        const auto all = columnOf(runWith(""), "work"),
                   few = columnOf(runWith(R"(,"output":{"every":0.7})"), "work");
        QVERIFY(few.size() < 20);
        QCOMPARE(few.back(), all.back());
    }
    void aStopCountsThePartOfItsStep() {
        const Comparison c =
            runWith(R"(,"events":[{"expression":"x_t","action":"stop"}],"output":{"every":0.7})");
        const auto t = columnOf(c, "t"), momentum = columnOf(c, "momentum_balance"),
                   balance = columnOf(c, "balance");
        const double place = t.back() / 0.1;
        QVERIFY(t.back() < 9 && std::abs(place - std::round(place)) > 1e-3);
        QVERIFY2(momentum.back() < 1e-14, qPrintable(QString::number(momentum.back())));
        QVERIFY2(std::abs(balance.back()) < 1e-6, qPrintable(QString::number(balance.back())));
    }
};

EXTREMAL_TEST(BalanceAtRowsTest)
}  // namespace extremal::balance_at_rows_test

#include "balance_at_rows_test.moc"
