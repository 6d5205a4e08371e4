// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows at multiples of a distance in time, and at every m-th node.
#include <QTest>

#include <vector>

#include "engine/run/march/row_sampler.hpp"
#include "tests/tools/test.hpp"

namespace extremal::row_sampler_test {

class RowSamplerTest : public QObject {
    Q_OBJECT
private slots:
    /// 0.3 / 0.1 is less than 3: the node at 0.3 is a row all the same.
    void roundedTimesLoseNoRow() {
        RowSampler sampler(0, 0.1, 1);
        long long node = 0;
        for (const double t : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
            QVERIFY(sampler.isRow(++node, t, 0.1));
    }
    void theFirstNodeAtOrAfterEachMultipleIsARow() {
        RowSampler sampler(0, 1.0, 1);
        std::vector<long long> rows;
        for (long long node = 1; node <= 14; ++node)
            if (sampler.isRow(node, 0.375 * static_cast<double>(node), 0.375)) rows.push_back(node);
        QCOMPARE(rows, (std::vector<long long>{3, 6, 8, 11, 14}));
    }
    void aLongStepSkipsMultiples() {
        RowSampler sampler(0, 1.0, 1);
        QVERIFY(sampler.isRow(1, 3.5, 3.5));
        QVERIFY(!sampler.isRow(2, 3.75, 0.25));
        QVERIFY(sampler.isRow(3, 4, 0.25));
    }
    void withoutADistanceEveryMthNodeIsARow() {
        RowSampler sampler(0, {}, 3);
        std::vector<long long> rows;
        for (long long node = 1; node <= 9; ++node)
            if (sampler.isRow(node, 0.1 * static_cast<double>(node), 0.1)) rows.push_back(node);
        QCOMPARE(rows, (std::vector<long long>{3, 6, 9}));
    }
    void stridesKeepTheNumberOfRows() {
        QCOMPARE(RowSampler::stride(1), 1);
        QCOMPARE(RowSampler::stride(1999), 1);
        QCOMPARE(RowSampler::stride(2000), 2);
        QCOMPARE(RowSampler::stride(1000000), 501);
    }
};

EXTREMAL_TEST(RowSamplerTest)

}  // namespace extremal::row_sampler_test

#include "row_sampler_test.moc"
