// SPDX-License-Identifier: GPL-3.0-or-later
/// The command line run as a user runs it: arguments in; exit code, words and files out.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QRegularExpression>
#include <QTemporaryDir>
#include <QTest>

#include <csignal>
#include <unistd.h>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::command_line_test {

namespace {

using tests::Answer;

Answer extremal(const QStringList& arguments, const QByteArray& input = {}, const QString& outFile = {}) {
    return tests::runProgram(arguments, {input, outFile});
}

/// A short scene; `schemes` as JSON.
QByteArray scene(const QByteArray& schemes, const QByteArray& rest = "\"time\": { \"end\": 1 }") {
    return "{ \"extremal\": 1, \"model\": { \"type\": \"kepler\" }, \"initial\": { \"q\": [0.4, 0], \"p\": "
           "[0, 2] }, " +
           rest + ", \"schemes\": " + schemes + " }";
}

const QByteArray midpoint = "[{ \"label\": \"Midpoint A\", \"scheme\": \"midpoint\", \"step\": 0.1 }]";

/// The file without the values of cpu_seconds, in CSV and JSON alike.
QByteArray withoutClock(const QString& path) {
    QByteArray text = tests::contentOf(path);
    if (path.endsWith("summary.csv")) {
        QByteArrayList lines = text.split('\n');
        for (QByteArray& line : lines) {
            QByteArrayList cells = line.split(',');
            if (cells.size() > 10) cells[10].clear();
            line = cells.join(',');
        }
        return lines.join('\n');
    }
    return QString::fromUtf8(text).replace(QRegularExpression("\"cpu_seconds\": [^,]*"), "").toUtf8();
}

QStringList filesIn(const QString& folder) {
    return QDir(folder).entryList(QDir::Files | QDir::Hidden, QDir::Name);
}

/// What a process has worked so far, in ticks of a hundredth of a second (proc(5): stat, fields 14 and 15).
long long cpuTicks(qint64 process) {
    QFile file(QString("/proc/%1/stat").arg(process));
    if (!file.open(QIODevice::ReadOnly)) return 0;
    const QByteArray all = file.readAll();
    const QList<QByteArray> fields = all.mid(all.lastIndexOf(')') + 2).split(' ');
    return fields.value(11).toLongLong() + fields.value(12).toLongLong();
}

}  // namespace

class CommandLineTest : public QObject {
    Q_OBJECT
private slots:
    void runWritesWhatTheContractSays() {
        QTemporaryDir dir;
        const Answer a = extremal({"run", "-", "--out", dir.filePath("out")}, scene(midpoint));
        QCOMPARE(a.code, 0);
        QCOMPARE(a.err, QString());
        QVERIFY(a.out.contains("Midpoint A  done"));
        QCOMPARE(filesIn(dir.filePath("out")),
                 (QStringList{"midpoint-a.csv", "scene.json", "summary.csv", "summary.json"}));
        const QByteArrayList rows =
            tests::contentOf(dir.filePath("out/midpoint-a.csv")).trimmed().split('\n');
        QCOMPARE(rows.size(), 12);
        QCOMPARE(rows[0], QByteArray("t,q.x,q.y,p.x,p.y,energy,energy_error,error,error.p,error.x,error.y"));
        QVERIFY(rows[1].startsWith("0,0.4,0,0,2,"));
        QVERIFY(rows[11].startsWith("1,"));
    }

    void checkNamesThePagesThatExplain() {
        const QStringList near{"check", "preset:multiscale",     "--set", "/model/k=1e6",
                               "--set", "/schemes/0/step=0.2008"};
        const Answer a = extremal(near);
        QCOMPARE(a.code, 0);
        QVERIFY2(a.err.contains("explained in the handbook: multiscale#resonances"), qPrintable(a.err));
        const QJsonArray warnings =
            QJsonDocument::fromJson(extremal(near + QStringList{"--json"}).out.toUtf8())["warnings"]
                .toArray();
        QVERIFY(!warnings.isEmpty());
        QCOMPARE(warnings[0]["handbook"].toString(), QString("multiscale#resonances"));
        QVERIFY(!extremal({"check", "preset:kepler"}).err.contains("handbook"));
    }

    void handbookPrintsPagesAndSections() {
        const QString pages = extremal({"handbook"}).out;
        QVERIFY(pages.contains("multiscale") && pages.contains("A five-minute tour"));
        const Answer section = extremal({"handbook", "multiscale#resonances"});
        QCOMPARE(section.code, 0);
        QVERIFY(section.out.startsWith("## Resonances\n") && !section.out.contains("## The same in space"));
        QVERIFY(extremal({"handbook", "tour"}).out.size() > 1000);
        const Answer wrong = extremal({"handbook", "multiscale#resonance"});
        QCOMPARE(wrong.code, 2);
        QVERIFY2(wrong.err.contains("multiscale#resonances"), qPrintable(wrong.err));
        QCOMPARE(extremal({"handbook", "turo"}).code, 2);
    }

    void rerunningTheResolvedSceneGivesTheSameBytes() {
        QTemporaryDir dir;
        QCOMPARE(extremal({"run", "preset:spring-pendulum", "--set", "/time/end=1", "--quiet", "--out",
                           dir.filePath("a")})
                     .code,
                 0);
        const QString resolved = dir.filePath("a/scene.json");
        QCOMPARE(extremal({"run", resolved, "--quiet", "--threads", "1", "--out", dir.filePath("b")}).code,
                 0);
        QCOMPARE(extremal({"run", resolved, "--quiet", "--threads", "7", "--out", dir.filePath("c")}).code,
                 0);
        const QStringList files = filesIn(dir.filePath("a"));
        QCOMPARE(files.size(), 9);
        for (const char* other : {"b", "c"}) {
            QCOMPARE(filesIn(dir.filePath(other)), files);
            for (const QString& file : files)
                QVERIFY2(withoutClock(dir.filePath(QString(other) + "/" + file)) ==
                             withoutClock(dir.filePath("a/" + file)),
                         qPrintable(file));
        }
    }

    /// Addresses, which each process has others of, order the terms of GiNaC, and must not show.
    void processesAgreeOnTypedFormulas() {
        QTemporaryDir dir;
        QByteArray firstCsv, firstProgram;
        for (int i = 0; i < 6; ++i) {
            QCOMPARE(extremal({"run", "preset:characteristic-function", "--quiet", "--out", dir.path()}).code,
                     0);
            const QByteArray csv = tests::contentOf(dir.filePath("32-equal.csv"));
            QCOMPARE(
                extremal({"program", "preset:henon-heiles", "--quiet", "--out", dir.filePath("h.py")}).code,
                0);
            const QByteArray program = tests::contentOf(dir.filePath("h.py"));
            QVERIFY(!csv.isEmpty() && !program.isEmpty());
            if (i == 0) {
                firstCsv = csv;
                firstProgram = program;
            }
            QCOMPARE(csv, firstCsv);
            QCOMPARE(program, firstProgram);
        }
    }
    void jsonIsOneDocument() {
        QTemporaryDir dir;
        const Answer a = extremal({"run", "-", "--json", "--out", dir.path()}, scene(midpoint));
        QCOMPARE(a.code, 0);
        QCOMPARE(a.out.toUtf8(), tests::contentOf(dir.filePath("summary.json")));
        const QJsonObject check =
            QJsonDocument::fromJson(extremal({"check", "-", "--json"}, scene("[]")).out.toUtf8()).object();
        QCOMPARE(check["valid"].toBool(true), false);
        QCOMPARE(check["errors"].toArray()[0].toObject()["pointer"].toString(), QString("/schemes"));
        const QJsonObject all = QJsonDocument::fromJson(extremal({"list", "--json"}).out.toUtf8()).object();
        for (const char* kind : {"models", "spaces", "quadratures", "schemes", "baselines", "observables",
                                 "studies", "views", "profiles", "presets"})
            QVERIFY2(all[kind].isArray(), kind);
        const QJsonArray baselines =
            QJsonDocument::fromJson(extremal({"list", "baselines", "--json"}).out.toUtf8()).array();
        QVERIFY(baselines[0].toObject()["claims"].toObject()["order"].isDouble());
    }

    void schemesClaimWhatTheirDiscretizationsDoAtEachDegree() {
        const QJsonArray schemes =
            QJsonDocument::fromJson(extremal({"list", "schemes", "--json"}).out.toUtf8()).array();
        const auto entry = [&](const QString& id) {
            for (const QJsonValue& scheme : schemes)
                if (scheme.toObject()["id"] == id) return scheme.toObject();
            return QJsonObject();
        };
        const QJsonObject gauss = entry("galerkin-gauss-<s>"), curtis = entry("spectral-clenshaw-curtis-<s>");
        QCOMPARE(gauss["claims"].toObject()["order"].toInt(), 2);
        QCOMPARE(gauss["claims"].toObject()["order_formula"].toString(), QString("2s"));
        QCOMPARE(gauss["claims_by_degree"].toArray().size(), 8);
        QCOMPARE(gauss["claims_by_degree"].toArray()[2].toObject()["order"].toInt(), 6);
        // No formula holds for all of these.
        QVERIFY(!curtis["claims"].toObject().contains("order_formula"));
        QList<int> orders;
        for (int s = 1; s <= 5; ++s)
            orders << curtis["claims_by_degree"].toArray()[s - 1].toObject()["order"].toInt();
        QCOMPARE(orders, QList<int>({2, 4, 4, 6, 4}));
        QVERIFY(!entry("midpoint").contains("claims_by_degree"));
        QCOMPARE(entry("midpoint")["claims"].toObject()["order"].toInt(), 2);
    }

    void aFailedSchemeLeavesTheOthersAlone() {
        QTemporaryDir dir;
        const Answer a =
            extremal({"run", "-", "--out", dir.path(), "--json"},
                     scene("[{ \"label\": \"ok\", \"scheme\": \"midpoint\", \"step\": 0.1 },"
                           "{ \"label\": \"bad\", \"baseline\": \"stormer-verlet\", \"step\": 0.1 }]",
                           "\"reference\": \"none\", \"observe\": [\"energy\"], \"time\": { \"end\": 1 }")
                         .replace("\"q\": [0.4, 0]", "\"q\": [0, 0]"));
        QCOMPARE(a.code, 1);
        QVERIFY(a.err.contains("extremal: bad: failed at t = 0"));
        const QJsonArray schemes = QJsonDocument::fromJson(a.out.toUtf8()).object()["schemes"].toArray();
        QCOMPARE(schemes[1].toObject()["status"].toString(), QString("failed"));
        QVERIFY(!schemes[1].toObject()["cause"].toString().isEmpty());
        QVERIFY(schemes[1].toObject()["failed_at"].isDouble());
        QVERIFY(filesIn(dir.path()).contains("bad.csv"));
    }

    void badInputWritesNoFile_data() {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QByteArray>("input");
        QTest::addColumn<QString>("error");
        const QStringList standard{"run", "-"};
        const auto row = [](const char* what, const QStringList& arguments, const QByteArray& input,
                            const char* error) { QTest::newRow(what) << arguments << input << error; };
        row("negative step", standard, scene("[{ \"scheme\": \"midpoint\", \"step\": -0.1 }]"),
            "extremal: standard input:/schemes/0/step: must be a positive finite number, got -0.1\n");
        row("override", {"run", "-", "--set", "/schemes/*/step=0"}, scene(midpoint),
            "extremal: --set /schemes/*/step: must be a positive finite number, got 0\n");
        row("unknown override", {"run", "-", "--set", "/tume/end=1"}, scene(midpoint),
            "extremal: --set /tume/end: unknown key \"tume\" (did you mean \"time\"?)\n");
        row("override without a value", {"run", "-", "--set", "/time/end"}, scene(midpoint),
            "extremal: --set /time/end: has no value (write --set POINTER=VALUE)\n");
        row("10^12 steps", standard, scene("[{ \"scheme\": \"midpoint\", \"step\": 1e-12 }]"),
            "/schemes/0/step: needs 1e+12 steps from 0 to 1, the limit is 1e+11");
        row("caret", standard, scene("[{ \"scheme\": \"midpoint\", \"step\": \"1/nu\" }]"),
            "\n    1/nu\n      ^\n");
        row("malformed", standard, "{", "extremal: standard input: is not JSON: ");
        row("a million brackets", standard, QByteArray(1000000, '['), "nested deeper than 200");
        row("missing file", {"run", "nowhere.json"}, "", "extremal: nowhere.json: there is no such file");
        row("folder", {"run", "/"}, "", "extremal: /: is a folder");
        row("device", {"run", "/dev/zero"}, "", "extremal: /dev/zero: is not a regular file");
        row("preset", {"run", "preset:keppler"}, "", "(did you mean \"kepler\"?)");
        row("reference file", standard,
            scene(midpoint,
                  "\"time\": { \"end\": 1 }, \"reference\": "
                  "{ \"type\": \"file\", \"path\": \"" EXTREMAL_SOURCE_DIR "/LICENSE\" }"),
            "extremal: standard input:/reference");
        row("threads", {"run", "-", "--threads", "0"}, scene(midpoint), "--threads");
    }
    void badInputWritesNoFile() {
        QFETCH(QStringList, arguments);
        QFETCH(QByteArray, input);
        QFETCH(QString, error);
        QTemporaryDir dir;
        const Answer a = extremal(arguments + QStringList{"--out", dir.filePath("out")}, input);
        QCOMPARE(a.code, 2);
        QVERIFY2(a.err.contains(error), qPrintable(a.err));
        QVERIFY(a.out.isEmpty());
        QVERIFY(!QFileInfo::exists(dir.filePath("out")));
    }

    void badArgumentsAreNamed_data() {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("error");
        QTest::newRow("verb") << QStringList{"rum", "preset:kepler"}
                              << "unknown verb \"rum\" (did you mean \"run\"?)";
        QTest::newRow("no out") << QStringList{"run", "preset:kepler"} << "--out";
        QTest::newRow("option") << QStringList{"check", "preset:kepler", "--ste", "/a=1"} << "--ste";
        QTest::newRow("kind") << QStringList{"list", "model"}
                              << "unknown kind \"model\" (did you mean \"models\"?)";
    }
    void badArgumentsAreNamed() {
        QFETCH(QStringList, arguments);
        QFETCH(QString, error);
        const Answer a = extremal(arguments);
        QCOMPARE(a.code, 2);
        QVERIFY2(a.err.startsWith("extremal: ") && a.err.contains(error), qPrintable(a.err));
    }

    void unreadableAndUnwritablePathsAreTold() {
        QTemporaryDir dir;
        QFile file(dir.filePath("scene.json"));
        QVERIFY(file.open(QIODevice::WriteOnly));
        file.write(scene(midpoint));
        file.close();
        // A file stands where the folder should be; root may write anywhere else.
        Answer a = extremal({"run", file.fileName(), "--out", file.fileName() + "/out"});
        QCOMPARE(a.code, 3);
        QVERIFY2(a.err.contains("cannot be written: Not a directory"), qPrintable(a.err));
        a = extremal({"list"}, {}, "/dev/full");
        QCOMPARE(a.code, 3);
        QVERIFY2(a.err.contains("standard output: cannot be written: No space left on device"),
                 qPrintable(a.err));
        if (::geteuid() == 0) return;
        file.setPermissions({});
        a = extremal({"check", file.fileName()});
        QCOMPARE(a.code, 2);
        QVERIFY2(a.err.contains("cannot be opened: Permission denied"), qPrintable(a.err));
    }

    void interruptingKeepsWhatIsFinished() {
        QTemporaryDir dir;
        QProcess process;
        process.start(QStringLiteral(EXTREMAL_BINARY), {"run", "-", "--out", dir.path()});
        process.write(
            scene("[{ \"label\": \"short\", \"baseline\": \"rk4\", \"step\": 0.05 },"
                  "{ \"label\": \"long\", \"scheme\": \"midpoint\", \"step\": 1e-7 }]",
                  "\"reference\": \"none\", \"observe\": [\"energy\"], \"time\": { \"end\": 1000 }"));
        process.closeWriteChannel();
        QVERIFY(process.waitForStarted());
        // Half a second of work: the short scheme is done by then, the long one needs an hour.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
        constexpr long long ticks = 1500;  // the start of the program alone takes seconds
#else
        constexpr long long ticks = 50;
#endif
        QTRY_VERIFY_WITH_TIMEOUT(cpuTicks(process.processId()) > ticks, 120000);
        ::kill(static_cast<pid_t>(process.processId()), SIGINT);
        QVERIFY(process.waitForFinished(tests::limit(30000)));
        QCOMPARE(process.exitStatus(), QProcess::NormalExit);
        QCOMPARE(process.exitCode(), 130);
        QVERIFY(process.readAllStandardError().contains("interrupted: the results are partial"));
        const QByteArray summary = tests::contentOf(dir.filePath("summary.csv"));
        QVERIFY2(summary.contains("short,done,,") && summary.contains("long,partial,stopped,"),
                 summary.constData());
        QVERIFY(tests::contentOf(dir.filePath("long.csv")).count('\n') > 2);
    }

    void aWindowWithoutADisplayNamesTheVerbsThatNeedNone() {
        for (const char* display : {"", ":987"}) {
            QProcess process;
            QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
            for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
                environment.remove(name);
            if (*display) environment.insert("DISPLAY", display);
            process.setProcessEnvironment(environment);
            process.start(QStringLiteral(EXTREMAL_BINARY), {"preset:kepler"});
            QVERIFY(process.waitForFinished(tests::limit(20000)));
            QCOMPARE(process.exitStatus(), QProcess::NormalExit);
            QCOMPARE(process.exitCode(), 2);
            const QByteArray said = process.readAllStandardError();
            QVERIFY2(said.contains("extremal run") && said.contains("snapshot"), said.constData());
        }
    }

    void helpAndVersionGoToStandardOutput() {
        QCOMPARE(extremal({"--version"}).code, 0);
        QVERIFY(extremal({"--version"}).out.startsWith("extremal "));
        for (const QStringList& arguments :
             {QStringList{"--help"}, {"run", "--help"}, {"snapshot", "--help"}}) {
            const Answer a = extremal(arguments);
            QCOMPARE(a.code, 0);
            QVERIFY(a.err.isEmpty() && a.out.contains("--set"));
        }
    }
    void theWindowSaysInTheTerminalWhatItCannotOpen() {
        for (const char* scene : {"/no/such/file.json", "preset:typo"}) {
            QProcess process;
            QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
            environment.insert("QT_QPA_PLATFORM", "offscreen");
            process.setProcessEnvironment(environment);
            process.start(QStringLiteral(EXTREMAL_BINARY), {scene});
            process.setReadChannel(QProcess::StandardError);
            QByteArray said;
            while (!said.contains(scene) && process.waitForReadyRead(tests::limit(30000)))
                said += process.readAllStandardError();
            QVERIFY2(said.contains("extremal: ") && said.contains(scene), said.constData());
            QCOMPARE(process.state(), QProcess::Running);  // the start page is there
            process.terminate();
            QVERIFY(process.waitForFinished(tests::limit(30000)));
        }
    }
};

EXTREMAL_TEST(CommandLineTest)
}  // namespace extremal::command_line_test

#include "command_line_test.moc"
