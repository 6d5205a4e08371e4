// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the focus is: after a scene opens at the stage, and never at a field that the user has not pointed
/// at.
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPointer>
#include <QSlider>
#include <QTabBar>
#include <QTest>
#include <QWheelEvent>

#include "tests/tools/test.hpp"
#include "tests/ui/enter.hpp"
#include "tests/ui/window.hpp"
#include "ui/panels/scheme_card.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/actions.hpp"
#include "ui/shell/gallery.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::focus_test {
namespace {

void turnWheel(QWidget& widget) {
    const QPointF middle(widget.width() / 2.0, widget.height() / 2.0);
    QWheelEvent event(middle, widget.mapToGlobal(middle), {}, {0, -240}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&widget, &event);
}

/// What a field shows.
QString shownBy(const QWidget& field) {
    if (const auto* box = qobject_cast<const QComboBox*>(&field)) return box->currentText();
    if (const auto* slider = qobject_cast<const QSlider*>(&field)) return QString::number(slider->value());
    return field.property("text").toString();
}

}  // namespace

class FocusTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        KeyGuard guard;
        Window() : MainWindow(Theme::light(), false) {
            qApp->installEventFilter(&guard);
            resize(1400, 900);
            show();
            activateWindow();
            QVERIFY(QTest::qWaitForWindowActive(this));
        }
        bool isAtStage() { return compareView().stage()->hasFocus(); }
        void key(int key, Qt::KeyboardModifiers modifiers = {}) {
            QWidget* const focus = QApplication::focusWidget();
            QTest::keyClick(focus ? focus : this, static_cast<Qt::Key>(key), modifiers);
        }
        /// Space plays, and neither it nor the arrows change the scene.
        void expectKeysOfTheStage() {
            QVERIFY(isAtStage());
            const Value document = workspace().document();
            for (const int k : {Qt::Key_Down, Qt::Key_Up, Qt::Key_Right, Qt::Key_Home, Qt::Key_Return})
                key(k);
            QVERIFY(workspace().document() == document);
            playback().setPlaying(false);
            key(Qt::Key_Space);
            QVERIFY(playback().isPlaying());
            key(Qt::Key_Space);
            QVERIFY(!playback().isPlaying());
            QVERIFY(workspace().document() == document);
        }
    };

private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void aCardOfTheStartPageOpensAtTheStage() {
        Window window;
        auto* card = window.findChild<GalleryCard*>("preset.pendulum");
        QTest::mouseClick(card, Qt::LeftButton);
        QCOMPARE(window.workspace().origin(), QString("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.expectKeysOfTheStage();
    }
    void everyOtherWayToOpenLeadsThereToo() {
        Window window;
        QVERIFY(window.open("preset:kepler"));
        QVERIFY(waitForResults(window));
        window.expectKeysOfTheStage();
        window.findChild<QComboBox*>("model")->setFocus();  // of the scene that was open
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.expectKeysOfTheStage();
        window.actions().find("gallery")->trigger();
        auto* search = window.findChild<QLineEdit*>("search");
        search->setFocus();
        QTest::keyClicks(search, "kepler");
        window.key(Qt::Key_Return);
        QVERIFY(waitForResults(window));
        QVERIFY(window.workspace().origin().startsWith("preset:"));
        window.expectKeysOfTheStage();
        QVERIFY(window.workspace().adopt(Value(window.workspace().document())));
        window.expectKeysOfTheStage();
    }
    /// What is hidden while it has the focus gives it to the stage, not to the next field.
    void aFieldThatDisappearsGivesTheFocusToTheStage() {
        Window window;
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        auto* card = window.findChild<SchemeCard*>("scheme.0");
        for (const char* name : {"step", "name"}) {
            if (std::string(name) == "step")
                card->editStep();
            else
                card->editName();
            auto* edit = card->findChild<QLineEdit*>(name);
            QVERIFY(edit->hasFocus());
            QTest::keyClicks(edit, "0.02");
            window.key(Qt::Key_Return);
            QTRY_VERIFY(window.isAtStage());
            QVERIFY(waitForResults(window));
            window.expectKeysOfTheStage();
        }
        window.findChild<QLineEdit*>("field.g")->setFocus();
        window.actions().find("scenePanel")->trigger();  // with the field
        window.expectKeysOfTheStage();
        window.actions().find("scenePanel")->trigger();
    }
    void otherPagesGiveTheFocusToNoField() {
        Window window;
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        window.compareView().stage()->setFocus();
        for (const int page : {2, 1, 0, 2}) {
            window.findChild<QTabBar*>()->setCurrentIndex(page);
            const QWidget* const focus = QApplication::focusWidget();
            QVERIFY(!qobject_cast<const QComboBox*>(focus) && !qobject_cast<const QLineEdit*>(focus));
            window.playback().setPlaying(false);
            window.key(Qt::Key_Space);
            QVERIFY(window.playback().isPlaying());
        }
        window.playback().setPlaying(false);
    }
    /// A click into a plot takes what is typed in a field, which may take the plot away: another name of a
    /// coordinate brings other plots.
    void aPlotMayGoWithThePressThatLeavesAField() {
        Window window;
        QVERIFY(window.open("preset:two-frequencies"));
        QVERIFY(waitForResults(window));
        const auto plots = [&] { return window.compareView().plots(); };
        const QPointer<PlotWidget> last = plots().back();
        QWidget* const canvas = last->childAt(last->rect().center());
        QVERIFY(canvas);
        auto* names = window.findChild<QLineEdit*>("field.coordinates");
        const QString before = names->text();
        names->setFocus();
        names->setCursorPosition(static_cast<int>(before.section(',', 0, 0).size()));
        QTest::keyClicks(names, "a");
        QTest::mouseClick(canvas, Qt::LeftButton);
        QVERIFY(window.workspace().document().find("views") == nullptr ||
                !window.workspace().history().undoText().isEmpty());
        QCOMPARE(names->text(), QString(before).insert(before.section(',', 0, 0).size(), 'a'));
        QApplication::processEvents();
        QVERIFY(waitForResults(window));
        window.workspace().undo();
        QVERIFY(waitForResults(window));
    }
    void tabStillMovesIt() {
        Window window;
        QVERIFY(window.open("preset:pendulum"));
        QVERIFY(waitForResults(window));
        auto* field = window.findChild<QLineEdit*>("field.g");
        field->setFocus();
        QVERIFY(field->hasFocus());
        window.key(Qt::Key_Tab);
        QVERIFY(!field->hasFocus() && !window.isAtStage() && QApplication::focusWidget());
        window.key(Qt::Key_Backtab, Qt::ShiftModifier);
        QVERIFY(field->hasFocus());
    }
    void theWheelChangesNoFieldWithoutTheFocus() {
        for (const char* scene : {"preset:wave", "preset:rule-per-term", "preset:duffing"}) {
            Window window;
            QVERIFY2(window.open(scene), scene);
            QVERIFY(waitForResults(window));
            window.findChild<SchemeCard*>("scheme.0")->setEditing(true);
            QApplication::processEvents();
            window.compareView().stage()->setFocus();
            const Value document = window.workspace().document();
            int fields = 0;
            for (QWidget* field : window.findChildren<QWidget*>()) {
                const bool isField = qobject_cast<QComboBox*>(field) ||
                                     qobject_cast<QAbstractSpinBox*>(field) ||
                                     qobject_cast<QPlainTextEdit*>(field);
                if (!isField || !field->isVisible()) continue;
                const QString before = shownBy(*field);
                turnWheel(*field);
                QVERIFY2(shownBy(*field) == before && !field->hasFocus(), qPrintable(field->objectName()));
                ++fields;
            }
            QVERIFY(fields >= 4);
            QVERIFY(window.isAtStage());
            QVERIFY(window.workspace().document() == document);
        }
    }
    void theWheelChangesAFieldThatHasTheFocus() {
        Window window;
        QVERIFY(window.open("preset:pendulum"));
        auto* speed = window.findChild<QComboBox*>("speed");
        QVERIFY(speed);
        speed->setFocus();
        turnWheel(*speed);
        QCOMPARE(speed->currentIndex(), 4);
    }
};

EXTREMAL_TEST(FocusTest)
}  // namespace extremal::focus_test

#include "focus_test.moc"
