// SPDX-License-Identifier: GPL-3.0-or-later
/// The commands that README and handbook show, run as a user would type them, in an empty folder without a
/// display.
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>

#include "tests/app/program.hpp"
#include "tests/tools/test.hpp"

namespace extremal::readme_test {

namespace {

QString fileText(const QString& path) {
    QFile file(QStringLiteral(EXTREMAL_SOURCE_DIR "/") + path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

/// Lines that start with "$ " in blocks marked console.
QStringList commandsOf(const QString& page) {
    QStringList commands;
    bool isConsole = false;
    for (const QString& line : fileText(page).split('\n')) {
        if (line.startsWith("```"))
            isConsole = line == "```console";
        else if (isConsole && line.startsWith("$ "))
            commands << line.mid(2);
    }
    return commands;
}

/// A search ends after so much time of the processor, in which a slow build finds nothing.
QString withTimeToSearch(QString command) {
    if (tests::slowdown > 1)
        for (const char* study : {"study cheapest", "study needs"})
            command.replace(study, QString("%1 --search-time %2s").arg(study).arg(tests::slowdown));
    return command;
}

}  // namespace

class ReadmeTest : public QObject {
    Q_OBJECT

private slots:
    void everyCommandWorks_data() {
        QTest::addColumn<QString>("page");
        for (const char* page :
             {"README.md", "resources/handbook/tour.md", "resources/handbook/command-line.md",
              "resources/handbook/studies.md", "resources/handbook/passport.md"})
            QTest::newRow(page) << page;
    }

    void everyCommandWorks() {
        QFETCH(QString, page);
        const QStringList commands = commandsOf(page);
        QVERIFY2(!commands.isEmpty(), "a page of commands shows none");
        QTemporaryDir folder;
        QProcess shell;
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        const QString programs = QFileInfo(QStringLiteral(EXTREMAL_BINARY)).path();
        environment.insert("PATH", programs + ":" + environment.value("PATH"));
        environment.remove("DISPLAY");
        environment.remove("WAYLAND_DISPLAY");
        environment.remove("QT_QPA_PLATFORM");
        shell.setProcessEnvironment(environment);
        shell.setWorkingDirectory(folder.path());
        for (const QString& command : commands) {
            shell.start("/bin/sh", {"-c", withTimeToSearch(command)});
            QVERIFY(shell.waitForFinished(tests::limit(120000)));
            const QByteArray said = shell.readAllStandardError();
            QVERIFY2(shell.exitStatus() == QProcess::NormalExit && shell.exitCode() == 0,
                     qPrintable(command + "\n" + said));
        }
    }

    void tourLeavesWhatItPromises() {
        QTemporaryDir folder;
        QProcess program;
        program.setWorkingDirectory(folder.path());
        program.start(EXTREMAL_BINARY, {"run", "preset:spring-pendulum", "--out", "pendulum", "--quiet"});
        QVERIFY(program.waitForFinished(tests::limit(120000)));
        QCOMPARE(program.exitCode(), 0);
        const QStringList files = QDir(folder.filePath("pendulum")).entryList(QDir::Files);
        for (const char* name : {"scene.json", "summary.csv", "summary.json"})
            QVERIFY2(files.contains(name), name);
        QVERIFY(files.filter(".csv").size() > 2);  // the summary, and one for each scheme
    }
};

EXTREMAL_TEST(ReadmeTest)
}  // namespace extremal::readme_test

#include "readme_test.moc"
