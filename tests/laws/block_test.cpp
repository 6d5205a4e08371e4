// SPDX-License-Identifier: GPL-3.0-or-later
/// Taking many steps in one call is the same as taking them one by one, to the last bit, for every scheme.
#include <QTest>

#include <cmath>

#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::block_test {

class BlockTest : public QObject {
    Q_OBJECT
private slots:
    void blocksEqualSingleSteps() {
        for (const char* id : {"kepler", "spring-pendulum"}) {
            const System s = systemNamed(id);
            const State start = s.id == "kepler" ? keplerStart : State{0, 0, {0.01, 1, 0, 0}};
            for (const Case& c : everyScheme(4, s)) {
                const auto one = c.make(s, {0, 0.005}), many = c.make(s, {0, 0.005});
                State a = start, b = start;
                for (const std::size_t size : {1UL, 2UL, 37UL, 5UL}) {
                    NodeBlock nodes(4, size);
                    QVERIFY(many->advanceBlock(b, nodes, 1000, {0, 0.005}).outcome == Outcome::converged);
                    QCOMPARE(nodes.size(), size);
                    for (std::size_t i = 0; i < size; ++i) {
                        const StepReport report = advance(*one, a);
                        QVERIFY2(std::equal(a.x.begin(), a.x.end(), nodes.x(i)),
                                 (c.name + " on " + id).c_str());
                        QVERIFY(nodes.t(i) == a.t && nodes.node(i) == a.node);
                        QVERIFY(nodes.report(i).step == report.step);
                    }
                    QVERIFY(a.x == b.x && a.t == b.t && a.node == b.node);
                    std::vector<double> x(4), y(4);
                    one->denseOutput(0.3, x);
                    many->denseOutput(0.3, y);
                    QVERIFY2(x == y, (c.name + " on " + id).c_str());
                }
            }
        }
    }
    void nodesBeforeTroubleAreTold() {
        NodeBlock nodes(2, 3);
        nodes.push(State{0, 0, {1, -2}}, {});
        nodes.push(State{1, 1, {1e308, 0}}, {});
        QCOMPARE(nodes.finiteNodes(), std::size_t{2});
        nodes.push(State{2, 2, {0, HUGE_VAL}}, {});
        QCOMPARE(nodes.finiteNodes(), std::size_t{2});
        nodes.truncate(1);
        nodes.push(State{2, 2, {std::nan(""), 0}}, {});
        QCOMPARE(nodes.finiteNodes(), std::size_t{1});
    }
};

EXTREMAL_TEST(BlockTest)
}  // namespace extremal::laws::block_test

#include "block_test.moc"
