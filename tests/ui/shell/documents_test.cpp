// SPDX-License-Identifier: GPL-3.0-or-later
/// Documents, not dialogs: the title and the notes are written in place, and what is done becomes the steps
/// of a lesson.
#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>

#include "engine/scene/outlook/lesson_steps.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/lesson_bar.hpp"
#include "ui/shell/record_bar.hpp"
#include "ui/workspace/changes.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::documents_test {
namespace {

struct Window : MainWindow {
    KeyGuard guard;
    explicit Window(const char* preset) : MainWindow(Theme::light(), false) {
        qApp->installEventFilter(&guard);
        resize(1400, 900);
        show();
        activateWindow();
        open(QStringLiteral("preset:") + preset);
        QVERIFY(waitForResults(*this));
    }
};

}  // namespace

class DocumentsTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() { loadFonts(); }

    void changesMakeOneSceneOfAnother() {
        const auto object = [](double a, const Value& list) {
            return Value(Value::Object{{"a", a}, {"list", list}, {"same", "x"}});
        };
        const Value before = object(1, Value::Array{1.0, 2.0}), after = object(2, Value::Array{1.0, 3.0});
        const std::vector<Edit> edits = changesBetween(before, after);
        QCOMPARE(edits.size(), std::size_t{2});
        QCOMPARE(edits[0].pointer, std::string("/a"));
        QCOMPARE(edits[1].pointer, std::string("/list/1"));
        QVERIFY(withEdits(before, edits) == after);
        Value longer = object(1, Value::Array{1.0, 2.0, 3.0});
        longer.set("new", 5);
        QVERIFY(withEdits(before, changesBetween(before, longer)) == longer);
        QVERIFY(withEdits(longer, changesBetween(longer, before)) == before);
        QVERIFY(changesBetween(before, before).empty());
    }
    void theTitleIsWrittenWhereItStands() {
        Window window("pendulum");
        auto* const title = window.findChild<QLabel*>("title");
        auto* const edit = window.findChild<QLineEdit*>("titleEdit");
        QVERIFY(title && edit && !edit->isVisible());
        QTest::mouseClick(title, Qt::LeftButton);
        QVERIFY(edit->isVisible());
        enter(edit, "A swing");
        QTRY_VERIFY(!edit->isVisible());
        QCOMPARE(window.workspace().scene().title, std::string("A swing"));
        window.workspace().undo();
        QVERIFY(window.workspace().scene().title != "A swing");
    }
    void theNotesAreWrittenWhereTheyStand() {
        Window window("pendulum");
        window.actions().find("writeNotes")->trigger();
        auto* const text = window.findChild<QPlainTextEdit*>("notesText");
        QVERIFY(text && text->isVisible());
        QCOMPARE(text->toPlainText().toStdString(), window.workspace().scene().notes);
        text->setPlainText("It swings: $x_t = v$.");
        window.findChild<QPushButton*>("writeNotes")->click();
        QVERIFY(!text->isVisible());
        QCOMPARE(window.workspace().scene().notes, std::string("It swings: $x_t = v$."));
        window.workspace().undo();
        QVERIFY(window.workspace().scene().notes != "It swings: $x_t = v$.");
    }
    void whatIsDoneBecomesALesson() {
        Window window("pendulum");
        const Value before = window.workspace().document();
        window.actions().find("recordLesson")->trigger();
        QVERIFY(window.record().isRecording() && window.record().isVisible());
        window.findChild<QLineEdit*>("stepText")->setText("Look at the motion.");
        window.record().recordStep();
        QVERIFY(window.workspace().edit({{"/schemes/0/step", 0.05}}, "step"));
        window.workspace().selectScheme(0);
        window.actions().find("recordStep")->trigger();
        window.record().finish();
        QVERIFY(!window.record().isRecording());
        Value expected = before;
        expected.set("steps", *window.workspace().document().find("steps"));
        QVERIFY(window.workspace().document() == expected);  // where the reader begins
        const auto steps = lessonSteps(window.workspace().document(), window.workspace().scene());
        QCOMPARE(steps.size(), std::size_t{2});
        QCOMPARE(steps[0].text, std::string("Look at the motion."));
        QVERIFY(steps[0].set.empty());
        QCOMPARE(steps[1].set.size(), std::size_t{1});
        QCOMPARE(steps[1].set[0].first, std::string("/schemes/0/step"));
        QCOMPARE(steps[1].scheme, window.workspace().scene().schemes[0].label);
        QVERIFY(!steps[1].text.empty() && !isReached(steps[1], window.workspace().document()));
        window.workspace().undo();  // all of it is one edit
        QVERIFY(!window.workspace().document().find("steps") ||
                *window.workspace().document().find("steps") == *before.find("steps"));
        window.workspace().redo();
        // The lesson leads through them.
        window.actions().find("lesson")->trigger();
        auto* const lesson = window.findChild<LessonBar*>();
        QVERIFY(lesson->isRunning());
        lesson->next();
        lesson->doStep();
        QVERIFY(isReached(steps[1], window.workspace().document()));
    }
};

EXTREMAL_TEST(DocumentsTest)
}  // namespace extremal::documents_test

#include "documents_test.moc"
