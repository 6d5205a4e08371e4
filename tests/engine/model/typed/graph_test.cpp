// SPDX-License-Identifier: GPL-3.0-or-later
/// Formulas as a graph: what is equal is one node, however it was written.
#include <QTest>

#include <cstddef>
#include <vector>

#include "engine/model/typed/graph.hpp"
#include "tests/tools/test.hpp"

namespace extremal::graph_test {

using typed::Graph;

class GraphTest : public QObject {
    Q_OBJECT
private slots:
    void ordersDoNotMatter() {
        QCOMPARE(g_.sum(1, {{a_, 2}, {b_, 3}, {a_, 1}}), g_.sum(1, {{b_, 3}, {a_, 3}}));
        QCOMPARE(g_.product({{a_, 2}, {c_, 1}, {b_, -1}}), g_.product({{b_, -1}, {a_, 1}, {c_, 1}, {a_, 1}}));
        QVERIFY(g_.sum(0, {{a_, 1}, {b_, 2}}) != g_.sum(0, {{a_, 2}, {b_, 1}}));
    }
    void signsOfSumsDoNotMatter() {
        const int difference = g_.sum(0, {{a_, 1}, {b_, -1}}), opposite = g_.sum(0, {{b_, 1}, {a_, -1}});
        QVERIFY(difference != opposite);
        QCOMPARE(g_.scaled(difference, -1), opposite);
        QCOMPARE(g_.scaled(difference, 3), g_.scaled(opposite, -3));
        QCOMPARE(g_.sum(0, {{difference, 3}, {c_, 1}}), g_.sum(0, {{opposite, -3}, {c_, 1}}));
        const int minusC = g_.scaled(c_, -1);
        QCOMPARE(g_.product({{c_, 1}, {difference, 1}}), g_.product({{minusC, 1}, {opposite, 1}}));
        QVERIFY(g_.product({{c_, 1}, {difference, 1}}) != g_.product({{c_, 1}, {opposite, 1}}));
        QCOMPARE(g_.product({{difference, 2}}), g_.product({{opposite, 2}}));
        QCOMPARE(g_.product({{difference, 3}}), g_.scaled(g_.product({{opposite, 3}}), -1));
        QCOMPARE(g_.product({{difference, 1}}), difference);
        QCOMPARE(g_.product({{opposite, 1}}), opposite);
        // Roots are of what they were written for.
        QVERIFY(g_.product({{difference, 0.5}}) != g_.product({{opposite, 0.5}}));
    }
    void signsOfSumsWithANumber() {
        const int one = g_.sum(1, {{a_, -2}}), other = g_.sum(-1, {{a_, 2}});
        QCOMPARE(g_.scaled(one, 5), g_.scaled(other, -5));
        QCOMPARE(g_.product({{b_, 1}, {one, 1}}), g_.scaled(g_.product({{b_, 1}, {other, 1}}), -1));
    }
    /// In the cube of each spring of a chain the place with the lower number is the positive one, and in a
    /// force the spring before comes before the one after.
    void alongAChainAllIsAlike() {
        std::vector<int> cubes;
        for (int i = 0; i < 100; ++i) {
            const int spring = g_.sum(0, {{g_.symbol(i + 1), 1}, {g_.symbol(i), -1}});
            const int cube = g_.product({{spring, 3}});
            const Graph::Node& scaled = g_.at(cube);
            QCOMPARE(scaled.operands.size(), std::size_t{1});
            QCOMPARE(scaled.operands[0].factor, -1.0);
            cubes.push_back(scaled.operands[0].node);
            const Graph::Node& inner = g_.at(g_.at(cubes.back()).operands[0].node);
            QCOMPARE(inner.operands[0], (Graph::Operand{g_.symbol(i), 1}));
            QCOMPARE(inner.operands[1], (Graph::Operand{g_.symbol(i + 1), -1}));
        }
        for (std::size_t i = 1; i < 100; ++i) {
            const Graph::Node& force = g_.at(g_.sum(0, {{cubes[i], 1}, {cubes[i - 1], -1}}));
            QCOMPARE(force.operands[0].node, cubes[i - 1]);
            QCOMPARE(force.operands[1].node, cubes[i]);
        }
    }

private:
    Graph g_;
    const int a_ = g_.symbol(0), b_ = g_.symbol(1), c_ = g_.symbol(2);
};

EXTREMAL_TEST(GraphTest)
}  // namespace extremal::graph_test

#include "graph_test.moc"
