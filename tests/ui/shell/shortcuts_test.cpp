// SPDX-License-Identifier: GPL-3.0-or-later
/// Every key with Ctrl or Alt, and every function key, reaches the window from whatever field has the focus;
/// fields keep the clipboard, their own undo, and the keys that move by words.
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPointer>
#include <QSlider>
#include <QTableWidget>
#include <QTest>

#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/shell/actions.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/windows/palette_dialog.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::shortcuts_test {
namespace {

/// Whether the widget with the focus takes the key for itself.
bool isTaken(QWidget& focus, Qt::Key key, Qt::KeyboardModifiers modifiers) {
    QKeyEvent event(QEvent::ShortcutOverride, key, modifiers);
    event.ignore();
    QApplication::sendEvent(&focus, &event);
    return event.isAccepted();
}

/// What fields keep of the keys of actions.
bool isOfFields(const QKeySequence& sequence) {
    for (const QKeySequence::StandardKey own : {QKeySequence::Undo, QKeySequence::Redo})
        if (QKeySequence::keyBindings(own).contains(sequence)) return true;
    const auto key = sequence[0].key();
    return sequence[0].keyboardModifiers() == Qt::ControlModifier &&
           (key == Qt::Key_Up || key == Qt::Key_Down);
}

}  // namespace

class ShortcutsTest : public QObject {
    Q_OBJECT
    KeyGuard guard_;
    std::unique_ptr<MainWindow> window_;

    template <class Field>
    Field* shown() {
        for (Field* field : window_->findChildren<Field*>())
            if (field->isVisible() && field->isEnabled() && field->focusPolicy() != Qt::NoFocus) return field;
        return nullptr;
    }

private slots:
    void initTestCase() {
        loadFonts();
        qApp->installEventFilter(&guard_);
        window_ = std::make_unique<MainWindow>(Theme::light(), false);
        window_->resize(1500, 950);
        window_->show();
        window_->activateWindow();
        QVERIFY(QTest::qWaitForWindowActive(window_.get()));
    }
    void cleanupTestCase() { window_.reset(); }

    void everyShortcutFromEveryField_data() {
        QTest::addColumn<QString>("field");
        for (const char* field : {"formula", "line", "choice", "slider", "stage"})
            QTest::newRow(field) << field;
    }
    void everyShortcutFromEveryField() {
        QFETCH(QString, field);
        window_->actions().find("newLagrangian")->trigger();
        QVERIFY(waitForResults(*window_));
        QWidget* const focus = field == "formula"  ? static_cast<QWidget*>(shown<QPlainTextEdit>())
                               : field == "line"   ? static_cast<QWidget*>(shown<QLineEdit>())
                               : field == "choice" ? static_cast<QWidget*>(shown<QComboBox>())
                               : field == "slider" ? static_cast<QWidget*>(shown<QSlider>())
                                                   : static_cast<QWidget*>(window_->compareView().stage());
        QVERIFY(focus);
        focus->setFocus();
        QTRY_COMPARE(QApplication::focusWidget(), focus);
        int tried = 0;
        for (const QAction* action : window_->actions().all())
            for (const QKeySequence& sequence : action->shortcuts()) {
                const QKeyCombination keys = sequence[0];
                const bool isFunction = keys.key() >= Qt::Key_F1 && keys.key() <= Qt::Key_F12;
                const bool hasModifier = keys.keyboardModifiers() & (Qt::ControlModifier | Qt::AltModifier);
                if (isOfFields(sequence) || !(isFunction || hasModifier)) continue;
                ++tried;
                QVERIFY2(!isTaken(*focus, keys.key(), keys.keyboardModifiers()),
                         qPrintable(sequence.toString() + " " + action->text()));
            }
        QVERIFY(tried > 40);
    }
    void fieldsKeepTheClipboardAndTheirWords() {
        window_->actions().find("newLagrangian")->trigger();
        auto* const formula = shown<QPlainTextEdit>();
        QVERIFY(formula);
        formula->setFocus();
        for (const Qt::Key key : {Qt::Key_C, Qt::Key_X, Qt::Key_V, Qt::Key_A, Qt::Key_Left, Qt::Key_Right})
            QVERIFY2(isTaken(*formula, key, Qt::ControlModifier), qPrintable(QKeySequence(key).toString()));
    }
    void thePaletteOpensFromTheFormula() {
        window_->actions().find("newLagrangian")->trigger();
        QVERIFY(waitForResults(*window_));
        auto* const formula = shown<QPlainTextEdit>();
        formula->setFocus();
        const QString before = formula->toPlainText();
        QTest::keyClick(formula, Qt::Key_K, Qt::ControlModifier);
        const QPointer<PaletteDialog> palette = window_->findChild<PaletteDialog*>();
        QVERIFY(palette && palette->isVisible());
        QCOMPARE(formula->toPlainText(), before);
        palette->close();
    }
};

EXTREMAL_TEST(ShortcutsTest)
}  // namespace extremal::shortcuts_test

#include "shortcuts_test.moc"
