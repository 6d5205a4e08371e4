// SPDX-License-Identifier: GPL-3.0-or-later
/// Help, completions of shells and manual page, which are made from the options: what they offer is what the
/// program takes.
#include <QDir>
#include <QProcess>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::completion_test {
namespace {

using tests::runProgram;

QStringList verbs() {
    return {"run",      "snapshot", "figure",   "page",     "passport", "program",    "check",
            "list",     "study",    "handbook", "atlas",    "wisdom",   "completion", "manual",
            "formulas", "orbit",    "fit",      "gradient", "steer"};
}

/// A command of a shell in a folder, with the program on the path: what it prints.
QString shellSays(const QString& shell, const QString& command, const QString& folder, int& code) {
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("PATH",
                       QFileInfo(QStringLiteral(EXTREMAL_BINARY)).path() + ":" + environment.value("PATH"));
    for (const char* display : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) environment.remove(display);
    environment.insert("HOME", folder);
    process.setProcessEnvironment(environment);
    process.setWorkingDirectory(folder);
    process.start(shell, {"-c", command});
    code = process.waitForFinished(tests::limit(120000)) && process.exitStatus() == QProcess::NormalExit
               ? process.exitCode()
               : -1;
    return QString::fromUtf8(process.readAllStandardOutput()) +
           QString::fromUtf8(process.readAllStandardError());
}

}  // namespace

class CompletionTest : public QObject {
    Q_OBJECT
private slots:
    void everyHelpHasExamplesThatWork() {
        for (const QString& verb : verbs() + QStringList{QString()}) {
            QStringList asked{"--help"};
            if (!verb.isEmpty()) asked.prepend(verb);
            const QString help = runProgram(asked).out;
            const qsizetype start = help.indexOf("Examples:\n");
            QVERIFY2(start > 0, qPrintable(verb));
            for (const QString& line : help.mid(start + 10).split('\n', Qt::SkipEmptyParts)) {
                const QString command = line.trimmed();
                // Measurements have to come from somewhere.
                QVERIFY2(command.startsWith("extremal ") && command.contains("extremal " + verb),
                         qPrintable(line));
                // The window needs a display, and the atlas minutes.
                if (command == "extremal preset:kepler" || command.startsWith("extremal atlas")) continue;
                QTemporaryDir folder;
                int code = 0;
                const QString said = shellSays("/bin/sh", command, folder.path(), code);
                QVERIFY2(code == 0, qPrintable(command + "\n" + said));
            }
        }
    }

    void anUnknownOptionNamesTheNearest_data() {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("said");
        QTest::newRow("typo") << QStringList{"run", "preset:kepler", "--ot", "x"}
                              << "unknown option --ot of run (did you mean --out?)";
        QTest::newRow("with a value") << QStringList{"snapshot", "preset:kepler", "--out=a.png", "--sise=9x9"}
                                      << "unknown option --sise of snapshot (did you mean --size?)";
        QTest::newRow("of another verb")
            << QStringList{"run", "preset:kepler", "--out", "x", "--metric", "energy"}
            << "unknown option --metric of run (study has it)";
        QTest::newRow("before a verb")
            << QStringList{"--quite"} << "unknown option --quite (did you mean --quiet?)";
        QTest::newRow("like none") << QStringList{"run", "preset:kepler", "--out", "x", "--zzz"}
                                   << "unknown option --zzz of run (see extremal run --help)";
        QTest::newRow("shell") << QStringList{"completion", "bahs"} << "(did you mean \"bash\"?)";
    }
    void anUnknownOptionNamesTheNearest() {
        QFETCH(QStringList, arguments);
        QFETCH(QString, said);
        const tests::Answer answer = runProgram(arguments);
        QCOMPARE(answer.code, 2);
        QVERIFY2(answer.err.contains(said), qPrintable(answer.err));
        QVERIFY(!QFile::exists("x"));
    }

    void shellsComplete_data() {
        QTest::addColumn<QString>("typed");
        QTest::addColumn<QStringList>("offered");
        QTest::newRow("verbs") << "ch" << QStringList{"check"};
        QTest::newRow("studies") << "study che" << QStringList{"cheapest"};
        QTest::newRow("another study") << "study con" << QStringList{"convergence"};
        QTest::newRow("catalogues") << "list obs" << QStringList{"observables"};
        QTest::newRow("options") << "run preset:kepler --thr" << QStringList{"--threads"};
        QTest::newRow("options of a study") << "study cheapest --err" << QStringList{"--error"};
        QTest::newRow("views") << "snapshot preset:kepler --view momen" << QStringList{"momentum"};
        QTest::newRow("shells") << "completion fi" << QStringList{"fish"};
    }
    void shellsComplete() {
        QFETCH(QString, typed);
        QFETCH(QStringList, offered);
        QTemporaryDir folder;
        int code = 0;
        const QString line = "extremal " + typed;
        const QString bash = shellSays("bash",
                                       "source <(extremal completion bash); COMP_LINE='" + line +
                                           "'; COMP_POINT=" + QString::number(line.size()) +
                                           "; _extremal; echo \"${COMPREPLY[@]}\"",
                                       folder.path(), code);
        QCOMPARE(bash.trimmed().split(' '), offered);
        if (QStandardPaths::findExecutable("fish").isEmpty()) return;
        const QString fish = shellSays(
            "fish", "extremal completion fish | source; complete -C '" + line + "'", folder.path(), code);
        QStringList words;
        for (const QString& each : fish.split('\n', Qt::SkipEmptyParts)) words << each.split('\t').front();
        QCOMPARE(words, offered);
    }

    void presetsCompleteBehindTheColon() {
        QTemporaryDir folder;
        int code = 0;
        const QString line = "extremal run preset:tenn";
        const QString bash = shellSays("bash",
                                       "source <(extremal completion bash); COMP_LINE='" + line +
                                           "'; COMP_POINT=" + QString::number(line.size()) +
                                           "; _extremal; echo \"${COMPREPLY[@]}\"",
                                       folder.path(), code);
        QCOMPARE(bash.trimmed(), QString("tennis-racket"));  // bash has the rest on the line
    }

    void theTextsHaveEveryOption() {
        QTemporaryDir folder;
        QStringList pages;
        for (const char* shell : {"bash", "zsh", "fish"}) pages << runProgram({"completion", shell}).out;
        pages << runProgram({"manual"}).out.replace("\\-", "-");
        static const QRegularExpression option("--([a-z][a-z-]+)");
        for (const QString& verb : verbs()) {
            auto matches = option.globalMatch(runProgram({verb, "--help"}).out.section("Examples:", 0, 0));
            while (matches.hasNext()) {
                const QString name = matches.next().captured(1);
                for (const QString& page : pages)
                    QVERIFY2(page.contains(name), qPrintable(verb + " --" + name));
            }
        }
        int code = 0;
        QFile zsh(folder.filePath("_extremal"));
        QVERIFY(zsh.open(QIODevice::WriteOnly));
        zsh.write(pages[1].toUtf8());
        zsh.close();
        if (!QStandardPaths::findExecutable("zsh").isEmpty()) {
            shellSays("zsh", "zsh -n _extremal", folder.path(), code);
            QCOMPARE(code, 0);
        }
        if (QStandardPaths::findExecutable("man").isEmpty()) return;
        const QString page =
            shellSays("/bin/sh", "extremal manual > extremal.1; man --warnings -l extremal.1 2>&1 | cat",
                      folder.path(), code);
        QVERIFY2(!page.contains("warning:"), qPrintable(page));
        QVERIFY2(page.contains("--threads") && page.contains("preset:kepler"), qPrintable(page));
    }

    void theVersionSaysWhatToReport() {
        QCOMPARE(runProgram({"--version"}).out.count('\n'), 1);
        const QString text = runProgram({"--version", "--verbose"}).out;
        for (const char* line : {"\ncommit ", "\ncompiler ", "\ninstruction set ", "\nstage ", "OpenGL",
                                 "\nQt ", "\nEigen ", "\nFFTW ", "\nGiNaC "})
            QVERIFY2(text.contains(line), line);
        QCOMPARE(runProgram({"--verbose"}).code, 2);
    }
};

EXTREMAL_TEST(CompletionTest)
}  // namespace extremal::completion_test

#include "completion_test.moc"
