// SPDX-License-Identifier: GPL-3.0-or-later
/// `extremal atlas` as a user runs it: a page that is well formed and needs nothing from elsewhere, whose
/// numbers are those of the studies; taken up where it was left.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>
#include <QXmlStreamReader>

#include <cmath>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::atlas_test {
namespace {

using tests::Answer;

Answer atlas(const QStringList& arguments) {
    return tests::runProgram(QStringList{"atlas", "--quick", "--systems", "harmonic-oscillator"} + arguments,
                             {{}, {}});
}

QJsonObject rowOf(const QJsonDocument& document, const QString& label) {
    for (const auto& row : document["rows"].toArray())
        if (row.toObject()["label"].toString() == label) return row.toObject();
    return {};
}

}  // namespace

class AtlasTest : public QObject {
    Q_OBJECT
private slots:
    void thePageIsWellFormedAndStandsAlone() {
        const QTemporaryDir dir;
        const Answer a = atlas({"--out", dir.filePath("out")});
        QCOMPARE(a.code, 0);
        static const QRegularExpression time("^this takes about [^\n]*\n");  // said where it is long
        QCOMPARE(QString(a.err).remove(time), QString());
        const QByteArray page = tests::contentOf(dir.filePath("out/index.html"));
        QXmlStreamReader reader(page);
        int cells = 0, tables = 0;
        QStringList pictures;
        while (!reader.atEnd()) {
            reader.readNext();
            if (!reader.isStartElement()) continue;
            tables += reader.name() == QLatin1String("table");
            cells += reader.name() == QLatin1String("td");
            if (reader.name() == QLatin1String("img"))
                pictures << reader.attributes().value("src").toString();
        }
        QVERIFY2(!reader.hasError(), qPrintable(reader.errorString()));
        QCOMPARE(tables, 1);
        QVERIFY(cells > 200);
        QCOMPARE(pictures, QStringList{"harmonic-oscillator.svg"});
        QVERIFY(QFile::exists(dir.filePath("out/harmonic-oscillator.svg")));
        QVERIFY(!page.contains("http") && !page.contains("<script") && !page.contains("url("));
        QVERIFY(!page.contains("Interrupted"));
        QVERIFY(page.contains(">midpoint<") && page.contains("CPU time"));
    }
    void itsNumbersAreMeasured() {
        const QTemporaryDir dir;
        const Answer a = atlas({"--out", dir.filePath("out"), "--json"});
        QCOMPARE(a.code, 0);
        const QJsonDocument document = QJsonDocument::fromJson(a.out.toUtf8());
        QVERIFY(document["complete"].toBool());
        QVERIFY(document["rows"].toArray().size() > 30);
        const QJsonObject verlet = rowOf(document, QStringLiteral("Störmer-Verlet")),
                          gauss = rowOf(document, "galerkin-gauss-2");
        // Orders of the fit; the energy of Gauss collocation is conserved, being quadratic.
        QVERIFY2(std::abs(verlet["order_measured"].toDouble() - 2) < 0.1, qPrintable(a.out.left(300)));
        QVERIFY(std::abs(gauss["order_measured"].toDouble() - 4) < 0.1);
        QVERIFY(gauss["energy"].toDouble() < 1e-13);
        // The oscillator's energy error of Stoermer-Verlet has the known size: H varies by (h w)^2/8 of
        // itself at most, within a third.
        QVERIFY(std::abs(verlet["energy"].toDouble() / (0.5 * 0.25 / 4) - 1) < 0.4);
        QVERIFY(verlet["cpu_seconds"].toDouble() > 0);
        // The error at the step is that of a run of the preset with it.
        const Answer run = tests::runProgram({"run", "preset:harmonic-oscillator", "--set",
                                              "/schemes/*/step=0.5", "--out", dir.filePath("run"), "--json"},
                                             {{}, {}});
        const QJsonArray schemes = QJsonDocument::fromJson(run.out.toUtf8())["schemes"].toArray();
        double known = 0;
        for (const auto& each : schemes)
            if (each.toObject()["label"].toString() == QStringLiteral("Störmer-Verlet"))
                known = each.toObject()["max_error"].toDouble();
        QVERIFY(known > 0 && std::abs(verlet["error"].toDouble() / known - 1) < 1e-12);
    }
    void itGoesOnWhereItWasLeft() {
        const QTemporaryDir dir;
        const Answer first = atlas({"--out", dir.filePath("out"), "--json"});
        // Half of a log is lost, as if the program had been killed.
        const QString log = dir.filePath("out/harmonic-oscillator.error.log");
        const QByteArray whole = tests::contentOf(log);
        QFile file(log);
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(whole.left(whole.size() / 2));
        file.close();
        const Answer second = atlas({"--out", dir.filePath("out"), "--json", "--resume"});
        QCOMPARE(second.code, 0);
        static const QRegularExpression times("cpu_seconds[^,}]*");
        QString a = first.out, b = second.out;
        QCOMPARE(a.remove(times), b.remove(times));
        QVERIFY(tests::contentOf(log).startsWith(whole.left(whole.size() / 2)));
    }
    void misuseSaysWhere() {
        const QTemporaryDir dir;
        const Answer a =
            tests::runProgram({"atlas", "--systems", "keppler", "--out", dir.filePath("out")}, {{}, {}});
        QCOMPARE(a.code, 2);
        QVERIFY2(a.err.contains("--systems") && a.err.contains("keppler"), qPrintable(a.err));
        QVERIFY(!QDir(dir.filePath("out")).exists());
    }
};

EXTREMAL_TEST(AtlasTest)
}  // namespace extremal::atlas_test

#include "atlas_test.moc"
