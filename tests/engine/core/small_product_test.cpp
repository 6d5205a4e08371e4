// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over the nodes of a step: every shape of tiles gives the bits of plain loops in the order of the
/// terms. And eliminations of few unknowns.
#include <QTest>

#include <cmath>
#include <random>
#include <vector>

#include "engine/core/algebra/elimination.hpp"
#include "engine/core/algebra/small_product.hpp"
#include "tests/tools/test.hpp"

namespace extremal::small_product_test {

std::vector<double> numbers(int count, std::mt19937_64& generator) {
    std::normal_distribution<double> any;
    std::vector<double> all(static_cast<std::size_t>(count));
    for (double& each : all) each = any(generator);
    return all;
}

class SmallProductTest : public QObject {
    Q_OBJECT
private slots:
    void everyTileHasTheBitsOfPlainLoops() {
        std::mt19937_64 generator(7);
        for (const int rows : {1, 6, 8, 14, 18, 48, 96})
            for (const int columns : {1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 17})
                for (const int depth : {1, 6, 48}) {
                    const int stride = (rows + 7) / 8 * 8;
                    const std::vector<double> A = numbers(stride * depth, generator),
                                              B = numbers(depth * columns, generator);
                    std::vector<double> C = numbers(rows * columns, generator), plain = C;
                    nodeSums().product(
                        {A.data(), stride, B.data(), depth, C.data(), rows, rows, columns, depth});
                    for (int c = 0; c < columns; ++c)
                        for (int r = 0; r < rows; ++r) {
                            double sum = 0;
                            for (int i = 0; i < depth; ++i)
                                sum += A[static_cast<std::size_t>(i * stride + r)] *
                                       B[static_cast<std::size_t>(c * depth + i)];
                            plain[static_cast<std::size_t>(c * rows + r)] += sum;
                        }
                    QVERIFY2(C == plain, qPrintable(QString("%1 x %2").arg(rows).arg(columns)));
                }
    }
    void sumsOfTwoKeepWhatCancels() {
        // 1e16 + 1 - 1e16: plain loops lose the 1.
        const std::vector<double> a{1, 1}, b{1, 1};
        std::vector<double> A(16, 0.0), B(16, 0.0), c(8);
        A[3] = 1e16;
        A[8 + 3] = 1;
        B[3] = -1e16;
        B[8 + 3] = 0.25;
        nodeSums().sumOfTwo({A.data(), a.data(), B.data(), b.data(), 8, 5, 2, c.data()});
        QCOMPARE(c[3], 1.25);
        QCOMPARE(c[4], 0.0);
    }
    void eliminationFindsWhatTheMatrixWasAppliedTo() {
        std::mt19937_64 generator(11);
        for (const int n : {1, 2, 3, 5, 20}) {
            std::vector<double> A = numbers(n * n, generator), b(static_cast<std::size_t>(n), 0.0);
            A[0] = n > 1 ? 0 : 2;  // no pivot without an exchange
            const std::vector<double> x = numbers(n, generator);
            for (int j = 0; j < n; ++j)
                for (int i = 0; i < n; ++i)
                    b[static_cast<std::size_t>(i)] +=
                        A[static_cast<std::size_t>(j * n + i)] * x[static_cast<std::size_t>(j)];
            eliminate(n, A.data(), b.data());
            for (std::size_t i = 0; i < x.size(); ++i) QVERIFY(std::abs(b[i] - x[i]) < 1e-11);
        }
        double singular[]{1, 2, 2, 4}, b[]{1, 1};
        eliminate(2, singular, b);
        QVERIFY(!std::isfinite(b[0]) && !std::isfinite(b[1]));
    }
};

EXTREMAL_TEST(SmallProductTest)

}  // namespace extremal::small_product_test

#include "small_product_test.moc"
