// SPDX-License-Identifier: GPL-3.0-or-later
/// Names of files end as their kind does, whatever was typed.
#include <QDirIterator>
#include <QFile>
#include <QLineEdit>
#include <QTemporaryDir>
#include <QTest>

#include "tests/tools/test.hpp"
#include "ui/base/save_dialog.hpp"

namespace extremal::save_dialog_test {

class SaveDialogTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs); }
    void namesGetTheirEnding() {
        const QStringList scenes{"json"}, plots{"png", "pdf", "svg"};
        QCOMPARE(withEnding("/a/mine", scenes, "json"), QString("/a/mine.json"));
        QCOMPARE(withEnding("/a/mine.json", scenes, "json"), QString("/a/mine.json"));
        QCOMPARE(withEnding("/a/mine.JSON", scenes, "json"), QString("/a/mine.JSON"));
        QCOMPARE(withEnding("/a/mine.v2", scenes, "json"), QString("/a/mine.v2.json"));
        QCOMPARE(withEnding("/a/mine.", scenes, "json"), QString("/a/mine.json"));
        QCOMPARE(withEnding("/a.b/mine", scenes, "json"), QString("/a.b/mine.json"));
        QCOMPARE(withEnding("/a/plot.pdf", plots, "png"), QString("/a/plot.pdf"));
        QCOMPARE(withEnding("/a/h = 0.1", plots, "svg"), QString("/a/h = 0.1.svg"));
        QCOMPARE(withEnding("", scenes, "json"), QString());
    }
    void whatIsTypedInTheDialogGetsIt() {
        QTemporaryDir folder;
        for (const auto& [typed, expected] : {std::pair{"mine", "mine.json"},
                                              {"mine.json", "mine.json"},
                                              {"mine.v2", "mine.v2.json"},
                                              {"my scene", "my scene.json"}}) {
            SaveDialog dialog(nullptr, "Save", "scene.json", "Scenes (*.json)");
            dialog.setDirectory(folder.path());
            dialog.show();
            auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
            QVERIFY(name);
            QCOMPARE(name->text(), QString("scene.json"));
            name->setText(typed);
            QCOMPARE(dialog.path(), folder.filePath(expected));
        }
    }
    void theChosenKindDecides() {
        QTemporaryDir folder;
        SaveDialog dialog(nullptr, "Save", "energy.png", "Picture (*.png);;PDF (*.pdf);;Data (*.csv)");
        dialog.setDirectory(folder.path());
        dialog.show();
        auto* name = dialog.findChild<QLineEdit*>("fileNameEdit");
        dialog.selectNameFilter("PDF (*.pdf)");
        emit dialog.filterSelected("PDF (*.pdf)");
        QCOMPARE(name->text(), QString("energy.pdf"));
        name->setText("mine");
        QCOMPARE(dialog.path(), folder.filePath("mine.pdf"));
        name->setText("mine.csv");  // another kind, said by its ending
        QCOMPARE(dialog.path(), folder.filePath("mine.csv"));
    }
    /// Every dialog of the window that names a file to be written is this one.
    void noOtherDialogAsksForAName() {
        QDirIterator files(QStringLiteral(EXTREMAL_SOURCE_DIR "/ui"), {"*.cpp"}, QDir::Files,
                           QDirIterator::Subdirectories);
        int seen = 0;
        while (files.hasNext()) {
            QFile file(files.next());
            QVERIFY(file.open(QIODevice::ReadOnly));
            const QByteArray text = file.readAll();
            QVERIFY2(!text.contains("getSaveFileName") && !text.contains("getSaveFileUrl"),
                     qPrintable(file.fileName()));
            seen += text.contains("askForSave(");
        }
        QVERIFY(seen >= 5);
    }
};

EXTREMAL_TEST(SaveDialogTest)
}  // namespace extremal::save_dialog_test

#include "save_dialog_test.moc"
