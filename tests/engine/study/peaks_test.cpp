// SPDX-License-Identifier: GPL-3.0-or-later
/// Peaks are found where they stand out, and nowhere else.
#include <QTest>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/study/stability/peaks.hpp"
#include "tests/tools/test.hpp"

namespace extremal::peaks_test {

class PeaksTest : public QObject {
    Q_OBJECT
private slots:
    void resonancesAreFoundWhereTheyAre() {
        // 1 + sum of 1e-4/((x - a)^2 + 1e-6): peaks of 100 at 1 and 2.
        std::vector<double> values;
        for (int i = 0; i <= 300; ++i) {
            const double x = 0.01 * i;
            values.push_back(1 + 1e-4 / ((x - 1) * (x - 1) + 1e-6) + 1e-4 / ((x - 2) * (x - 2) + 1e-6));
        }
        const std::vector<Peak> peaks = findPeaks(values, 4);
        QCOMPARE(peaks.size(), 2UL);
        QCOMPARE(peaks[0].first, 100UL);
        QCOMPARE(peaks[1].first, 200UL);
        QVERIFY(std::abs(peaks[0].prominence - 101) < 0.1);
    }
    void windowsOfInstabilityArePeaks() {
        const double inf = std::numeric_limits<double>::infinity();
        const std::vector<Peak> peaks = findPeaks(std::vector<double>{1, 1.1, inf, inf, 1.2, 1, inf}, 4);
        QCOMPARE(peaks.size(), 1UL);  // the last value is an end
        QCOMPARE(peaks[0].first, 2UL);
        QCOMPARE(peaks[0].last, 3UL);
    }
    void slopesAndRipplesAreNone() {
        std::vector<double> values;
        for (int i = 0; i < 100; ++i) values.push_back(std::exp(0.1 * i) * (1 + 0.3 * (i % 2)));
        QVERIFY(findPeaks(values, 4).empty());
        QVERIFY(findPeaks(std::vector<double>{}, 4).empty());
    }
};

EXTREMAL_TEST(PeaksTest)
}  // namespace extremal::peaks_test
#include "peaks_test.moc"
