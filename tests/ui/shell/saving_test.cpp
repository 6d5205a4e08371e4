// SPDX-License-Identifier: GPL-3.0-or-later
/// A scene that is saved, opened and saved again has the same bytes: every preset. What another program or
/// window has written meanwhile is not written over.
#include <QFile>
#include <QFileInfo>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include <algorithm>

#include "engine/scene/preset.hpp"
#include "tests/tools/test.hpp"
#include "ui/base/notices.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::saving_test {
namespace {

QByteArray bytesOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// As another program does it: in place, or by a new file that takes the name.
void writeAsAnother(const QString& path, const QByteArray& bytes, bool isReplaced) {
    QFile file(isReplaced ? path + ".new" : path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(file.write(bytes), bytes.size());
    file.close();
    if (!isReplaced) return;
    QVERIFY(QFile::remove(path));
    QVERIFY(QFile::rename(path + ".new", path));
}

bool hasNotice(const Notices& notices, const QString& key) {
    const auto& all = notices.all();
    return std::any_of(all.begin(), all.end(), [&](const Notice& each) { return each.key == key; });
}

/// Clicks a choice of the notice of this key.
void choose(Notices& notices, const QString& key, const QString& choice) {
    for (const Notice& notice : notices.all())
        if (notice.key == key)
            for (const Notice::Choice& each : notice.choices)
                if (each.text == choice) {
                    const auto act = each.act;
                    act();
                    return;
                }
    QFAIL(qPrintable("there is no choice " + choice));
}

const std::vector<Edit> shorter{{"/time/end", Value(3.0)}};

}  // namespace

class SavingTest : public QObject {
    Q_OBJECT
private slots:
    void savedAgainItHasTheSameBytes() {
        QTemporaryDir folder;
        const auto bytes = [](const QString& path) {
            QFile file(path);
            return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
        };
        for (const Preset& preset : presets()) {
            const QString id = QString::fromUtf8(preset.id.data(), static_cast<qsizetype>(preset.id.size()));
            const QString first = folder.filePath(id + ".json"), second = folder.filePath(id + "-2.json");
            Notices notices;
            Workspace once(notices), twice(notices);
            QVERIFY2(once.open("preset:" + id) && once.saveAs(first), qPrintable(id));
            QVERIFY2(twice.open(first, true) && twice.saveAs(second), qPrintable(id));
            QVERIFY2(!bytes(first).isEmpty() && bytes(first) == bytes(second), qPrintable(id));
            QVERIFY2(once.scene() == twice.scene(), qPrintable(id));
        }
    }

    void aFileThatChangedIsNotWrittenOver_data() {
        QTest::addColumn<bool>("isReplaced");
        QTest::newRow("in place") << false;
        QTest::newRow("by another file") << true;
    }
    void aFileThatChangedIsNotWrittenOver() {
        QFETCH(bool, isReplaced);
        QTemporaryDir folder;
        const QString path = folder.filePath("s.json");
        Notices notices;
        Workspace workspace(notices);
        QVERIFY(workspace.open("preset:pendulum") && workspace.saveAs(path));
        const QByteArray first = bytesOf(path), others = QByteArray(first).replace("endulum", "ENDULUM");
        QVERIFY(others != first);
        writeAsAnother(path, others, isReplaced);
        QTRY_VERIFY(hasNotice(notices, "disk"));  // said at once, before anything is saved
        QVERIFY(workspace.edit(shorter, "end"));
        QVERIFY(!workspace.save());
        QCOMPARE(bytesOf(path), others);
        QVERIFY(workspace.isDirty());
        QSignalSpy asked(&workspace, &Workspace::saveAsWanted);
        choose(notices, "disk", "Save as...");
        QCOMPARE(asked.size(), 1);
        QCOMPARE(bytesOf(path), others);
        // The user decides to save all the same: from then on the file is known again.
        QVERIFY(!workspace.save());
        choose(notices, "disk", "Save anyway");
        QVERIFY(bytesOf(path) != others && !workspace.isDirty());
        QVERIFY(!hasNotice(notices, "disk"));
        QVERIFY(workspace.edit({{"/time/end", Value(4.0)}}, "end") && workspace.save());
    }

    void aFileThatChangedIsReadAgain() {
        QTemporaryDir folder;
        const QString path = folder.filePath("s.json");
        Notices notices;
        Workspace workspace(notices);
        QVERIFY(workspace.open("preset:pendulum") && workspace.saveAs(path));
        QVERIFY(workspace.edit(shorter, "end"));
        writeAsAnother(path, bytesOf(path).replace("\"lesson\": \"", "\"lesson\": \"another "), false);
        QVERIFY(!workspace.save());
        choose(notices, "disk", "Reload");
        QVERIFY(!workspace.isDirty());
        QVERIFY(workspace.scene().end.value != 3.0);
        QVERIFY(workspace.scene().lesson.starts_with("another "));
    }

    /// Two windows on one file: the second to save is told.
    void twoWindowsOnOneFileKeepBoth() {
        QTemporaryDir folder;
        const QString path = folder.filePath("s.json");
        Notices notices;
        Workspace one(notices), two(notices);
        QVERIFY(one.open("preset:pendulum") && one.saveAs(path) && two.open(path));
        QVERIFY(one.edit(shorter, "end") && one.save());
        const QByteArray saved = bytesOf(path);
        QVERIFY(two.edit({{"/time/end", Value(5.0)}}, "end"));
        QVERIFY(!two.save());
        QCOMPARE(bytesOf(path), saved);
        QVERIFY(one.edit({{"/time/end", Value(6.0)}}, "end") && one.save());
    }

    /// Not a change: the same bytes again, a new date, a file that is gone, and what is to be saved already.
    void whatHasNotChangedIsSaved() {
        QTemporaryDir folder;
        const QString path = folder.filePath("s.json");
        Notices notices;
        Workspace workspace(notices);
        QVERIFY(workspace.open("preset:pendulum") && workspace.saveAs(path));
        writeAsAnother(path, bytesOf(path), true);
        QVERIFY(workspace.edit(shorter, "end") && workspace.save());
        QVERIFY(QFile::remove(path));
        QVERIFY(workspace.edit({{"/time/end", Value(4.0)}}, "end") && workspace.save());
        QVERIFY(QFileInfo::exists(path));
        Workspace other(notices);
        QVERIFY(other.open(path));
        QVERIFY(workspace.edit(shorter, "end") && workspace.save());
        QVERIFY(other.edit(shorter, "end") && other.save());  // the same scene
    }

    /// After a crash the copy knows what the file was.
    void aRecoveredSceneKnowsItsFile() {
        QTemporaryDir folder;
        const QString path = folder.filePath("s.json");
        Notices notices;
        Workspace before(notices);
        QVERIFY(before.open("preset:pendulum") && before.saveAs(path));
        const std::string mark = before.diskMark();
        QVERIFY(before.edit(shorter, "end"));
        Workspace after(notices);
        QVERIFY(after.adopt(before.document(), path, path, mark) && after.save());
        writeAsAnother(path, bytesOf(path) + "\n", false);
        Workspace late(notices);
        QVERIFY(late.adopt(before.document(), path, path, mark));
        QVERIFY(late.edit({{"/time/end", Value(4.0)}}, "end"));
        QVERIFY(!late.save());
    }
};

EXTREMAL_TEST(SavingTest)
}  // namespace extremal::saving_test

#include "saving_test.moc"
