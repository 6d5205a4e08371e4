// SPDX-License-Identifier: GPL-3.0-or-later
/// The program in surroundings that fail: killed at any moment, output that vanishes, two of it in one
/// folder, and machines without what is usually there.
#include <QDir>
#include <QElapsedTimer>
#include <QJsonDocument>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>
#include <boost/crc.hpp>
#include <cmath>
#include <csignal>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::faults_test {
namespace {

using tests::Answer;
using tests::contentOf;
using tests::runProgram;

/// Without a reference: how far that is confirmed is a question of processor time, and two runs of a slow
/// build may say different things of it.
const QStringList scene = {"run",  "preset:spring-pendulum", "--set", "/reference=\"none\"", "--quiet",
                           "--out"};

/// Whether the bytes of a checkpoint are those that were written: a line of JSON that says whose they are,
/// a line with the CRC-32 of the others, and these.
bool isWholeCheckpoint(const QByteArray& bytes) {
    const auto first = bytes.indexOf('\n'), second = bytes.indexOf('\n', first + 1);
    if (first < 0 || second < 0 || QJsonDocument::fromJson(bytes.left(first)).isNull()) return false;
    const QByteArray rest = bytes.mid(second + 1);
    boost::crc_32_type crc;
    crc.process_bytes(rest.constData(), static_cast<std::size_t>(rest.size()));
    return bytes.mid(first + 1, second - first - 1).toUInt(nullptr, 16) == crc.checksum();
}

/// What is wrong with the files of a run, next to those of a whole one: a file must be whole, or not be
/// there. Those that name processor times have as many lines as the whole ones; checkpoints, which a run that
/// ended does not have, are compared with their checksum.
QString faultOf(const QDir& folder, const QDir& whole) {
    for (const QString& name : folder.entryList(QDir::Files)) {
        const QByteArray here = contentOf(folder.filePath(name));
        if (name.endsWith(".checkpoint")) {
            if (!isWholeCheckpoint(here)) return name + " is not whole";
            continue;
        }
        const QByteArray there = contentOf(whole.filePath(name));
        if (name == "summary.json" && QJsonDocument::fromJson(here).isNull())
            return name + " is not a document";
        const bool hasTimes = name.startsWith("summary.");
        if (hasTimes ? here.count('\n') != there.count('\n') || !here.endsWith('\n') : here != there)
            return name + " is not whole";
    }
    return {};
}

}  // namespace

class FaultsTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        QElapsedTimer timer;
        timer.start();
        QCOMPARE(runProgram(scene + QStringList{whole()}).code, 0);
        duration_ = timer.elapsed();
        QCOMPARE(QDir(whole()).entryList(QDir::Files).size(), 9);
        QCOMPARE(faultOf(whole(), whole()), "");
    }

    void killedAtAnyMomentFilesAreWholeOrAbsent() {
        int killed = 0, withCheckpoints = 0;
        double part = 0;  // of the shortest run so far
        for (int i = 0; i < 200 && killed < 50; ++i) {
            const QString folder = folder_.filePath("killed");
            QDir(folder).removeRecursively();
            QElapsedTimer timer;
            timer.start();
            QProcess process;
            process.start(QStringLiteral(EXTREMAL_BINARY),
                          scene + QStringList{folder, "--checkpoint", "0.001"});
            QVERIFY(process.waitForStarted());
            part = std::fmod(part + 0.381966, 1);  // the golden section: moments spread evenly
            if (process.waitForFinished(static_cast<int>(part * static_cast<double>(duration_)))) {
                duration_ = std::min(duration_, timer.elapsed());
            } else {
                ::kill(static_cast<pid_t>(process.processId()), SIGKILL);
                ++killed;
                process.waitForFinished();
            }
            QCOMPARE(faultOf(folder, whole()), "");
            withCheckpoints += !QDir(folder).entryList({"*.checkpoint"}).isEmpty();
        }
        QCOMPARE(killed, 50);
        QVERIFY(withCheckpoints > 0);
        // What was left behind does not stand in the way.
        QCOMPARE(runProgram(scene + QStringList{folder_.filePath("killed")}).code, 0);
        QCOMPARE(faultOf(folder_.filePath("killed"), whole()), "");
    }

    void killedAtAnyMomentARunIsResumed() {
        const QStringList longer = scene.mid(0, 2) + QStringList{"--set", "/time/end=20"} + scene.mid(2);
        const QDir unbroken(folder_.filePath("unbroken"));
        QElapsedTimer timer;
        timer.start();
        QCOMPARE(runProgram(longer + QStringList{unbroken.path()}).code, 0);
        const auto duration = static_cast<double>(timer.elapsed());
        int killed = 0, resumed = 0;
        double part = 0;
        for (int i = 0; i < 200 && killed < 50; ++i) {
            const QDir folder(folder_.filePath("resumed"));
            QDir(folder).removeRecursively();
            part = std::fmod(part + 0.381966, 1);
            QProcess process;
            process.start(QStringLiteral(EXTREMAL_BINARY),
                          longer + QStringList{folder.path(), "--checkpoint", "0.001"});
            QVERIFY(process.waitForStarted());
            if (!process.waitForFinished(static_cast<int>(part * duration))) {
                ::kill(static_cast<pid_t>(process.processId()), SIGKILL);
                process.waitForFinished();
                ++killed;
            }
            resumed += !folder.entryList({"*.checkpoint"}, QDir::Files).isEmpty();
            const Answer answer = runProgram(longer + QStringList{folder.path(), "--resume"});
            QVERIFY2(answer.code == 0, qPrintable(answer.err));
            QCOMPARE(faultOf(folder, unbroken), "");
            QCOMPARE(folder.entryList(QDir::Files), unbroken.entryList(QDir::Files));
        }
        qInfo("%d killed, %d of them with checkpoints", killed, resumed);
        QCOMPARE(killed, 50);
        QVERIFY(resumed >= 5);
    }

    void aCheckpointOfAnotherSceneIsAnError() {
        const QString folder = folder_.filePath("other");
        QProcess process;
        process.start(QStringLiteral(EXTREMAL_BINARY),
                      {"run", "preset:spring-pendulum", "--set", "/time/end=600", "--quiet", "--out", folder,
                       "--checkpoint", "0.001"});
        QVERIFY(process.waitForStarted());
        QTRY_VERIFY_WITH_TIMEOUT(!QDir(folder).entryList({"*.checkpoint"}).isEmpty(), tests::limit(30000));
        ::kill(static_cast<pid_t>(process.processId()), SIGINT);
        QVERIFY(process.waitForFinished(tests::limit(30000)));
        QCOMPARE(process.exitCode(), 130);
        const QString said = QString::fromUtf8(process.readAllStandardError());
        QVERIFY2(said.contains("--resume goes on"), qPrintable(said));
        const Answer answer = runProgram(scene + QStringList{folder, "--resume"});
        QCOMPARE(answer.code, 2);
        QVERIFY2(answer.err.contains("--resume: ") && answer.err.contains("another scene"),
                 qPrintable(answer.err));
    }

    void aFileThatIsNotWholeIsFound() {
        const QString folder = folder_.filePath("cut");
        QVERIFY(QDir().mkpath(folder));
        const auto write = [&](const QString& name, const QByteArray& bytes) {
            QFile file(QDir(folder).filePath(name));
            return file.open(QFile::WriteOnly) && file.write(bytes) == bytes.size();
        };
        const QByteArray bytes = contentOf(QDir(whole()).filePath("midpoint.csv"));
        QVERIFY(write("midpoint.csv", bytes.left(bytes.size() / 2)));
        QCOMPARE(faultOf(folder, whole()), "midpoint.csv is not whole");
        QVERIFY(write("midpoint.csv", bytes));
        QVERIFY(write("midpoint.checkpoint", "{}\ncbf43926\n123456789"));  // the check value of CRC-32
        QCOMPARE(faultOf(folder, whole()), "");
        QVERIFY(write("midpoint.checkpoint", "{}\ncbf43926\n12345678"));
        QCOMPARE(faultOf(folder, whole()), "midpoint.checkpoint is not whole");
    }

    void twoInOneFolder() {
        const QString folder = folder_.filePath("two");
        QProcess other;
        other.start(QStringLiteral(EXTREMAL_BINARY), scene + QStringList{folder});
        QVERIFY(other.waitForStarted());
        QCOMPARE(runProgram(scene + QStringList{folder}).code, 0);
        QVERIFY(other.waitForFinished(tests::limit(30000)));
        QCOMPARE(other.exitCode(), 0);
        QCOMPARE(faultOf(folder, whole()), "");
        QCOMPARE(QDir(folder).entryList(QDir::Files | QDir::Hidden).size(), 9);
    }

    void aFolderThatVanishesIsMadeAgain() {
        const QString folder = folder_.filePath("vanished");
        QProcess process;
        process.start(QStringLiteral(EXTREMAL_BINARY), scene + QStringList{folder, "--set", "/time/end=600"});
        QVERIFY(process.waitForStarted());
        QTRY_VERIFY(QDir(folder).exists());
        QVERIFY(QDir(folder).removeRecursively());
        QVERIFY(process.waitForFinished(tests::limit(60000)));
        QCOMPARE(process.exitCode(), 0);
        QCOMPARE(QDir(folder).entryList(QDir::Files).size(), 9);
    }

    void withoutAHomeAndInAnotherLocale() {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.remove("HOME");
        for (const char* name : {"LC_ALL", "LANG", "LC_NUMERIC"}) environment.insert(name, "de_DE.UTF-8");
        const QString folder = folder_.filePath("elsewhere");
        QCOMPARE(runProgram(scene + QStringList{folder}, {{}, {}, environment}).code, 0);
        QCOMPARE(QDir(folder).entryList(QDir::Files).size(), 9);
        QCOMPARE(faultOf(folder, whole()), "");
    }

    void withoutFonts() {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert("FONTCONFIG_FILE", "/dev/null");
        environment.insert("QT_QPA_PLATFORM", "offscreen");
        const QString file = folder_.filePath("picture.png");
        QCOMPARE(runProgram({"snapshot", "preset:pendulum", "--out", file}, {{}, {}, environment}).code, 0);
        QVERIFY(contentOf(file).startsWith("\x89PNG"));
    }

    void anOutputThatIsClosedIsAnError() {
        const Answer answer =
            runProgram({"list", "models"}, {{}, "/dev/full", QProcessEnvironment::systemEnvironment()});
        QCOMPARE(answer.code, 3);
        QVERIFY2(answer.err.contains("cannot be written"), qPrintable(answer.err));
    }

private:
    QString whole() const { return folder_.filePath("whole"); }

    QTemporaryDir folder_;
    qint64 duration_ = 0;
};

EXTREMAL_TEST(FaultsTest)

}  // namespace extremal::faults_test

#include "faults_test.moc"
