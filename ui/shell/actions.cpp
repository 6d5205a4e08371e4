#include "ui/shell/actions.hpp"

#include <QAbstractButton>
#include <QAbstractItemView>
#include <QAbstractSlider>
#include <QApplication>
#include <QComboBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>

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

QString Actions::menuOf(const QAction* action) { return action->data().toString(); }

void Actions::fill(QMenuBar& bar) const {
    for (const QString& name : menus_) {
        QMenu* menu = bar.addMenu(name);
        for (const Item& item : items_) {
            if (item.menu != name) continue;
            if (item.submenu)
                menu->addMenu(item.submenu);
            else if (item.action)
                menu->addAction(item.action);
            else
                menu->addSeparator();
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

}  // namespace

bool KeyGuard::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        const auto* key = static_cast<const QKeyEvent*>(event);
        const auto* widget = qobject_cast<const QWidget*>(watched);
        const bool isPlain = !(key->modifiers() & (Qt::ControlModifier | Qt::AltModifier | Qt::MetaModifier));
        const bool keeps =
            widget && widget == QApplication::focusWidget() && !widget->property("sharesKeys").toBool();
        if (isPlain && keeps && needsKey(widget, key->key())) {
            event->accept();
            return true;
        }
    }
    return QObject::eventFilter(watched, event);
}

}  // namespace extremal
