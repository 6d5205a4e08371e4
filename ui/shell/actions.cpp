// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/actions.hpp"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QAbstractSlider>
#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QPlainTextEdit>
#include <QSlider>
#include <QTimer>

namespace extremal {

Actions::Actions(QWidget& window) : QObject(&window), window_(window) {}

QAction* Actions::add(const QString& id, const QString& menu, const QString& text,
                      const QList<QKeySequence>& keys, std::function<void()> act, const QString& tip) {
    auto* action = new QAction(text, &window_);
    action->setObjectName(id);
    action->setShortcuts(keys);
    action->setData(menu);
    action->setToolTip(tip.isEmpty() ? text : tip);
    action->setStatusTip(tip);
    connect(action, &QAction::triggered, this, [act = std::move(act)] { act(); });
    window_.addAction(action);
    all_ << action;
    items_ << Item{menu, action, nullptr};
    if (!menus_.contains(menu)) menus_ << menu;
    return action;
}

void Actions::addSeparator(const QString& menu) { items_ << Item{menu, nullptr, nullptr}; }

void Actions::addSubmenu(const QString& menu, QMenu* submenu) { items_ << Item{menu, nullptr, submenu}; }

QAction* Actions::find(const QString& id) const {
    for (QAction* action : all_)
        if (action->objectName() == id) return action;
    return nullptr;
}

void Actions::setSceneInSight(bool isInSight) {
    for (QAction* action : all_)
        if (!withoutScene_.contains(action->objectName())) action->setEnabled(isInSight);
    for (const Item& item : items_)
        if (item.submenu) item.submenu->menuAction()->setEnabled(isInSight);
}

QString Actions::menuOf(const QAction* action) { return action->data().toString(); }

namespace {

/// The text with a letter to press: the first of a word that is free, else any that is.
QString withMnemonic(const QString& text, QString& taken) {
    const QString letters = text.toUpper();
    for (const bool isFirst : {true, false})
        for (qsizetype i = 0; i < text.size(); ++i) {
            if (!text[i].isLetterOrNumber() || taken.contains(letters[i])) continue;
            if (isFirst && i > 0 && !text[i - 1].isSpace()) continue;
            taken += letters[i];
            return QString(text).insert(i, '&');
        }
    return text;
}

}  // namespace

void Actions::fill(QMenuBar& bar) const {
    QString ofBar;
    for (const QString& name : menus_) {
        QMenu* menu = bar.addMenu(withMnemonic(name, ofBar));
        QString ofMenu;
        for (const Item& item : items_) {
            if (item.menu != name) continue;
            if (item.submenu) {
                item.submenu->setTitle(withMnemonic(item.submenu->title(), ofMenu));
                menu->addMenu(item.submenu);
            } else if (item.action) {
                item.action->setText(withMnemonic(item.action->text(), ofMenu));
                menu->addAction(item.action);
            } else {
                menu->addSeparator();
            }
        }
    }
}

namespace {

bool isArrow(int key) {
    return key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Home || key == Qt::Key_End ||
           key == Qt::Key_PageUp || key == Qt::Key_PageDown;
}

bool needsKey(const QWidget* widget, int key) {
    if (qobject_cast<const QLineEdit*>(widget))
        return isArrow(key) || key == Qt::Key_Space || key == Qt::Key_Delete || key == Qt::Key_Backspace;
    if (qobject_cast<const QAbstractButton*>(widget)) return key == Qt::Key_Space;
    if (qobject_cast<const QAbstractSlider*>(widget) || qobject_cast<const QAbstractItemView*>(widget))
        return isArrow(key);
    if (qobject_cast<const QComboBox*>(widget)) return key == Qt::Key_Space || isArrow(key);
    return false;
}

/// The line of text of a field of a window (dialogs have keys of their own), or null.
QLineEdit* fieldOf(QWidget& widget) {
    if (!qobject_cast<QMainWindow*>(widget.window())) return nullptr;
    if (auto* spin = qobject_cast<QAbstractSpinBox*>(&widget)) return spin->findChild<QLineEdit*>();
    return qobject_cast<QLineEdit*>(&widget);
}

}  // namespace

namespace {

/// Whether a field needs a key with Ctrl or Alt for itself: the clipboard, and the words of its text.
/// Toolkits give fields more of them (Ctrl+K, Ctrl+U, Ctrl+E delete and move by lines), which are the
/// window's here.
bool belongsToText(const QKeyEvent& key) {
    for (const QKeySequence::StandardKey standard :
         {QKeySequence::Copy, QKeySequence::Cut, QKeySequence::Paste, QKeySequence::SelectAll})
        if (key.matches(standard)) return true;
    // AltGr types letters, and is Ctrl+Alt on some platforms.
    const bool isTyped = (key.modifiers() & Qt::ControlModifier) && (key.modifiers() & Qt::AltModifier) &&
                         !key.text().isEmpty() && key.text().at(0).isPrint();
    const bool isByWords =
        (key.modifiers() & Qt::ControlModifier) && !(key.modifiers() & Qt::AltModifier) &&
        (isArrow(key.key()) || key.key() == Qt::Key_Backspace || key.key() == Qt::Key_Delete);
    return isTyped || isByWords;
}

}  // namespace

/// True: the key is not offered to the window. An event that is ignored and not passed on goes to the window.
bool KeyGuard::overridesShortcut(QWidget& widget, QKeyEvent& key) {
    const QLineEdit* const field = fieldOf(widget);
    const auto* const text = qobject_cast<const QPlainTextEdit*>(&widget);
    const bool isUndo = key.matches(QKeySequence::Undo), isRedo = key.matches(QKeySequence::Redo);
    if ((isUndo || isRedo) && (field || text)) {
        const bool isOwn =
            field    ? field->isModified() && (isUndo ? field->isUndoAvailable() : field->isRedoAvailable())
            : isUndo ? text->document()->isUndoAvailable()
                     : text->document()->isRedoAvailable();
        key.setAccepted(isOwn);
        return true;
    }
    const bool isOfKeys = key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier);
    if ((field || text) && isOfKeys && !belongsToText(key)) {
        key.ignore();
        return true;
    }
    const bool isPlain = !(key.modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
    const bool isLeft = key.key() == Qt::Key_Escape && (field || text);
    if (isPlain && (isLeft || needsKey(&widget, key.key()))) {
        key.accept();
        return true;
    }
    return false;
}

/// Enter and Esc in a field; true if that is all there is to do.
bool KeyGuard::takesKey(QWidget& widget, const QKeyEvent& key) {
    QLineEdit* const field = fieldOf(widget);
    const bool isEnter = key.key() == Qt::Key_Return || key.key() == Qt::Key_Enter;
    if (isEnter && field) {  // after the field itself has taken it
        QTimer::singleShot(0, &widget, [&widget] { widget.clearFocus(); });
        return false;
    }
    if (key.key() != Qt::Key_Escape) return false;
    if (field) {
        while (field->isModified() && field->isUndoAvailable()) field->undo();
        widget.clearFocus();
        return true;
    }
    if (qobject_cast<QPlainTextEdit*>(&widget) && qobject_cast<QMainWindow*>(widget.window())) {
        widget.clearFocus();
        return true;
    }
    return false;
}

void KeyGuard::leaveField(const QWidget& pressed) {
    QWidget* const focus = QApplication::focusWidget();
    const QLineEdit* const field = focus ? fieldOf(*focus) : nullptr;
    const bool takesNoFocus =
        qobject_cast<const QAbstractButton*>(&pressed) && !(pressed.focusPolicy() & Qt::ClickFocus);
    if (field && field->isModified() && takesNoFocus && pressed.window() == focus->window() &&
        !focus->isAncestorOf(&pressed))
        focus->clearFocus();
}

/// Fields that scroll along under the pointer: choices and spin boxes, and sliders inside a panel that
/// scrolls.
bool KeyGuard::refusesWheel(const QWidget& widget) const {
    const bool isSlider = qobject_cast<const QSlider*>(&widget);
    if (!isSlider && !qobject_cast<const QComboBox*>(&widget) &&
        !qobject_cast<const QAbstractSpinBox*>(&widget))
        return false;
    if (widget.hasFocus()) return false;
    const QWidget* around = widget.parentWidget();
    while (isSlider && around && !qobject_cast<const QAbstractScrollArea*>(around))
        around = around->parentWidget();
    return around != nullptr;
}

bool KeyGuard::eventFilter(QObject* watched, QEvent* event) {
    auto* const widget = qobject_cast<QWidget*>(watched);
    if (!widget) return QObject::eventFilter(watched, event);
    switch (event->type()) {
        case QEvent::ShortcutOverride:
            if (widget == QApplication::focusWidget() && !widget->property("sharesKeys").toBool() &&
                overridesShortcut(*widget, *static_cast<QKeyEvent*>(event)))
                return true;
            break;
        case QEvent::KeyPress:
            if (widget == QApplication::focusWidget() && takesKey(*widget, *static_cast<QKeyEvent*>(event)))
                return true;
            break;
        case QEvent::MouseButtonPress: {
            const QPointer<QWidget> pressed(widget);
            leaveField(*widget);
            if (!pressed) return true;  // it has gone with what was typed
            break;
        }
        case QEvent::Polish:  // the wheel gives the focus to no field
            if (widget->focusPolicy() == Qt::WheelFocus) widget->setFocusPolicy(Qt::StrongFocus);
            break;
        case QEvent::Wheel:
            if (refusesWheel(*widget)) {
                event->ignore();  // goes on to what is around it
                return true;
            }
            break;
        case QEvent::FocusIn:
            if (static_cast<QFocusEvent*>(event)->reason() == Qt::MouseFocusReason)
                clicked_ = fieldOf(*widget);
            break;
        case QEvent::MouseButtonRelease:
            if (QLineEdit* const field = clicked_; field && fieldOf(*widget) == field) {
                if (!field->hasSelectedText()) QTimer::singleShot(0, field, &QLineEdit::selectAll);
                clicked_.clear();
            }
            break;
        default:
            break;
    }
    return QObject::eventFilter(watched, event);
}

}  // namespace extremal
