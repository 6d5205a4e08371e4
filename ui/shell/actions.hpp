// SPDX-License-Identifier: GPL-3.0-or-later
/// The registry of everything the window can do: the menus, the command palette and the key list come from
/// it.
#pragma once

#include <QAction>
#include <QKeySequence>
#include <QList>
#include <QObject>
#include <QPointer>
#include <functional>

class QKeyEvent;
class QLineEdit;
class QMenuBar;
class QWidget;

namespace extremal {

class Actions : public QObject {
    Q_OBJECT
public:
    explicit Actions(QWidget& window);

    /// Adds an action to a menu ("File", "Edit", ...); menus stand in the order of their first action. The
    /// action belongs to the window, so that its keys work everywhere in it.
    QAction* add(const QString& id, const QString& menu, const QString& text, const QList<QKeySequence>& keys,
                 std::function<void()> act, const QString& tip = {});
    /// A line between the actions of a menu.
    void addSeparator(const QString& menu);
    /// A submenu filled by someone else, such as the recent files.
    void addSubmenu(const QString& menu, QMenu* submenu);

    /// Names the actions that need no scene. All others are of the scene, and off while it is not in sight:
    /// their keys would change what cannot be seen.
    void keepWithoutScene(const QStringList& ids) { withoutScene_ = ids; }
    void setSceneInSight(bool isInSight);

    QAction* find(const QString& id) const;
    const QList<QAction*>& all() const { return all_; }
    static QString menuOf(const QAction* action);

    void fill(QMenuBar& bar) const;

private:
    struct Item {
        QString menu;
        QAction* action = nullptr;  ///< null: a separator or a submenu
        QMenu* submenu = nullptr;
    };
    QWidget& window_;
    QList<QAction*> all_;
    QList<Item> items_;
    QStringList menus_, withoutScene_;
};

/// Makes all fields of the window answer to keys alike. Install it on the application.
///
/// Single keys are kept for the widget that has the focus where it needs them: text fields get letters,
/// buttons get Space, lists get arrows. A click into a field selects its text; Enter takes it and leaves the
/// field; Esc brings back the text from before and leaves it. Undo in a field is that of the field while
/// there is something typed and not taken, else that of the window.
///
/// A press of a button that takes no focus leaves the field first, so that what is typed there is taken
/// before the button acts.
///
/// The wheel changes a field only where a click or a key has given it the focus; elsewhere it scrolls what is
/// around the field.
class KeyGuard : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    bool overridesShortcut(QWidget& widget, QKeyEvent& key);
    bool takesKey(QWidget& widget, const QKeyEvent& key);
    static void leaveField(const QWidget& pressed);
    bool refusesWheel(const QWidget& widget) const;
    QPointer<QLineEdit> clicked_;  ///< a field that has just got the focus by a click
};

}  // namespace extremal
