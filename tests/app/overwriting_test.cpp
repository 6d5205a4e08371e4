// SPDX-License-Identifier: GPL-3.0-or-later
/// Nothing is written over unasked: no verb replaces what it has read, and files that the program has not
/// made are replaced only with --force; what an earlier run has left is replaced as ever.
#include <QDir>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::overwriting_test {
namespace {

using tests::Answer;
using tests::contentOf;

const QByteArray scene = R"({"extremal": 1, "title": "mine", "lesson": "mine",
    "model": {"type": "pendulum"}, "initial": {"q": [1]}, "time": {"end": 1},
    "schemes": [{"label": "A", "scheme": "midpoint", "step": 0.1}],
    "observe": ["energy"], "views": ["energy"]})";
const QByteArray notMine = "a text of the user\n";

QStringList words(const QString& text) { return text.split(' ', Qt::SkipEmptyParts); }

}  // namespace

class OverwritingTest : public QObject {
    Q_OBJECT
private slots:
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        write("s.json", scene);
    }

    void whatIsReadIsNeverReplaced_data() {
        QTest::addColumn<QString>("before");
        QTest::addColumn<QString>("input");
        QTest::addColumn<QString>("call");
        const auto row = [](const char* before, const char* input, const char* call) {
            QTest::newRow(call) << before << input << call;
        };
        row("cp s.json scene.json", "scene.json", "run scene.json --out .");
        row("cp s.json scene.json", "scene.json", "run ./scene.json --out . --force");
        row("mkdir d;cp s.json d/scene.json", "d/scene.json", "run d/scene.json --out d");
        row("mkdir d;cp s.json d/scene.json;ln -s d e", "d/scene.json", "run d/scene.json --out e --force");
        row("mkdir d;ln s.json d/scene.json", "s.json", "run s.json --out d --force");
        row("cp s.json summary.csv", "summary.csv", "run summary.csv --out . --force");
        row("cp s.json a.csv", "a.csv", "run a.csv --out . --force");
        row("cp s.json scene.json", "scene.json", "study convergence scene.json --repeat 0 --out .");
        row("cp s.json scene.json", "scene.json",
            "study stability scene.json --x /schemes/*/step=0.1:1:2 --out . --force");
        row("cp s.json convergence.csv", "convergence.csv",
            "study convergence convergence.csv --repeat 0 --out . --force");
        row("cp s.json p.md", "p.md", "passport p.md --no-measure --out p.md --force");
        row("cp s.json p.html", "p.html", "passport p.html --no-measure --out p.html");
        row("cp s.json p.cpp", "p.cpp", "program p.cpp --out p.cpp --force");
        row("cp s.json p.py", "p.py", "program p.py --out ./p.py");
        row("cp s.json p.svg", "p.svg", "snapshot p.svg --view energy --out p.svg --force");
        row("RUN snapshot s.json --view energy --size 300x200 --out g.png", "g.png",
            "snapshot s.json --view energy --out g.png --compare g.png");
        row("RUN snapshot s.json --view energy --size 300x200 --out g.png;cp g.png h.png.diff.png",
            "h.png.diff.png", "snapshot s.json --view energy --out h.png --compare h.png.diff.png --force");
        row("RUN snapshot s.json --view energy --out g.png;ln -s g.png h.png", "g.png",
            "snapshot s.json --view error --set /observe/-=error --out h.png --compare g.png --force");
    }
    void whatIsReadIsNeverReplaced() {
        QFETCH(QString, before);
        QFETCH(QString, input);
        QFETCH(QString, call);
        prepare(before);
        const QByteArray was = contentOf(at(input));
        QVERIFY(!was.isEmpty());
        const QStringList files = all();
        const Answer answer = run(words(call));
        QVERIFY2(answer.code == 2, qPrintable(QString::number(answer.code) + answer.err));
        QVERIFY2(answer.err.contains("which is read"), qPrintable(answer.err));
        QCOMPARE(contentOf(at(input)), was);
        QCOMPARE(all(), files);  // nothing was begun
    }

    void filesOfTheUserAreReplacedIfForced_data() {
        QTest::addColumn<QString>("file");
        QTest::addColumn<QString>("call");
        const auto row = [](const char* file, const char* call) {
            QTest::newRow((std::string(call) + ", " + file).c_str()) << file << call;
        };
        for (const char* file : {"d/scene.json", "d/summary.json", "d/summary.csv", "d/a.csv"})
            row(file, "run s.json --out d");
        for (const char* file :
             {"d/scene.json", "d/convergence.log", "d/convergence.csv", "d/convergence.svg"})
            row(file, "study convergence s.json --repeat 0 --out d");
        row("d/stability.png", "study stability s.json --x /schemes/*/step=0.1:1:2 --out d");
        row("d/p.md", "passport s.json --no-measure --out d/p.md");
        row("d/p.html", "passport s.json --no-measure --out d/p.html");
        row("d/p.tex", "passport s.json --no-measure --out d/p.tex");
        row("d/p.py", "program s.json --out d/p.py");
        row("d/p.cpp", "program s.json --out d/p.cpp");
        for (const char* file : {"d/p.png", "d/p.svg", "d/p.pdf"})
            row(file, (std::string("snapshot s.json --view energy --out ") + file).c_str());
        row("d/index.html", "atlas --quick --systems harmonic-oscillator --out d");
    }
    void filesOfTheUserAreReplacedIfForced() {
        QFETCH(QString, file);
        QFETCH(QString, call);
        QVERIFY(QDir(folder_->path()).mkdir("d"));
        write(file, notMine);
        const QStringList files = all();
        const Answer refused = run(words(call));
        QVERIFY2(refused.code == 3, qPrintable(QString::number(refused.code) + refused.err));
        QVERIFY2(refused.err.contains(file.section('/', -1)) && refused.err.contains("--force"),
                 qPrintable(refused.err));
        QCOMPARE(contentOf(at(file)), notMine);
        QCOMPARE(all(), files);
        const Answer forced = run(words(call) + QStringList{"--force"});
        QVERIFY2(forced.code == 0, qPrintable(forced.err));
        QVERIFY(contentOf(at(file)) != notMine);
    }

    /// Twice the same call, then one of another scene: the files are the program's own.
    void ownFilesAreReplacedAsEver_data() {
        QTest::addColumn<QString>("call");
        for (const char* call :
             {"run s.json --out d", "study convergence s.json --repeat 0 --out d",
              "study stability s.json --x /schemes/*/step=0.1:1:2 --limit --out d",
              "study linear-stability s.json --out d", "passport s.json --no-measure --out p.md",
              "passport s.json --no-measure --out p.html", "passport s.json --no-measure --out p.tex",
              "orbit s.json --period 2 --out d", "program s.json --out p.py", "program s.json --out p.cpp",
              "snapshot s.json --view energy --out p.png", "snapshot s.json --view energy --out p.svg",
              "snapshot s.json --view energy --out p.pdf",
              "snapshot s.json --view energy --out p.png --compare base.png --tolerance 100"})
            QTest::newRow(call) << call;
    }
    void ownFilesAreReplacedAsEver() {
        QFETCH(QString, call);
        if (call.contains("base.png")) prepare("RUN snapshot s.json --view energy --out base.png");
        const QStringList other =
            words(call) +
            QStringList{"--set", "/schemes/0/step=0.2", "--set", "/schemes/0/label=B", "--set", "/model/l=2"};
        for (const QStringList& each : {words(call), words(call), other, words(call)}) {
            const Answer answer = run(each);
            QVERIFY2(answer.code == 0 || answer.err.isEmpty(), qPrintable(answer.err));
        }
    }

    /// A run into a folder may be followed by a study there, and by a run of what was exported.
    void verbsShareAFolder() {
        for (const char* call :
             {"run s.json --out d", "study convergence s.json --repeat 0 --out d", "run d/scene.json --out d",
              "study convergence d/scene.json --repeat 0 --out d",
              "run preset:kepler --set /time/end=1 --out d"})
            QVERIFY2(run(words(call)).code == 0, call);
    }

    /// What the user has changed in a file is the user's.
    void changedFilesAreTheUsers_data() {
        QTest::addColumn<QString>("call");
        QTest::addColumn<QString>("file");
        QTest::newRow("scene") << "run s.json --out d"
                               << "d/scene.json";
        QTest::newRow("scene of a study") << "study convergence s.json --repeat 0 --out d"
                                          << "d/scene.json";
        QTest::newRow("program") << "program s.json --out p.py"
                                 << "p.py";
        QTest::newRow("C++") << "program s.json --out p.cpp"
                             << "p.cpp";
        QTest::newRow("page") << "passport s.json --no-measure --out p.md"
                              << "p.md";
        QTest::newRow("picture") << "snapshot s.json --view energy --out p.svg"
                                 << "p.svg";
    }
    void changedFilesAreTheUsers() {
        QFETCH(QString, call);
        QFETCH(QString, file);
        QCOMPARE(run(words(call)).code, 0);
        const QByteArray edited = contentOf(at(file)).replace("mine", "edit").replace("1", "2");
        write(file, edited);
        const QStringList other = words(call) + QStringList{"--set", "/schemes/0/step=0.2"};
        QCOMPARE(run(other).code, 3);
        QCOMPARE(contentOf(at(file)), edited);
        QCOMPARE(run(other + QStringList{"--force"}).code, 0);
    }

    void aSceneFromStandardInputIsNotReplacedEither() {
        prepare("cp s.json scene.json");
        QProcess process;
        process.setWorkingDirectory(folder_->path());
        process.setStandardInputFile(at("scene.json"));
        process.start(QStringLiteral(EXTREMAL_BINARY), {"run", "-", "--out", ".", "--force"});
        QVERIFY(process.waitForFinished(tests::limit(60000)));
        QCOMPARE(process.exitCode(), 2);
        QCOMPARE(contentOf(at("scene.json")), scene);
    }

    /// The parts of a study that are merged into the folder of one of them stay.
    void mergingIntoAPartKeepsIt() {
        for (const char* part : {"1", "2"})
            QCOMPARE(
                run(words(QString("study convergence s.json --repeat 0 --shard %1/2 --out p%1").arg(part)))
                    .code,
                0);
        const QByteArray log = contentOf(at("p1/convergence.log"));
        for (int i = 0; i < 2; ++i) QCOMPARE(run(words("study merge p1 p2 --out p1")).code, 0);
        QCOMPARE(contentOf(at("p1/convergence.log")), log);
        for (int i = 0; i < 2; ++i) QCOMPARE(run(words("study merge p1 p2 --out whole")).code, 0);
    }

    /// A file that is not a checkpoint is not removed.
    void aFileWithTheNameOfACheckpointStays() {
        QVERIFY(QDir(folder_->path()).mkdir("d"));
        write("d/a.checkpoint", notMine);
        QCOMPARE(run(words("run s.json --out d")).code, 3);
        QCOMPARE(contentOf(at("d/a.checkpoint")), notMine);
    }

private:
    void write(const QString& name, const QByteArray& bytes) {
        QFile file(at(name));
        QVERIFY(file.open(QIODevice::WriteOnly));
        QCOMPARE(file.write(bytes), bytes.size());
    }
    Answer run(const QStringList& arguments) {
        QProcess process;
        process.setWorkingDirectory(folder_->path());
        process.start(QStringLiteral(EXTREMAL_BINARY), arguments);
        if (!process.waitForFinished(tests::limit(60000))) return {};
        return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -2,
                QString::fromUtf8(process.readAllStandardOutput()),
                QString::fromUtf8(process.readAllStandardError())};
    }
    /// Commands of a shell; behind RUN those of the program.
    void prepare(const QString& commands) {
        for (const QString& each : commands.split(';', Qt::SkipEmptyParts)) {
            if (each.startsWith("RUN ")) {
                QCOMPARE(run(words(each.mid(4))).code, 0);
                continue;
            }
            QProcess shell;
            shell.setWorkingDirectory(folder_->path());
            shell.start("/bin/sh", {"-c", each});
            QVERIFY(shell.waitForFinished());
            QCOMPARE(shell.exitCode(), 0);
        }
    }
    QStringList all() const {
        QStringList names;
        for (const QString& folder : {QString("."), QString("d")})
            for (const QString& name : QDir(at(folder)).entryList(QDir::Files | QDir::Hidden, QDir::Name))
                names << folder + "/" + name;
        return names;
    }
    QString at(const QString& name) const { return folder_->filePath(name); }

    std::unique_ptr<QTemporaryDir> folder_;
};

EXTREMAL_TEST(OverwritingTest)

}  // namespace extremal::overwriting_test

#include "overwriting_test.moc"
