// SPDX-License-Identifier: GPL-3.0-or-later
/// Wisdom of Fourier transforms as a user keeps and uses it.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::wisdom_test {
namespace {

using tests::Answer, tests::contentOf;

Answer extremalWith(const QString& wisdom, const QStringList& arguments) {
    tests::Surroundings around;
    if (!wisdom.isEmpty()) around.environment.insert("EXTREMAL_WISDOM", wisdom);
    return tests::runProgram(arguments, around);
}

}  // namespace

class WisdomTest : public QObject {
    Q_OBJECT
private slots:
    void isMeasuredKeptAndAddedTo() {
        const QTemporaryDir folder;
        const QString file = folder.filePath("wisdom");
        const Answer first = extremalWith({}, {"wisdom", "--out", file, "--modes", "64", "--json"});
        QCOMPARE(first.code, 0);
        const QJsonArray rows = QJsonDocument::fromJson(first.out.toUtf8()).object()["transforms"].toArray();
        QCOMPARE(rows.size(), qsizetype(1));
        QCOMPARE(rows[0].toObject()["modes"].toString(), QString("64"));
        QVERIFY(rows[0].toObject()["estimated"].toDouble() > 0 &&
                rows[0].toObject()["measured"].toDouble() > 0);
        const auto plans = [&] { return contentOf(file).count('\n'); };
        const auto before = plans();
        QVERIFY(before > 2);
        QCOMPARE(extremalWith({}, {"wisdom", "--out", file, "--modes", "32x48", "--quiet"}).code, 0);
        QVERIFY(plans() > before);
        // No partial file is left.
        QCOMPARE(QDir(folder.path()).entryList(QDir::Files), QStringList{"wisdom"});
    }
    void runsWithTheSameWisdomAreTheSame() {
        const QTemporaryDir folder;
        const QString file = folder.filePath("wisdom");
        QCOMPARE(extremalWith({}, {"wisdom", "--out", file, "--modes", "128", "--quiet"}).code, 0);
        const auto run = [&](const QString& out) {
            return extremalWith(file, {"run", "preset:revival", "--set", "/time/end=0.1", "--out",
                                       folder.filePath(out), "--quiet"})
                .code;
        };
        QCOMPARE(run("a"), 0);
        QCOMPARE(run("b"), 0);
        const QStringList fields = QDir(folder.filePath("a")).entryList({"*.field.csv"});
        QVERIFY(!fields.isEmpty());
        for (const QString& name : fields) {
            const QByteArray a = contentOf(folder.filePath("a/" + name));
            QVERIFY(!a.isEmpty());
            QVERIFY(a == contentOf(folder.filePath("b/" + name)));
        }
    }
    void whatCannotBeUsedIsSaid() {
        const QTemporaryDir folder;
        const QString file = folder.filePath("wisdom");
        for (const char* modes : {"63", "4", "0", "64x", "x64", "64x63", "4096x4096", "1e2", ""}) {
            const Answer a = extremalWith({}, {"wisdom", "--out", file, "--modes", modes});
            QVERIFY2(a.code == 2 && !a.err.isEmpty(), modes);
        }
        QVERIFY(!QFile::exists(file));
        QCOMPARE(extremalWith({}, {"wisdom", "--out", folder.filePath("no/such"), "--modes", "16"}).code, 3);
        QCOMPARE(extremalWith({}, {"wisdom", "--out", file}).code, 2);
        QFile other(folder.filePath("other"));
        QVERIFY(other.open(QIODevice::WriteOnly));
        other.write("{}");
        other.close();
        // A file that is something else is not written over.
        QCOMPARE(extremalWith({}, {"wisdom", "--out", folder.filePath("other"), "--modes", "16"}).code, 2);
        QCOMPARE(contentOf(folder.filePath("other")), QByteArray("{}"));
        const Answer used = extremalWith(folder.filePath("other"), {"check", "preset:revival"});
        QCOMPARE(used.code, 2);
        QVERIFY2(used.err.contains("EXTREMAL_WISDOM"), qPrintable(used.err));
        QCOMPARE(extremalWith(folder.filePath("none"), {"check", "preset:revival"}).code, 2);
    }
};

EXTREMAL_TEST(WisdomTest)
}  // namespace extremal::wisdom_test

#include "wisdom_test.moc"
