// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums and names by index, written out, and what is refused.
#include <QTest>

#include "engine/core/text/indexed.hpp"
#include "tests/tools/test.hpp"

namespace extremal {
namespace {

class IndexedTest : public QObject {
    Q_OBJECT
private slots:
    void sumsAreWrittenOut() {
        const NamedNumbers n{{"n", 3}};
        QCOMPARE(writtenOut("sum(i, 1..n, x[i]^2)", n), std::string("(( x1^2)+( x2^2)+( x3^2))"));
        QCOMPARE(writtenOut("sum(i,2..n,(x[i]-x[i-1])^2/i)", n),
                 std::string("(((x2-x1)^2/2)+((x3-x2)^2/3))"));
        QCOMPARE(writtenOut("m*x[2*n-1]_t + sinus(i)", n), std::string("m*x5_t + sinus(i)"));
        QCOMPARE(writtenOut("sum(i,1..2,sum(j,i..2,a[i+j]))", n), std::string("((((a2)+(a3)))+(((a4))))"));
        QCOMPARE(writtenOut("sum(i,-1..0,q^i)", n), std::string("((q^(-1))+(q^0))"));
        QCOMPARE(writtenOut("sum(i,2..1,q[i])", n), std::string("(0)"));
    }
    void namesAreWrittenOut() {
        const NamedNumbers n{{"n", 3}};
        QCOMPARE(namesOf("x", n).size(), std::size_t{1});
        const auto x = namesOf("x[1..n]", n);
        QCOMPARE(x.size(), std::size_t{3});
        QCOMPARE(x.back().name, std::string("x3"));
        QVERIFY(x.back().index.empty());
        const auto rods = namesOf("rod[i = 2..n]", n);
        QCOMPARE(rods.size(), std::size_t{2});
        QCOMPARE(rods.front().name, std::string("rod2"));
        QCOMPARE(writtenOut("x[i]-x[i-1]-i*l", n, rods.back()), std::string("x3-x2-3*l"));
    }
    void onlyWhatHasIndicesIsTouched() {
        QVERIFY(!hasIndices("x^2 + summe(y) + sum1"));
        QVERIFY(hasIndices("1 + sum (i,1..2,x[i])"));
        QVERIFY(hasIndices("x[1]"));
    }
    /// Reading is bounded: the length of what is written out, the range of an index, sums in each other.
    void whatIsTooLongIsRefused_data() {
        QTest::addColumn<QString>("text");
        QTest::addColumn<QString>("said");
        QTest::newRow("range") << "sum(i, 1..1000000, x[i])"
                               << "the limit is 10000";
        QTest::newRow("length") << "sum(i,1..9999,sum(j,1..9999,x[i]*y[j]))"
                                << "when its sums are written out";
        QTest::newRow("depth") << "sum(a,1..1,sum(b,1..1,sum(c,1..1,sum(d,1..1,sum(e,1..1,sum(f,1..1,sum(g,1."
                                  ".1,sum(h,1..1,sum(k,1..1,"
                                  "1)))))))))"
                               << "more than 8 sums";
        QTest::newRow("typed") << QString(10001, QChar('x')) << "the limit is 10000";
        QTest::newRow("fraction") << "x[1/2]"
                                  << "not a whole number";
        QTest::newRow("negative") << "x[0-1]"
                                  << "below 0";
        QTest::newRow("bracket") << "x[1"
                                 << "not closed";
        QTest::newRow("no range") << "sum(i, n, x[i])"
                                  << "needs a range";
        QTest::newRow("no terms") << "sum(i, 1..n)"
                                  << "without index, range and terms";
        QTest::newRow("unknown") << "x[k]"
                                 << "k";
        QTest::newRow("huge") << "x[1e300]"
                              << "not a whole number";
    }
    void whatIsTooLongIsRefused() {
        QFETCH(QString, text);
        QFETCH(QString, said);
        try {
            (void)writtenOut(text.toStdString(), {{"n", 3}});
            QFAIL("it was taken");
        } catch (const ExpressionError& e) {
            QVERIFY2(std::string(e.what()).find(said.toStdString()) != std::string::npos, e.what());
        }
    }
};

EXTREMAL_TEST(IndexedTest)
}  // namespace
}  // namespace extremal
#include "indexed_test.moc"
