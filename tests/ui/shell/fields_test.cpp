// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields of the window answer to keys alike: Enter takes and leaves, Esc brings back, undo is that of the
/// window once nothing typed is left in the field.
#include <QApplication>
#include <QLineEdit>
#include <QTest>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::fields_test {

class FieldsTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        KeyGuard guard;
        Window() : MainWindow(Theme::light(), false) {
            qApp->installEventFilter(&guard);
            resize(1400, 900);
            show();
            open("preset:spring-pendulum");
            QVERIFY(waitForResults(*this));
            activateWindow();
            QVERIFY(QTest::qWaitForWindowActive(this));
        }
        QLineEdit* field() { return findChild<QLineEdit*>("field.k"); }
        double k() { return workspace().scene().model.number("k"); }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void aClickSelectsTheText() {
        Window window;
        QTest::mouseClick(window.field(), Qt::LeftButton);
        QTRY_COMPARE(window.field()->selectedText(), window.field()->text());
        QTest::keyClicks(window.field(), "500");
        QTest::keyClick(window.field(), Qt::Key_Return);
        QCOMPARE(window.k(), 500.0);
    }
    void enterLeavesTheFieldAndUndoIsThatOfTheWindow() {
        Window window;
        const double before = window.k();
        window.field()->setFocus();
        window.field()->selectAll();
        QTest::keyClicks(window.field(), "500");
        QTest::keyClick(window.field(), Qt::Key_Return);
        QTRY_VERIFY(!window.field()->hasFocus());
        QCOMPARE(window.k(), 500.0);
        QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(window.k(), before);
    }
    void undoInAFieldWithNothingTypedIsThatOfTheWindow() {
        Window window;
        const double before = window.k();
        QVERIFY(window.workspace().edit({{"/model/k", Value(500.0)}}, "k"));
        window.field()->setFocus();
        QTest::keyClick(window.field(), Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(window.k(), before);
        // With something typed it is the field's own.
        QVERIFY(window.workspace().edit({{"/model/k", Value(500.0)}}, "k"));
        window.field()->setFocus();
        QTest::keyClicks(window.field(), "7");
        QTest::keyClick(window.field(), Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(window.field()->text(), QString("500"));
        QCOMPARE(window.k(), 500.0);
    }
    void escapeBringsBackAndLeaves() {
        Window window;
        const double before = window.k();
        const QString text = window.field()->text();
        window.field()->setFocus();
        window.field()->selectAll();
        QTest::keyClicks(window.field(), "77");
        QTest::keyClick(window.field(), Qt::Key_Escape);
        QVERIFY(!window.field()->hasFocus());
        QCOMPARE(window.field()->text(), text);
        QCOMPARE(window.k(), before);
    }
};

EXTREMAL_TEST(FieldsTest)
}  // namespace extremal::fields_test

#include "fields_test.moc"
