// SPDX-License-Identifier: GPL-3.0-or-later
/// The handbook's page of Filon's rules: it says what the program measures, and what it measures is what
/// theory says.
#include <QDir>
#include <QFile>
#include <QTest>

#include <algorithm>
#include <cmath>

#include "tests/tools/filon_table.hpp"
#include "tests/tools/test.hpp"

namespace extremal::tools::filon_test {
namespace {

constexpr FilonNodes gaussAndLobatto[] = {FilonNodes::gauss, FilonNodes::lobatto};

/// The cells of every row of the page's tables.
QList<QStringList> rowsOf(const QString& text) {
    QList<QStringList> rows;
    for (const QString& line : text.split('\n')) {
        if (!line.startsWith("| ") || line.startsWith("| ---") || line.startsWith("| rule") ||
            line.startsWith("| hω"))
            continue;
        QStringList cells = line.mid(2, line.size() - 4).split(" | ");
        for (QString& cell : cells)
            cell = cell.section(' ', 0, cell.startsWith("Gauss") || cell.startsWith("Lob") ? -1 : 0);
        rows << cells;
    }
    return rows;
}

QStringList wordsOf(const QString& text) {
    QStringList lines = text.split('\n');
    lines.removeIf([](const QString& line) { return line.startsWith("| "); });
    return lines;
}

/// Equal but for round-off: slopes to a hundredth, errors to a part in a hundred and to half the floor.
bool isSame(const QString& a, const QString& b, bool isSlope) {
    if (a == b) return true;
    const double x = a.toDouble(), y = b.toDouble();  // 0 where the cell is not a number: "<"
    return isSlope ? std::abs(x - y) < 0.011 : std::abs(x - y) <= 0.01 * std::max(x, y) + filonFloor / 2;
}

}  // namespace

class FilonPageTest : public QObject {
    Q_OBJECT
private slots:
    void thePageIsWhatTheProgramMeasures() {
        QFile page(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/filon.md"));
        QVERIFY(page.open(QIODevice::ReadOnly));
        const QString there = QString::fromUtf8(page.readAll()), now = QString::fromStdString(filonPage());
        QDir().mkpath(QStringLiteral(EXTREMAL_TEST_OUTPUT));
        QFile actual(QStringLiteral(EXTREMAL_TEST_OUTPUT "/filon.md"));
        if (actual.open(QIODevice::WriteOnly)) actual.write(now.toUtf8());
        const auto a = rowsOf(there), b = rowsOf(now);
        QCOMPARE(a.size(), qsizetype(8 + 9));
        QCOMPARE(b.size(), a.size());
        for (qsizetype row = 0; row < a.size(); ++row) {
            QCOMPARE(a[row].size(), b[row].size());
            for (qsizetype i = 0; i < a[row].size(); ++i)
                QVERIFY2(isSame(a[row][i], b[row][i], row < 8),
                         qPrintable(a[row].join(", ") + " but now " + b[row].join(", ")));
        }
        // The words around the numbers as well.
        QVERIFY2(wordsOf(there) == wordsOf(now),
                 qPrintable("resources/handbook/filon.md is out of date: ninja handbook.filon, or copy " +
                            actual.fileName()));
    }
    void theSlopesAreThoseOfTheory() {
        for (const FilonNodes nodes : gaussAndLobatto)
            for (int count = 2; count <= 5; ++count) {
                const FilonSlopes s = measureSlopes(nodes, count);
                const bool isGauss = nodes == FilonNodes::gauss;
                // Measured: 0.023 above, as e^x is not a power; 0.001 in hω.
                QVERIFY(std::abs(s.still - (2 * count + (isGauss ? 1 : -1))) < 0.05);
                QVERIFY(std::abs(s.one - (count + 1)) < 0.05 && std::abs(s.fast - (count + 1)) < 0.05);
                QVERIFY(std::abs(s.inFrequency - (isGauss ? -1 : -2)) < 0.01);
            }
    }
    void theProgramHasTheWeightsOfQuadruplePrecision() {
        for (const FilonNodes nodes : gaussAndLobatto)
            for (int count = 2; count <= 5; ++count)
                for (const double z : {1e-9, 1e-2, 1.0, 7.9, 8.1, 1e3, 1e6}) {
                    const double error = filonWeightError(nodes, count, z);
                    QVERIFY2(error < 1e-15,
                             qPrintable(QString("%1 nodes, z %2: %3").arg(count).arg(z).arg(error)));
                }
    }
    void theTableHasItsKnownValues() {
        // From a derivation in sixty digits.
        const double known[][6] = {{8.24e-7, 9.33e-10, 6.5e-13, 5.80e-4, 1.10e-6, 1.17e-9},
                                   {8.48e-7, 9.70e-10, 6.9e-13, 6.24e-4, 1.14e-6, 1.21e-9},
                                   {1.62e-5, 5.97e-8, 1.42e-10, 2.35e-3, 1.66e-5, 6.38e-8},
                                   {3.20e-3, 1.85e-4, 5.87e-6, 1.90e-3, 3.20e-4, 1.85e-5},
                                   {2.78e-4, 2.37e-6, 1.11e-6, 6.68e-6, 2.77e-6, 2.10e-8},
                                   {2.47e-5, 9.83e-7, 9.61e-8, 1.37e-7, 2.46e-8, 9.77e-10},
                                   {5.56e-7, 1.97e-7, 1.96e-9, 2.78e-9, 5.16e-11, 1.97e-11},
                                   {3.52e-8, 1.99e-8, 9.4e-11, 2.82e-11, 2.8e-13, 2.0e-13},
                                   {2.76e-8, 4.05e-10, 1.1e-10, 6.1e-14, 2.8e-14, 4e-16}};
        for (std::size_t row = 0; row < filonRows().size(); ++row)
            for (std::size_t c = 0; c < 6; ++c) {
                const FilonColumn& column = filonColumns()[c];
                const double error = filonError(column.nodes, column.count, 1, filonRows()[row]),
                             expected = known[row][c];
                // To the digits given, but for round-off: measured 7e-16.
                QVERIFY2(std::abs(error - expected) <= 0.02 * expected + filonFloor,
                         qPrintable(QString("%1 at %2: %3")
                                        .arg(QString::fromStdString(column.name))
                                        .arg(filonRows()[row])
                                        .arg(error)));
                const double wide = wideFilonError(column.nodes, column.count, 1, filonRows()[row]);
                QVERIFY(std::abs(error - wide) <= filonFloor);
            }
    }
    void aRuleOfTheOtherFamilyIsSeen() {
        // Teeth: slopes and errors tell the families apart, and a page with one of them in place of the other
        // is not the same.
        QVERIFY(std::abs(measureSlopes(FilonNodes::gauss, 3).inFrequency + 2) > 0.5);
        QVERIFY(std::abs(measureSlopes(FilonNodes::lobatto, 3).still - 7) > 1);
        QVERIFY(!isSame("8.24e-7", "8.4e-7", false) && isSame("8.24e-7", "8.25e-7", false) &&
                isSame("<", "4e-16", false));
        QVERIFY(!isSame("7.02", "6.98", true) && !isSame("<", "3e-15", false));
    }
    void thePictureIsThere() {
        QFile picture(QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/filon.svg"));
        QVERIFY(picture.open(QIODevice::ReadOnly));
        const QByteArray svg = picture.readAll();
        QVERIFY(svg.contains("<svg") && svg.contains("Gauss 3") && svg.contains("Lobatto 5"));
    }
};

EXTREMAL_TEST(FilonPageTest)
}  // namespace extremal::tools::filon_test

#include "filon_test.moc"
