// SPDX-License-Identifier: GPL-3.0-or-later
/// Temporary files are made anew, not through links, and what a process has left that was killed is taken
/// away.
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

#include <memory>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "engine/run/files/export.hpp"
#include "engine/run/files/file_batch.hpp"
#include "tests/tools/test.hpp"

namespace extremal::file_batch_test {
namespace {

QByteArray contentOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

void put(const QString& path, const QByteArray& content) {
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(content), content.size());
}

/// The number of a process that has ended.
pid_t endedProcess() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    int status = 0;
    ::waitpid(child, &status, 0);
    return child;
}

}  // namespace

class FileBatchTest : public QObject {
    Q_OBJECT
private slots:
    /// The temporary name of a file in this process, from a batch that is not committed.
    void init() {
        folder_ = std::make_unique<QTemporaryDir>();
        FileBatch batch(folder_->path().toStdString());
        batch.write("a.csv", "");
        const QStringList names = QDir(folder_->path()).entryList(QDir::Files | QDir::Hidden);
        QCOMPARE(names.size(), 1);
        name_ = names.first();
        QVERIFY(name_.startsWith(".a.csv.") && name_.endsWith("." + QString::number(::getpid()) + ".tmp"));
    }

    void linksAreNotWrittenThrough() {
        const QString victim = at("victim");
        put(victim, "mine");
        QVERIFY(QFile::link(victim, at(name_)));
        writeFile(at("a.csv").toStdString(), "rows");
        QCOMPARE(contentOf(victim), "mine");
        QCOMPARE(contentOf(at("a.csv")), "rows");
        QVERIFY(!QFileInfo(at("a.csv")).isSymLink());
        // Nor is a link to nowhere, which would make a file there.
        QVERIFY(QFile::remove(victim) && QFile::link(victim, at(name_)) && QFile::remove(at("a.csv")));
        writeFile(at("a.csv").toStdString(), "again");
        QVERIFY(!QFile::exists(victim));
        QCOMPARE(contentOf(at("a.csv")), "again");
    }

    void pipesAreNotWaitedFor() {
        QCOMPARE(::mkfifo(qPrintable(at(name_)), 0600), 0);
        writeFile(at("a.csv").toStdString(), "rows");
        QCOMPARE(contentOf(at("a.csv")), "rows");
    }

    void aFolderInTheWayIsAnError() {
        QVERIFY(QDir(folder_->path()).mkdir(name_));
        QVERIFY_THROWS_EXCEPTION(ExportError, writeFile(at("a.csv").toStdString(), "rows"));
    }

    void whatAKilledProcessHasLeftIsTakenAway() {
        const QString own = "." + QString::number(::getpid()) + ".tmp";
        const auto ofProcess = [&](pid_t process) {
            return QString(name_).replace(own, "." + QString::number(process) + ".tmp");
        };
        const QString left = ofProcess(endedProcess());
        const QStringList kept{ofProcess(1),   QString(left).replace(".a.csv.", ".a.csv.another-"),
                               ".notes.tmp",   ".12.tmp",
                               "a" + left,     "..tmp",
                               ".a.csv.-5.tmp"};
        put(at(left), "half");
        for (const QString& name : kept) put(at(name), "half");
        writeFile(at("b.csv").toStdString(), "rows");
        QVERIFY(!QFile::exists(at(left)));
        for (const QString& name : kept) QVERIFY2(QFile::exists(at(name)), qPrintable(name));
    }

    void foldersThatCannotBeAreErrorsWithTheCause() {
        QVERIFY(QFile::link(at("b"), at("c")) && QFile::link(at("c"), at("b")));
        const auto reasonOf = [](const QString& folder) {
            try {
                prepareFolder(folder.toStdString());
            } catch (const ExportError& e) {
                return QString(e.what());
            }
            return QString();
        };
        QCOMPARE(reasonOf(at("b")), "Too many levels of symbolic links");
        QCOMPARE(reasonOf(at("b/inside")), "Too many levels of symbolic links");
        QCOMPARE(reasonOf(at(QString(300, 'x'))), "File name too long");
        QCOMPARE(reasonOf(at(QString(100, 'x') + "/" + QString(300, 'y'))), "File name too long");
        QCOMPARE(reasonOf("/" + QString("x/").repeated(3000)), "File name too long");
    }

private:
    QString at(const QString& name) const { return folder_->filePath(name); }

    std::unique_ptr<QTemporaryDir> folder_;
    QString name_;
};

EXTREMAL_TEST(FileBatchTest)

}  // namespace extremal::file_batch_test

#include "file_batch_test.moc"
