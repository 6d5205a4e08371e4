// SPDX-License-Identifier: GPL-3.0-or-later
/// Eliminations in vector registers: of every size the bits of plain loops.
#include <QTest>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "engine/solve/small_lu.hpp"
#include "tests/tools/test.hpp"

namespace extremal::small_lu_test {

using Numbers = std::vector<double>;

Numbers numbers(std::size_t count, std::mt19937_64& generator) {
    std::normal_distribution<double> any;
    Numbers all(count);
    for (double& each : all) each = any(generator);
    return all;
}

Outcome factorise(SmallLu<double>& lu, const Numbers& A, std::size_t n) {
    lu.clear();
    for (std::size_t j = 0; j < n; ++j)
        std::copy_n(A.begin() + static_cast<std::ptrdiff_t>(j * n), n, lu.column(static_cast<int>(j)));
    return lu.factorise();
}

class SmallLuTest : public QObject {
    Q_OBJECT
private slots:
    /// 64 unknowns are eight registers of the widest, and the largest size of the kernels.
    void everySizeHasTheBitsOfPlainLoops() {
        std::mt19937_64 generator(5);
        for (std::size_t n = 1; n <= 70; ++n) {
            Numbers A = numbers(n * n, generator), b = numbers(n, generator), inverse(n);
            if (n > 2) A[0] = A[n + 1] = 0;  // the first two pivots are elsewhere
            std::vector<std::size_t> row(n);
            SmallLu<double> lu(static_cast<int>(n));
            Numbers plain = A;
            QCOMPARE(lu::factorise(plain.data(), n, inverse.data(), row.data()), Outcome::converged);
            QCOMPARE(factorise(lu, A, n), Outcome::converged);
            Numbers expected = b, x = b;
            lu::solve(plain.data(), n, inverse.data(), row.data(), expected.data());
            lu.solve(x.data());
            QVERIFY2(x == expected, qPrintable(QString::number(n)));
            expected = x = b;
            lu::solveTransposed(plain.data(), n, inverse.data(), row.data(), expected.data());
            lu.solveTransposed(x.data());
            QVERIFY2(x == expected, qPrintable(QString::number(n)));
        }
    }
    void ofEqualPivotsTheFirstIsTaken() {
        const Numbers A{1, -1, 1, 2, 1, 1, 0, 1, 5};
        Numbers plain = A, inverse(3), expected{1, 2, 3}, x = expected;
        std::vector<std::size_t> row(3);
        SmallLu<double> lu(3);
        lu::factorise(plain.data(), 3, inverse.data(), row.data());
        lu::solve(plain.data(), 3, inverse.data(), row.data(), expected.data());
        QCOMPARE(factorise(lu, A, 3), Outcome::converged);
        lu.solve(x.data());
        QCOMPARE(x, expected);
    }
    void whatHasNoPivotIsSaid() {
        for (const std::size_t n : {3U, 9U, 20U}) {
            SmallLu<double> lu(static_cast<int>(n));
            Numbers A(n * n, 1.0);
            QCOMPARE(factorise(lu, A, n), Outcome::singular);
            A.back() = std::numeric_limits<double>::quiet_NaN();
            QCOMPARE(factorise(lu, A, n), Outcome::singular);  // found before it
            A[n + 1] = std::numeric_limits<double>::quiet_NaN();
            QCOMPARE(factorise(lu, A, n), Outcome::notFinite);
            A[0] = std::numeric_limits<double>::infinity();
            QCOMPARE(factorise(lu, A, n), Outcome::notFinite);
            // What was there before is no part of the next.
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t i = 0; i < n; ++i) A[j * n + i] = i == j ? 2 : 0;
            QCOMPARE(factorise(lu, A, n), Outcome::converged);
            Numbers x(n, 1.0);
            lu.solve(x.data());
            QCOMPARE(x, Numbers(n, 0.5));
        }
    }
};

EXTREMAL_TEST(SmallLuTest)

}  // namespace extremal::small_lu_test

#include "small_lu_test.moc"
