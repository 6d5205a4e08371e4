// SPDX-License-Identifier: GPL-3.0-or-later
/// The start page hides a scene and leads back to it: one key, one button, and until then no key acts on it.
#include <QApplication>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStackedWidget>
#include <QTabBar>
#include <QTest>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/start_page.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::way_back_test {

class WayBackTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        KeyGuard guard;
        explicit Window(const char* scene = "preset:spring-pendulum") : MainWindow(Theme::light(), false) {
            qApp->installEventFilter(&guard);
            resize(1400, 900);
            show();
            if (*scene) {
                open(scene);
                QVERIFY(waitForResults(*this));
            }
            activateWindow();
            QVERIFY(QTest::qWaitForWindowActive(this));
        }
        StartPage* page() { return findChild<StartPage*>(); }
        QPushButton* button() { return page()->findChild<QPushButton*>("back"); }
        bool isStart() { return page()->isVisible(); }
        void key(int key, Qt::KeyboardModifiers modifiers = {}) {
            QWidget* const focus = QApplication::focusWidget();
            QTest::keyClick(focus ? focus : this, static_cast<Qt::Key>(key), modifiers);
        }
        void leave() {
            key(Qt::Key_N, Qt::ControlModifier);
            QVERIFY(isStart());
        }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void escLeadsBackToWhereOneWas() {
        Window window;
        QVERIFY(window.workspace().edit({{"/model/k", Value(500.0)}}, "Change stiffness"));
        QVERIFY(waitForResults(window));
        window.workspace().selectScheme(1);
        window.playback().setTime(3);
        auto* field = window.findChild<QLineEdit*>("field.g");
        field->setFocus();
        const Value document = window.workspace().document();
        window.leave();
        window.key(Qt::Key_Escape);
        QVERIFY(!window.isStart());
        QVERIFY(field->hasFocus());
        QCOMPARE(window.playback().time(), 3.0);
        QCOMPARE(window.workspace().selectedScheme(), 1);
        QVERIFY(window.workspace().document() == document);
        QVERIFY(window.workspace().history().canUndo());
        QVERIFY(window.actions().find("undo")->isEnabled());
    }
    void theButtonNamesTheSceneAndLeadsBack() {
        Window window;
        for (QTabBar* const tabs = window.findChild<QTabBar*>(); const int tab : {0, 1, 2}) {
            tabs->setCurrentIndex(tab);
            window.leave();
            QVERIFY(window.button()->isVisible());
            QCOMPARE(window.button()->text(), QString("Back to Planar pendulum with a stiff spring"));
            QTest::mouseClick(window.button(), Qt::LeftButton);
            QVERIFY(!window.isStart());
            QCOMPARE(tabs->currentIndex(), tab);
        }
    }
    void theMotionStopsAndGoesOn() {
        Window window;
        window.playback().setTime(0);
        window.playback().setPlaying(true);
        window.leave();
        QVERIFY(!window.playback().isPlaying());
        window.key(Qt::Key_Escape);
        QVERIFY(window.playback().isPlaying());
        window.playback().setPlaying(false);
        window.leave();
        window.key(Qt::Key_Escape);
        QVERIFY(!window.playback().isPlaying());
    }
    /// Every key of every action, also those that come later: what needs no scene is named here.
    void noKeyActsOnTheHiddenScene() {
        const QStringList others{"gallery",    "newLagrangian", "drawMechanism", "open",       "pasteScene",
                                 "quit",       "palette",       "theme",         "larger",     "smaller",
                                 "fullScreen", "help",          "searchHelp",    "ownSchemes", "paper",
                                 "keys",       "log",           "about",         "back"};
        Window window;
        QVERIFY(window.workspace().edit({{"/model/k", Value(500.0)}}, "Change stiffness"));
        QVERIFY(waitForResults(window));
        window.workspace().selectScheme(0);
        window.playback().setTime(3);
        const Value document = window.workspace().document();
        const auto results = window.runControl().results();
        window.leave();
        for (const QAction* action : window.actions().all()) {
            QCOMPARE(action->isEnabled(), others.contains(action->objectName()));
            if (others.contains(action->objectName())) continue;
            for (const QKeySequence& keys : action->shortcuts()) {
                const QKeyCombination pressed = keys[0];
                if (pressed.key() == Qt::Key_Escape) continue;
                QTest::keyClick(&window, pressed.key(), pressed.keyboardModifiers());
                QVERIFY2(window.isStart(), qPrintable(action->objectName()));
                QVERIFY2(window.workspace().document() == document, qPrintable(action->objectName()));
                QVERIFY2(window.playback().time() == 3 && !window.playback().isPlaying(),
                         qPrintable(action->objectName()));
            }
        }
        QCOMPARE(window.workspace().selectedScheme(), 0);
        QCOMPARE(window.runControl().results(), results);
        QVERIFY(window.workspace().history().canUndo() && !window.workspace().history().canRedo());
        for (const char* name : {"run", "useChoice"})
            QVERIFY2(!window.findChild<QPushButton*>(name)->isEnabled(), name);
        window.key(Qt::Key_Escape);
        for (const QAction* action : window.actions().all())
            QCOMPARE(action->isEnabled(), action->objectName() != "back");
        QVERIFY(window.findChild<QPushButton*>("run")->isEnabled());
        QTest::keyClick(&window, Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(!window.workspace().history().canUndo());
    }
    void whatIsHalfTypedIsTakenAndTheStartPageStays() {
        Window window;
        auto* field = window.findChild<QLineEdit*>("field.k");
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, "500");
        window.leave();
        QCOMPARE(window.workspace().scene().model.number("k"), 500.0);
        QVERIFY(window.isStart());
        window.key(Qt::Key_Escape);
        QCOMPARE(field->text(), QString("500"));
    }
    /// It is checked a moment after the last letter: that does not bring the scene back into sight.
    void aFormulaThatIsTakenLaterDoesNotLeadBack() {
        Window window("");
        window.actions().find("newLagrangian")->trigger();
        auto* formula = window.findChild<QPlainTextEdit*>("field.lagrangian");
        QVERIFY(formula->hasFocus());
        formula->selectAll();
        QTest::keyClicks(formula, "m/2*theta_t^2 - 3*theta^2");
        window.leave();
        QTRY_COMPARE(window.workspace().scene().model.find("lagrangian")->asString(),
                     std::string("m/2*theta_t^2 - 3*theta^2"));
        QVERIFY(window.isStart());
        window.key(Qt::Key_Escape);
        QCOMPARE(formula->toPlainText(), QString("m/2*theta_t^2 - 3*theta^2"));
    }
    void escInTheSearchLeavesTheSearchFirst() {
        Window window;
        window.leave();
        auto* search = window.page()->findChild<QLineEdit*>("search");
        search->setFocus();
        QTest::keyClicks(search, "kepler");
        window.key(Qt::Key_Escape);
        QVERIFY(window.isStart());
        QCOMPARE(search->text(), QString());
        window.key(Qt::Key_Escape);
        QVERIFY(!window.isStart());
    }
    void withoutASceneThereIsNoWayBack() {
        Window window("");
        QVERIFY(window.isStart() && !window.button()->isVisible());
        window.key(Qt::Key_Escape);
        window.key(Qt::Key_Space);
        window.key(Qt::Key_Delete);
        window.key(Qt::Key_1);
        QVERIFY(window.isStart());
        QVERIFY(!window.actions().find("back")->isEnabled());
    }
    void anotherSceneTakesThePlace() {
        Window window;
        window.leave();
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(!window.isStart());
        window.leave();
        QVERIFY(window.button()->text() != "Back to Planar pendulum with a stiff spring");
        QVERIFY(!window.open("preset:nowhere"));  // said on the start page, and the scene is still there
        QVERIFY(window.isStart());
        window.key(Qt::Key_Escape);
        QCOMPARE(window.workspace().origin(), QString("preset:pendulum"));
    }
};

EXTREMAL_TEST(WayBackTest)
}  // namespace extremal::way_back_test

#include "way_back_test.moc"
