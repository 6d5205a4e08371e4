// SPDX-License-Identifier: GPL-3.0-or-later
/// `extremal study` as a user runs it: files, words and exit codes; killed and resumed, split and merged.
#include <QDir>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QTemporaryDir>
#include <QRegularExpression>
#include <QTest>

#include <cmath>
#include <csignal>
#include <unistd.h>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::study_test {
namespace {

using tests::Answer;

const QByteArray scene = R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},
    "time":{"end":3},"schemes":[{"label":"SV","step":0.05,"baseline":"stormer-verlet"},
    {"label":"Galerkin 4","step":0.1,"scheme":"galerkin-gauss-2"}]})";

Answer study(const QStringList& arguments, const QByteArray& input = scene) {
    return tests::runProgram(QStringList{"study"} + arguments, {input, {}});
}

/// The columns of a CSV by their names, without those that come from the clock.
QList<QByteArrayList> cellsOf(const QString& path) {
    QList<QByteArrayList> rows;
    QList<int> clock;
    for (const QByteArray& line : tests::contentOf(path).trimmed().split('\n')) {
        QByteArrayList cells = line.split(',');
        if (rows.isEmpty())
            for (const char* name : {"pareto", "cpu_spread", "cpu_seconds"})
                if (const auto at = cells.indexOf(name); at >= 0) clock.append(static_cast<int>(at));
        for (const int at : clock) cells.removeAt(at);
        rows.append(cells);
    }
    return rows;
}

}  // namespace

class StudyTest : public QObject {
    Q_OBJECT
private slots:
    void aStudyWritesWhatTheContractSays() {
        const QTemporaryDir dir;
        const Answer a = study({"convergence", "-", "--out", dir.filePath("out"), "--repeat", "1"});
        QCOMPARE(a.code, 0);
        static const QRegularExpression time("^this takes about [^\n]*\n");  // said where it is long
        QCOMPARE(QString(a.err).remove(time), QString());
        QVERIFY2(a.out.contains("Galerkin 4") && a.out.contains("claimed"), qPrintable(a.out));
        QCOMPARE(QDir(dir.filePath("out")).entryList(QDir::Files | QDir::Hidden, QDir::Name),
                 (QStringList{"convergence.csv", "convergence.log", "convergence.png", "convergence.svg",
                              "scene.json"}));
        const QByteArray csv = tests::contentOf(dir.filePath("out/convergence.csv"));
        QVERIFY(csv.startsWith(
            "label,step,tolerance,error,status,cause,order,r2,order_claimed,fit_from,fit_to\nSV,"));
        QVERIFY(csv.count('\n') > 12);
        const Answer b =
            study({"work-precision", "-", "--out", dir.filePath("b"), "--json", "--no-plot", "--steps",
                   "0.1,0.05", "--only", "SV", "--metric", "energy", "--final", "--repeat", "2"});
        QCOMPARE(b.code, 0);
        const QJsonObject document = QJsonDocument::fromJson(b.out.toUtf8()).object();
        QVERIFY(document["complete"].toBool());
        const QJsonArray rows = document["rows"].toArray();
        QCOMPARE(rows.size(), 2);
        QCOMPARE(rows[0].toObject()["label"].toString(), "SV");
        QVERIFY(rows[0].toObject()["cpu_seconds"].toDouble() > 0);
        QCOMPARE(rows[0].toObject()["pareto"].toBool() || rows[1].toObject()["pareto"].toBool(), true);
        QVERIFY(!QFile::exists(dir.filePath("b/work-precision.png")));
    }
    void misuseSaysWhere() {
        const QTemporaryDir dir;
        const QStringList out{"--out", dir.filePath("out")};
        const auto error = [&](const QStringList& arguments) {
            const Answer a = study(arguments + out);
            return a.code == 2 ? a.err.trimmed() : QString("exit %1").arg(a.code);
        };
        QCOMPARE(error({"convergance", "-"}),
                 "extremal: arguments: there is no study \"convergance\" (did you mean \"convergence\"?)");
        QVERIFY(error({"convergence", "-", "--metric", "norm"}).startsWith("extremal: --metric: "));
        QVERIFY(error({"convergence", "-", "--only", "SW"}).contains("did you mean \"SV\"?"));
        QVERIFY(error({"convergence", "-", "--shard", "3/2"}).startsWith("extremal: --shard: "));
        QVERIFY(error({"convergence", "-", "--steps", "0.1,-2"}).startsWith("extremal: --steps: "));
        QVERIFY(error({"convergence", "-", "--points", "5"}).startsWith("extremal: --points: "));
        QVERIFY(error({"convergence", "a", "b"}).contains("arguments"));
        QVERIFY(error({"merge", dir.path()}).contains("has no log"));
        QVERIFY(!QDir(dir.filePath("out")).exists());  // nothing is half done
    }
    void theCheapestReachesTheError() {
        const QTemporaryDir dir;
        const Answer a = study({"cheapest", "-", "--error", "1e-4", "--json", "--out", dir.filePath("out")});
        QCOMPARE(a.code, 0);
        const QJsonArray rows = QJsonDocument::fromJson(a.out.toUtf8()).object()["rows"].toArray();
        QCOMPARE(rows.size(), 2);
        for (int i = 0; i < 2; ++i) {
            QCOMPARE(rows[i].toObject()["rank"].toInt(), i + 1);
            QVERIFY(rows[i].toObject()["error"].toDouble() <= 1e-4);
        }
        QVERIFY(rows[0].toObject()["cpu_seconds"].toDouble() <= rows[1].toObject()["cpu_seconds"].toDouble());
        const Answer never = study({"cheapest", "-", "--error", "1e-30", "--only", "Galerkin 4", "--repeat",
                                    "0", "--quiet", "--out", dir.filePath("never")});
        QCOMPARE(never.code, 1);
        QVERIFY2(never.err.startsWith("extremal: --error: no scheme reaches 1e-30 (the nearest: Galerkin 4"),
                 qPrintable(never.err));
        QCOMPARE(study({"cheapest", "-", "--out", dir.filePath("none")}).code, 2);
    }
    void stabilityFindsTheLimit() {
        const QTemporaryDir dir;
        const QByteArray oscillator = R"({"extremal":1,"model":{"type":"harmonic-oscillator","m":1,"k":1},
            "initial":{"q":[1],"p":[0]},"time":{"end":2000},
            "schemes":[{"label":"SV","step":0.1,"baseline":"stormer-verlet"}]})";
        const Answer a = study({"stability", "-", "--x", "/schemes/*/step=1:3:5", "--limit", "--json",
                                "--out", dir.filePath("out")},
                               oscillator);
        QCOMPARE(a.code, 0);
        const QJsonObject document = QJsonDocument::fromJson(a.out.toUtf8()).object();
        QCOMPARE(document["rows"].toArray().size(), 5);
        const QJsonObject limit = document["stability-limits"].toArray()[0].toObject();
        QVERIFY(std::abs(limit["limit"].toDouble() - 2) < 1e-3);
        QVERIFY(tests::contentOf(dir.filePath("out/stability.csv"))
                    .startsWith(
                        "label,x,y,class,growth,max_energy_error,failed_at,cause,judgement\nSV,1,,stable,"));
        QVERIFY(QFile::exists(dir.filePath("out/stability.png")));
        const auto error = [&](const QStringList& more) {
            return study(QStringList{"stability", "-", "--out", dir.filePath("no")} + more, oscillator).err;
        };
        QVERIFY(error({}).startsWith("extremal: --x: is required"));
        QVERIFY(error({"--x", "/model/kk=1:2:3"}).startsWith("extremal: --x: "));
        QVERIFY(error({"--x", "/model/k=1:2:3", "--error", "1"}).startsWith("extremal: --error: "));
    }
    void shardsMergeIntoTheWhole() {
        const QTemporaryDir dir;
        const auto run = [&](const QString& out, const QStringList& more) {
            const Answer a = study(QStringList{"work-precision", "-", "--no-plot", "--repeat", "1", "--quiet",
                                               "--out", dir.filePath(out)} +
                                   more);
            QCOMPARE(a.code, 0);
        };
        run("whole", {});
        run("1", {"--shard", "1/2"});
        run("2", {"--shard", "2/2", "--threads", "1"});
        const auto merge = [&](const QStringList& folders) {
            QStringList arguments{"merge"};
            for (const QString& folder : folders) arguments << dir.filePath(folder);
            return study(arguments + QStringList{"--out", dir.filePath("merged"), "--no-plot"});
        };
        QVERIFY(merge({"1"}).code == 2 && merge({"1"}).err.contains("are missing"));
        QVERIFY(merge({"1", "2", "1"}).err.contains("both have point"));
        QCOMPARE(merge({"1", "2"}).code, 0);
        QCOMPARE(cellsOf(dir.filePath("merged/work-precision.csv")),
                 cellsOf(dir.filePath("whole/work-precision.csv")));
        const Answer other = study({"work-precision", "-", "--no-plot", "--repeat", "1", "--quiet", "--shard",
                                    "2/2", "--metric", "energy", "--out", dir.filePath("2")});
        QCOMPARE(other.code, 0);
        QVERIFY(merge({"1", "2"}).err.contains("another study, scene or option"));
    }
    /// As the handbook has it, by a tool that starts one process per shard.
    void shardsRunSideBySide() {
        const QTemporaryDir dir;
        QFile file(dir.filePath("scene.json"));
        QVERIFY(file.open(QIODevice::WriteOnly) && file.write(scene) == scene.size());
        file.close();
        QProcess shell;
        shell.setWorkingDirectory(dir.path());
        shell.start("sh", {"-c", QStringLiteral("printf '1\\n2\\n' | xargs -P 2 -I{} ") + EXTREMAL_BINARY +
                                     " study convergence scene.json --threads 1 --repeat 0 --no-plot --quiet "
                                     "--shard {}/2 --out part{}"});
        QVERIFY(shell.waitForFinished(tests::limit(60000)));
        QCOMPARE(shell.exitCode(), 0);
        const QStringList quietly{"--quiet", "--no-plot", "--out"};
        QCOMPARE(study(QStringList{"merge", dir.filePath("part1"), dir.filePath("part2")} + quietly +
                       QStringList{dir.filePath("merged")})
                     .code,
                 0);
        QCOMPARE(study(QStringList{"convergence", "-", "--repeat", "0"} + quietly +
                       QStringList{dir.filePath("whole")})
                     .code,
                 0);
        const QByteArray whole = tests::contentOf(dir.filePath("whole/convergence.csv"));
        QVERIFY(whole.count('\n') > 10);
        QCOMPARE(tests::contentOf(dir.filePath("merged/convergence.csv")), whole);
    }
    void aKilledStudyGoesOn() {
        const QTemporaryDir dir;
        QByteArray longScene = scene;
        longScene.replace("\"end\":3", "\"end\":300");
        const QStringList arguments{"convergence", "-",        "--no-plot", "--repeat", "0",
                                    "--threads",   "1",        "--from",    "0.1",      "--to",
                                    "0.002",       "--points", "40"};
        QProcess process;
        process.start(EXTREMAL_BINARY,
                      QStringList{"study"} + arguments + QStringList{"--out", dir.filePath("cut")});
        process.write(longScene);
        process.closeWriteChannel();
        const QString log = dir.filePath("cut/convergence.log");
        QTRY_VERIFY_WITH_TIMEOUT(tests::contentOf(log).count('\n') >= 6, tests::limit(60000));
        ::kill(static_cast<pid_t>(process.processId()), SIGKILL);
        process.waitForFinished();
        const auto before = tests::contentOf(log).count("point,");
        QVERIFY(!QFile::exists(dir.filePath("cut/convergence.csv")));

        QCOMPARE(study(arguments + QStringList{"--out", dir.filePath("cut"), "--resume"}, longScene).code, 0);
        QCOMPARE(study(arguments + QStringList{"--out", dir.filePath("whole")}, longScene).code, 0);
        QCOMPARE(tests::contentOf(dir.filePath("cut/convergence.csv")),
                 tests::contentOf(dir.filePath("whole/convergence.csv")));
        QVERIFY(before > 0 && tests::contentOf(log).count("point,") == 80);  // none was computed twice
    }
};

EXTREMAL_TEST(StudyTest)
}  // namespace extremal::study_test
#include "study_test.moc"
