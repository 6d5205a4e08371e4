// SPDX-License-Identifier: GPL-3.0-or-later
/// Scenes from strangers read nothing outside their own folder before the user agrees; what a run writes can
/// be taken anywhere.
#include <QDir>
#include <QDirIterator>
#include <QTemporaryDir>
#include <QTest>

#include <sys/stat.h>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::strangers_test {
namespace {

using tests::Answer;
using tests::contentOf;
using tests::runProgram;

void write(const QString& path, const QByteArray& text) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(text), text.size());
}

QByteArray sceneWith(const QByteArray& reference) {
    QByteArray text = R"({"extremal": 1, "model": {"type": "pendulum"}, "initial": {"q": [1]},
        "time": {"end": 1}, "schemes": [{"label": "reference", "scheme": "midpoint", "step": 0.1}],
        "reference": {"type": "file", "path": "PATH"}})";
    return text.replace("PATH", reference);
}

const QByteArray orbit = "t,q.theta,p.theta\n0,1,0\n1,0.5,-0.5\n";

}  // namespace

class StrangersTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        QVERIFY(QDir(folder_.path()).mkdir("scene"));
        write(at("outside.csv"), orbit);
        write(at("scene/inside.csv"), orbit);
        QVERIFY(QFile::link(at("outside.csv"), at("scene/link.csv")));
    }

    void filesOutsideTheFolderAreReadWithConsentOnly_data() {
        QTest::addColumn<QByteArray>("path");
        QTest::addColumn<bool>("isInside");
        QTest::newRow("beside the scene") << QByteArray("inside.csv") << true;
        QTest::newRow("beside the scene, absolute") << at("scene/inside.csv").toUtf8() << true;
        QTest::newRow("there and back") << QByteArray("../scene/inside.csv") << true;
        QTest::newRow("above") << QByteArray("../outside.csv") << false;
        QTest::newRow("absolute") << at("outside.csv").toUtf8() << false;
        QTest::newRow("by a link") << QByteArray("link.csv") << false;
    }
    void filesOutsideTheFolderAreReadWithConsentOnly() {
        QFETCH(QByteArray, path);
        QFETCH(bool, isInside);
        const QString scene = at("scene/scene.json");
        write(scene, sceneWith(path));
        for (const QStringList& verb : {QStringList{"check", scene}, {"run", scene, "--out", at("out")}}) {
            const Answer plain = runProgram(verb + QStringList{"--quiet"});
            QCOMPARE(plain.code, isInside ? 0 : 2);
            QCOMPARE(plain.err.contains("/reference/path: lies outside the folder of the scene"), !isInside);
            QCOMPARE(runProgram(verb + QStringList{"--quiet", "--trust"}).code, 0);
        }
        QCOMPARE(
            runProgram({"check", scene, "--quiet", "--set", "/reference/path=\"" + at("outside.csv") + "\""})
                .code,
            0);
    }

    void aRunTakesItsReferenceWithIt() {
        const QString scene = at("scene/scene.json");
        write(scene, sceneWith("inside.csv"));
        QCOMPARE(runProgram({"run", scene, "--quiet", "--out", at("first")}).code, 0);
        QCOMPARE(contentOf(at("first/reference.csv")), orbit);
        QVERIFY(contentOf(at("first/scene.json")).contains("\"path\": \"reference.csv\""));
        // In another place, without the first file, the same bytes; a scheme named so has another file.
        QVERIFY(QDir(folder_.path()).rename("first", "moved"));
        QVERIFY(QFile::remove(at("scene/inside.csv")));
        QCOMPARE(runProgram({"run", at("moved/scene.json"), "--quiet", "--out", at("second")}).code, 0);
        const QStringList files{"reference-2.csv", "reference.csv", "scene.json", "summary.csv",
                                "summary.json"};
        QCOMPARE(QDir(at("moved")).entryList(QDir::Files), files);
        QCOMPARE(QDir(at("second")).entryList(QDir::Files), files);
        for (const QString& name : files)
            if (!name.startsWith("summary"))
                QCOMPARE(contentOf(at("second/" + name)), contentOf(at("moved/" + name)));
        // Into its own folder again.
        QCOMPARE(runProgram({"run", at("second/scene.json"), "--quiet", "--out", at("second")}).code, 0);
        QCOMPARE(contentOf(at("second/reference.csv")), orbit);
    }

    void labelsStayInTheFolder() {
        const QString scene = at("scene/scene.json");
        write(at("scene/inside.csv"), orbit);
        for (const QByteArray& label :
             {QByteArray("../../evil"), QByteArray("/etc/evil"), QByteArray("..\\\\evil")}) {
            write(scene, sceneWith("inside.csv")
                             .replace("\"reference\", \"scheme\"", "\"" + label + "\", \"scheme\""));
            QVERIFY(QDir(at("kept")).removeRecursively());
            const QStringList before = filesBelow(folder_.path());
            QCOMPARE(runProgram({"run", scene, "--quiet", "--out", at("kept")}).code, 0);
            for (const QString& file : filesBelow(folder_.path()))
                QVERIFY2(before.contains(file) || file.startsWith(at("kept/")), qPrintable(file));
            QCOMPARE(QDir(at("kept")).entryList({"*evil.csv"}).size(), 1);
        }
    }

    void whatNeverEndsIsNotRead() {
        const QString scene = at("scene/scene.json");
        QCOMPARE(mkfifo(qPrintable(at("scene/pipe.csv")), 0600), 0);
        QFile huge(at("scene/huge.csv"));
        QVERIFY(huge.open(QIODevice::WriteOnly) &&
                huge.resize(qint64{50} << 30));  // takes no place on the disk
        huge.close();
        write(scene, sceneWith("pipe.csv"));
        QVERIFY(runProgram({"check", scene, "--quiet"}).err.contains("/reference/path: "));
        write(scene, sceneWith("huge.csv"));
        QVERIFY(runProgram({"check", scene, "--quiet"}).err.contains("is larger than 2 GB"));
        QVERIFY(huge.remove());
    }

    void whatWouldFillTheMemoryIsAnError_data() {
        QTest::addColumn<QString>("scene");
        QTest::addColumn<QString>("change");
        QTest::addColumn<QString>("said");
        const auto row = [](const char* scene, const char* change, const char* said) {
            QTest::newRow(change) << scene << change << said;
        };
        row("preset:pendulum", "/output={\"every\": 1e-7}", "rows, the limit is 2e+07");
        row("preset:pendulum", "/output={\"every\": 4e-6}",
            "rows of all schemes together, the limit is 5e+07");
        row("preset:pendulum", "/schemes/0/step=1e-300", "steps from 0 to");
        row("preset:wave", "/model/cells=1e9", "must be an integer from 2 to");
        row("preset:schrodinger-seed", "/model/modes=1e9", "must be an integer from 8 to 65536");
        row("preset:fput-chain", "/model/n=1e8", "must be an integer from 1 to 64");
        row("preset:elliptic", "/model/elements=1e9", "must be an integer from 2 to");
        row("preset:kink-moving-mesh", "/schemes/0/space/nodes=1e9", "must be an integer from 3 to");
    }
    void whatWouldFillTheMemoryIsAnError() {
        QFETCH(QString, scene);
        QFETCH(QString, change);
        QFETCH(QString, said);
        const Answer answer = runProgram({"run", scene, "--quiet", "--set", change, "--out", at("refused")});
        QCOMPARE(answer.code, 2);
        QVERIFY2(answer.err.contains(said), qPrintable(answer.err));
        QVERIFY(!QDir(at("refused")).exists());
    }

private:
    static QStringList filesBelow(const QString& folder) {
        QStringList files;
        for (QDirIterator all(folder, QDir::Files, QDirIterator::Subdirectories); all.hasNext();)
            files << all.next();
        return files;
    }
    QString at(const QString& name) const { return folder_.filePath(name); }

    QTemporaryDir folder_;
};

EXTREMAL_TEST(StrangersTest)

}  // namespace extremal::strangers_test

#include "strangers_test.moc"
