// SPDX-License-Identifier: GPL-3.0-or-later
/// Files that are not files, folders that cannot be, signals, and lists of problems without an end.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <QTest>

#include <csignal>

#include <sys/stat.h>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::stray_files_test {
namespace {

using tests::Answer;
using tests::contentOf;
using tests::runProgram;

void put(const QString& path, const QByteArray& content) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(content), content.size());
}

Answer with(const char* variable, const QString& value, const QStringList& arguments) {
    tests::Surroundings around;
    around.environment.insert(variable, value);
    return runProgram(arguments, around);
}

}  // namespace

class StrayFilesTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { QCOMPARE(mkfifo(qPrintable(at("pipe.json")), 0600), 0); }

    void pipesAndDevicesAreRefused_data() {
        QTest::addColumn<QString>("file");
        QTest::newRow("a pipe") << at("pipe.json");
        QTest::newRow("an endless device") << "/dev/zero";
        QVERIFY(QFile::link("/dev/zero", at("zero.json")));
        QTest::newRow("a link to one") << at("zero.json");
    }
    void pipesAndDevicesAreRefused() {
        QFETCH(QString, file);
        const QString said = "is not a regular file";
        const Answer scene = runProgram({"check", file});
        QCOMPARE(scene.code, 2);
        QVERIFY2(scene.err.contains(said), qPrintable(scene.err));
        const Answer wisdom = with("EXTREMAL_WISDOM", file, {"check", "preset:pendulum"});
        QCOMPARE(wisdom.code, 2);
        QVERIFY2(wisdom.err.contains(said), qPrintable(wisdom.err));
        const Answer catalogue =
            with("EXTREMAL_SCHEMES", file, {"check", "preset:pendulum", "--add", "mine"});
        QCOMPARE(catalogue.code, 2);
        QVERIFY2(catalogue.err.contains(said), qPrintable(catalogue.err));
        if (!file.endsWith(".json")) return;  // others are names
        const Answer added = runProgram({"check", "preset:pendulum", "--add", file});
        QCOMPARE(added.code, 2);
        QVERIFY2(added.err.contains(said), qPrintable(added.err));
    }

    void pipesAmongResultsAreNotReadOn() {
        const QString folder = at("resumed");
        const QStringList run{"run", "preset:pendulum", "--quiet", "--out", folder, "--resume"};
        QCOMPARE(runProgram({"run", "preset:pendulum", "--quiet", "--out", folder}).code, 0);
        for (const QString& name : QDir(folder).entryList({"*.csv"}, QDir::Files)) {
            const QString checkpoint = folder + "/" + name.chopped(4) + ".checkpoint";
            QCOMPARE(mkfifo(qPrintable(checkpoint), 0600), 0);
        }
        QCOMPARE(runProgram(run).code, 0);
    }

    void foldersThatCannotBeAreNamed_data() {
        QTest::addColumn<QString>("folder");
        QVERIFY(QFile::link(at("a"), at("b")) && QFile::link(at("b"), at("a")));
        QTest::newRow("links in a circle") << at("a");
        QTest::newRow("below links in a circle") << at("a/inside");
        QTest::newRow("a name that is too long") << at(QString(300, 'x'));
        QTest::newRow("a path that is too long") << at(QString("x/").repeated(3000));
    }
    void foldersThatCannotBeAreNamed() {
        QFETCH(QString, folder);
        for (const QStringList& verb : {QStringList{"run", "preset:pendulum", "--out", folder},
                                        {"study", "convergence", "preset:pendulum", "--out", folder},
                                        {"atlas", "--out", folder, "--only", "nothing"},
                                        {"passport", "preset:pendulum", "--out", folder + "/p.html"},
                                        {"snapshot", "preset:pendulum", "--out", folder + "/p.png"},
                                        {"wisdom", "--modes", "8", "--out", folder + "/w"}}) {
            const Answer answer = runProgram(verb + QStringList{"--quiet"});
            QVERIFY2(answer.code == 3 || verb.first() == "atlas",
                     qPrintable(verb.first() + QString(" %1: ").arg(answer.code) + answer.err));
            QVERIFY2(!answer.err.contains("internal error"), qPrintable(verb.first() + ": " + answer.err));
        }
    }

    void aTerminalThatIsClosedKeepsTheResults() {
        const QString folder = at("hung-up");
        QProcess process;
        process.start(QStringLiteral(EXTREMAL_BINARY),
                      {"run", "preset:pendulum", "--set", "/time/end=1e9", "--set", "/limits/steps=1e11",
                       "--set", "/output/every=1e6", "--set", "/reference=none", "--out", folder});
        // The folder is there before a run begins, and signals are watched before that.
        QTRY_VERIFY_WITH_TIMEOUT(QDir(folder).exists(), tests::limit(30000));
        ::kill(static_cast<pid_t>(process.processId()), SIGHUP);
        QVERIFY(process.waitForFinished(tests::limit(30000)));
        QCOMPARE(process.exitStatus(), QProcess::NormalExit);
        QCOMPARE(process.exitCode(), 130);
        QVERIFY(contentOf(folder + "/summary.csv").contains("partial,stopped"));
    }

    void listsOfProblemsHaveAnEnd() {
        QByteArray schemes;
        for (int i = 0; i < 400; ++i)
            schemes += QByteArray(i ? "," : "") + "{\"label\": \"s" + QByteArray::number(i) +
                       "\", \"scheme\": \"nothing\", \"step\": 0.1}";
        put(at("faulty.json"),
            "{\"extremal\": 1, \"model\": \"pendulum\", \"time\": {\"end\": 1}, \"schemes\": [" + schemes +
                "]}");
        const Answer text = runProgram({"check", at("faulty.json"), "--quiet"});
        QCOMPARE(text.code, 2);
        const QStringList lines = text.err.split('\n', Qt::SkipEmptyParts);
        QCOMPARE(lines.size(), 101);
        QVERIFY2(lines.last().endsWith("faulty.json: and 300 more"), qPrintable(lines.last()));
        const Answer json = runProgram({"check", at("faulty.json"), "--json"});
        const QJsonObject document = QJsonDocument::fromJson(json.out.toUtf8()).object();
        QCOMPARE(document["errors"].toArray().size(), 100);
        QCOMPARE(document["errors_left_out"].toInt(), 300);
        QVERIFY(!document.contains("warnings_left_out"));
    }

private:
    QString at(const QString& name) const { return folder_.filePath(name); }

    QTemporaryDir folder_;
};

EXTREMAL_TEST(StrayFilesTest)

}  // namespace extremal::stray_files_test

#include "stray_files_test.moc"
