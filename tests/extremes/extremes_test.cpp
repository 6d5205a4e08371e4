// SPDX-License-Identifier: GPL-3.0-or-later
/// All cases of the study of extremes against the table of what is expected: the class of each, and for those
/// that are right a bound of the measure. `EXTREMAL_UPDATE_EXTREMES=1` writes the table, and that of domains
/// in the handbook, anew.
#include <QFile>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/core/text/text.hpp"
#include "engine/study/catalog.hpp"
#include "tests/tools/test.hpp"

namespace extremal::extremes_test {
namespace {

const QString tableFile = QStringLiteral(EXTREMAL_SOURCE_DIR "/tests/extremes/extremes.csv"),
              page = QStringLiteral(EXTREMAL_SOURCE_DIR "/resources/handbook/extremes.md");
const QString opening = QStringLiteral("<!-- domains -->\n"), closing = QStringLiteral("<!-- end -->\n");

QString textOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

void write(const QString& path, const QString& text) {
    QFile file(path);
    if (file.open(QIODevice::WriteOnly)) file.write(text.toUtf8());
}

const ExtremesStudy& study() {
    static const ExtremesStudy known = [] {
        ExtremesStudy all;
        all.run([](std::size_t) {}, {});
        return all;
    }();
    return known;
}

/// What distinguishes a case, as it begins a line of the table.
QString nameOf(const ExtremeCase& at) {
    return QString::fromStdString(at.axis->id + ',' + at.axis->values[at.value] + ',' +
                                  at.axis->label(at.scheme));
}

/// The next power of ten above twice the measure.
double toleranceOf(const ExtremeResult& result) {
    return std::pow(10.0, std::ceil(std::log10(2 * std::max(result.measure, 1e-16))));
}

QString tableOfNow() {
    QString text = QStringLiteral("axis,value,scheme,class,tolerance\n");
    for (const ExtremesStudy::Row& row : study().rows()) {
        text += nameOf(row.at) + ',' + QString::fromStdString(row.result.kind) + ',';
        if (row.result.kind == "right")
            text += QString::fromStdString(formatNumber(toleranceOf(row.result), 2));
        text += '\n';
    }
    return text;
}

/// The table of domains, as Markdown.
QString domainsOfNow() {
    const StudyTable domains = tablesOf(*findStudy("extremes"), study()).at(1);
    QString text = QStringLiteral(
        "| axis | scheme | right from | to | then at | it is |\n"
        "| --- | --- | --- | --- | --- | --- |\n");
    for (const Value::Array& row : domains.rows) {
        for (const Value& cell : row)
            text += QStringLiteral("| ") +
                    (cell.isString() ? QString::fromStdString(cell.asString()) : QString()) + ' ';
        text += QStringLiteral("|\n");
    }
    return text;
}

bool isUpdating() { return qEnvironmentVariableIsSet("EXTREMAL_UPDATE_EXTREMES"); }

}  // namespace

class ExtremesTest : public QObject {
    Q_OBJECT
private slots:
    void everyCaseIsAsExpected() {
        if (isUpdating()) write(tableFile, tableOfNow());
        std::map<QString, std::pair<QString, double>> expected;
        const QStringList lines = textOf(tableFile).split('\n', Qt::SkipEmptyParts);
        for (const QString& line : lines.mid(1)) {
            const QStringList cells = line.split(',');
            QCOMPARE(cells.size(), 5);
            expected[cells.mid(0, 3).join(',')] = {cells[3], cells[4].toDouble()};
        }
        QVERIFY(expected.size() >= 300);
        QCOMPARE(study().size(), expected.size());
        int wrong = 0;
        for (const ExtremesStudy::Row& row : study().rows()) {
            const auto& [kind, tolerance] = expected.at(nameOf(row.at));
            const bool isRight = row.result.kind == "right";
            if (kind.toStdString() == row.result.kind && (!isRight || row.result.measure <= tolerance))
                continue;
            ++wrong;
            qWarning("%s: %s (%g), expected %s (%g)", qPrintable(nameOf(row.at)), row.result.kind.c_str(),
                     row.result.measure, qPrintable(kind), tolerance);
        }
        QCOMPARE(wrong, 0);
    }
    void explicitSchemesBeyondTheirLimitsAreNeverDone() {
        const std::set<std::string> limited{"Störmer-Verlet", "RK4", "symplectic Euler", "Blanes-Moan 6",
                                            "Galerkin Lobatto 3"};
        int seen = 0;
        for (const ExtremesStudy::Row& row : study().rows()) {
            const ExtremeAxis& axis = *row.at.axis;
            if (axis.id != "step" || !limited.contains(axis.label(row.at.scheme))) continue;
            if (std::stod(axis.values[row.at.value]) < 10) continue;
            ++seen;
            QVERIFY2(row.result.kind == "lost" || row.result.kind == "diverged", qPrintable(nameOf(row.at)));
        }
        QCOMPARE(seen, 15);
    }
    void theHandbookHasTheDomains() {
        QString text = textOf(page);
        const auto from = text.indexOf(opening), to = text.indexOf(closing);
        QVERIFY(from >= 0 && to > from);
        const auto begin = from + opening.size();
        if (isUpdating()) {
            text.replace(begin, to - begin, domainsOfNow());
            write(page, text);
        } else {
            QCOMPARE(text.mid(begin, to - begin), domainsOfNow());
        }
    }
};

EXTREMAL_TEST(ExtremesTest)
}  // namespace extremal::extremes_test
#include "extremes_test.moc"
