// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/plain_tips.hpp"

#include <QAbstractItemView>
#include <QAction>
#include <QApplication>
#include <QHeaderView>
#include <QHelpEvent>
#include <QMenu>
#include <QTabBar>
#include <QToolTip>

namespace extremal {
namespace {

QString tipOfItem(const QAbstractItemView& view, QPoint at) {
    if (const auto* header = qobject_cast<const QHeaderView*>(&view)) {
        const int section = header->logicalIndexAt(at);
        return header->model() && section >= 0
                   ? header->model()->headerData(section, header->orientation(), Qt::ToolTipRole).toString()
                   : QString();
    }
    return view.indexAt(at).data(Qt::ToolTipRole).toString();
}

/// What Qt would show for the event: the tip of the part at the place, or of the widget.
QString tipAt(const QWidget& widget, QPoint at) {
    if (const auto* menu = qobject_cast<const QMenu*>(&widget)) {
        const QAction* action = menu->toolTipsVisible() ? menu->actionAt(at) : nullptr;
        return action ? action->toolTip() : QString();
    }
    if (const auto* tabs = qobject_cast<const QTabBar*>(&widget))
        if (const int tab = tabs->tabAt(at); tab >= 0 && !tabs->tabToolTip(tab).isEmpty())
            return tabs->tabToolTip(tab);
    if (const auto* view = qobject_cast<const QAbstractItemView*>(widget.parentWidget()))
        if (view->viewport() == &widget)
            if (const QString tip = tipOfItem(*view, at); !tip.isEmpty()) return tip;
    return widget.toolTip();
}

class PlainTips : public QObject {
public:
    using QObject::QObject;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() != QEvent::ToolTip) return false;
        auto* const widget = qobject_cast<QWidget*>(watched);
        if (!widget) return false;
        const auto* help = static_cast<const QHelpEvent*>(event);
        const QString tip = tipAt(*widget, help->pos());
        if (!Qt::mightBeRichText(tip)) return false;  // Qt shows it, and shows it as it is
        QToolTip::showText(help->globalPos(), plainTip(tip), widget);
        return true;
    }
};

}  // namespace

QString plainTip(const QString& text) {
    return Qt::mightBeRichText(text) ? Qt::convertFromPlainText(text, Qt::WhiteSpaceNormal) : text;
}

void showTipsAsPlainText(QApplication& application) {
    constexpr const char* isSet = "hasPlainTips";
    if (application.property(isSet).toBool()) return;
    application.setProperty(isSet, true);
    application.installEventFilter(new PlainTips(&application));
}

}  // namespace extremal
