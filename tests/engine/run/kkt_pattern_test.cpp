// SPDX-License-Identifier: GPL-3.0-or-later
#include <QTest>

#include <algorithm>
#include <set>

#include "engine/run/exact_actions.hpp"
#include "engine/run/kkt_pattern.hpp"
#include "engine/solve/discrete_lagrangian.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::kkt_pattern_test {
namespace {

/// Cells and other functions that overlap with the tent in the middle of a tensor mesh of some dimensions:
/// counted, not computed from a formula.
struct Counted {
    int cells = 0, others = 0;
};
Counted countTents(int dimensions) {
    // Node and cell coordinates as digits; the tent at 0 lives on the cells [-1, 0] and [0, 1] of every
    // direction.
    const int cellChoices = 6, nodeChoices = 7;  // cells -3..2, nodes -3..3
    const auto power = [](int base, int n) {
        int result = 1;
        while (n-- > 0) result *= base;
        return result;
    };
    const auto lives = [&](int node, int cell) {
        bool isInside = true;
        for (int i = 0, a = node, c = cell; i < dimensions; ++i, a /= nodeChoices, c /= cellChoices) {
            const int at = a % nodeChoices - 3, left = c % cellChoices - 3;
            isInside = isInside && (left == at - 1 || left == at);
        }
        return isInside;
    };
    int middle = 0;
    for (int i = 0; i < dimensions; ++i) middle = middle * nodeChoices + 3;
    Counted counted;
    std::set<int> others;
    for (int cell = 0; cell < power(cellChoices, dimensions); ++cell) {
        if (!lives(middle, cell)) continue;
        ++counted.cells;
        for (int node = 0; node < power(nodeChoices, dimensions); ++node)
            if (node != middle && lives(node, cell)) others.insert(node);
    }
    counted.others = static_cast<int>(others.size());
    return counted;
}

bool has(const KktPattern::Entries& entries, int row, int column) {
    return std::find(entries.begin(), entries.end(), std::pair(row, column)) != entries.end();
}

}  // namespace

class KktPatternTest : public QObject {
    Q_OBJECT
    const System kepler_ = systemNamed("kepler"), pendulum_ = systemNamed("pendulum");
    const State pendulumStart_{0, 0, {1, 0.7}};

private slots:
    void termsAndOverlapsOfTentsAreWhatIsSaid() {
        // In time alone 2 terms and 2 others, in space-time 4 and 8, then 8 and 26.
        for (int n = 0; n <= 2; ++n) {
            const Counted c = countTents(n + 1);
            QCOMPARE(c.cells, 1 << (n + 1));
            QCOMPARE(c.others, n == 0 ? 2 : n == 1 ? 8 : 26);
        }
        const KktPattern line =
            kktPattern(kepler_, polynomialPair(1, {"midpoint", {}, {}}), keplerStart, 0.05);
        QCOMPARE(line.termsAtNode, countTents(1).cells);
        QCOMPARE(line.othersAtNode, countTents(1).others);
    }
    void localSupportsMakeABandAndModesFullBlocks() {
        const KktPattern nodal =
            kktPattern(pendulum_, polynomialPair(4, {"gauss", {}, {}}), pendulumStart_, 0.1);
        QVERIFY(nodal.isNodal && nodal.failure.empty());
        QCOMPARE(nodal.elements, 4);
        QCOMPARE(nodal.size, 4 * 5 + 5);
        QCOMPARE(nodal.othersAtNode, 8);
        QCOMPARE(nodal.othersInside, 4);
        QCOMPARE(nodal.action.size(), std::size_t(4 * 25));
        QCOMPARE(nodal.continuity.size(), std::size_t(2 * 4 * 2));  // one function at each end of an element
        const KktPattern modal =
            kktPattern(pendulum_, polynomialPair(4, {"gauss", {}, {}}, "legendre"), pendulumStart_, 0.1);
        QVERIFY(!modal.isNodal);
        QCOMPARE(modal.termsAtNode, 0);
        QCOMPARE(modal.continuity.size(), std::size_t(2 * 4 * 10));  // every function is at both ends
        QVERIFY(modal.bandwidth <= modal.size / 4);
    }
    void coordinatesThatDoNotCoupleLeaveHoles() {
        // Kinetic energy of Kepler couples x with x alone; the potential couples both, but not on the axis at
        // one node.
        const KktPattern verlet =
            kktPattern(kepler_, polynomialPair(1, {"trapezoid", {}, {}}), keplerStart, 0.05);
        const int z0 = verlet.blocks[1].offset;
        QVERIFY(has(verlet.action, z0, z0));
        QVERIFY(has(verlet.action, z0, z0 + 2));   // x at both ends, by the kinetic energy
        QVERIFY(!has(verlet.action, z0, z0 + 1));  // x and y at the start, where y = 0
        QVERIFY(has(verlet.action, z0 + 2, z0 + 3));
    }
    void splinesOverlapWithTheirNeighboursOnly() {
        const KktPattern p = kktPattern(pendulum_, splinePair(2, 8, {"gauss", {}, {}}), pendulumStart_, 0.1);
        QVERIFY(p.isNodal);
        QCOMPARE(p.othersAtNode, 2 * 2);
        QCOMPARE(p.othersInside, 4);
        QVERIFY(p.action.size() < static_cast<std::size_t>(p.elements * 10 * 10) / 2 + 40);
    }
    void theMatrixIsSymmetric() {
        for (const char* basis : {"lobatto", "chebyshev-modal"}) {
            const KktPattern p =
                kktPattern(kepler_, polynomialPair(3, {"lobatto", {}, {}}, basis), keplerStart, 0.1);
            for (const KktPattern::Entries* entries : {&p.action, &p.continuity})
                for (const auto& [i, j] : *entries) QVERIFY(has(*entries, j, i));
        }
    }
    void defectsOfTheActionHaveTheOrderPlusOne() {
        // Measured 3.00, 5.00, 6.99, and 5.02 for six Clenshaw-Curtis nodes at degree 5.
        ExactActions exact(kepler_, keplerStart, 0.2);
        for (const auto& [discretization, order] : {std::pair{polynomialPair(1, {"midpoint", {}, {}}), 2},
                                                    std::pair{polynomialPair(2, {"gauss", {}, {}}), 4},
                                                    std::pair{polynomialPair(3, {"lobatto", {}, {}}), 6}}) {
            const ActionDefect d = actionDefect(kepler_, discretization, 0, exact, {});
            qInfo("order %d: slope %.3f over %d points", order, d.order, d.fitTo - d.fitFrom);
            QVERIFY(d.failure.empty());
            QVERIFY(std::abs(d.order - (order + 1)) <
                    0.1);  // 3.00, 5.00, 6.95: in double precision, over the window there is
        }
    }
    void aFitOfPointsThatAreOnNoLineIsNone() {
        // Degree 12 falls from 1 to round-off within a factor of 3 in h, steeper than it ever should.
        ExactActions exact(pendulum_, pendulumStart_, 2);
        const ActionDefect d = actionDefect(pendulum_, polynomialPair(12, {"gauss", {}, {}}), 0, exact, {});
        QVERIFY(d.failure.empty() && d.h.size() >= 3);
        QCOMPARE(d.order, 0.0);
    }
    void exactActionsGiveUpWhenAskedTo() {
        // A boundary-value problem over fifteen periods: seconds. Given up it is not known, and not kept as
        // such.
        ExactActions exact(pendulum_, pendulumStart_, 100);
        std::stop_source stop;
        stop.request_stop();
        QVERIFY(!exact.at(0, stop.get_token()).isKnown);
        QVERIFY(!exact.at(16, stop.get_token()).isKnown);
        QVERIFY(exact.at(16, {}).isKnown);
        ActionBetween<double>::Matrix path(1, 2);
        path << 1, 1.1;
        QVERIFY(exactDiscreteLagrangian<double>(pendulum_.mechanics(), 0, 1, path, 1e-15, stop.get_token())
                    .outcome == Outcome::stopped);
    }
    void theDefectOfAWrongRuleHasAnotherOrder() {
        // Degree 2 with the two nodes of the trapezoid: order 2, not 4. The measurement must tell.
        ExactActions exact(kepler_, keplerStart, 0.2);
        const ActionDefect d = actionDefect(kepler_, polynomialPair(2, {"trapezoid", {}, {}}), 0, exact, {});
        qInfo("slope %.3f", d.order);
        QVERIFY(std::abs(d.order - 3) < 0.15);
    }
};

EXTREMAL_TEST(KktPatternTest)
}  // namespace extremal::laws::kkt_pattern_test

#include "kkt_pattern_test.moc"
