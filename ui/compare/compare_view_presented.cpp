// SPDX-License-Identifier: GPL-3.0-or-later
/// Which plots there are and in which order; the stage and one plot alone; the way from plot to plot by keys.
#include <QMenu>
#include <QScrollArea>

#include <algorithm>
#include <utility>

#include "engine/figure/panels.hpp"
#include "ui/base/card.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/compare/plot_edits.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal {

void CompareView::setPresented(bool isPresented) {
    if (isPresented && !std::exchange(isPresented_, true)) {
        const PlotWidget* const current = currentPlot();
        for (const auto& s : slots_)
            if (s->plot == current) presentedSlot_ = s->number;
        restore();
    }
    isPresented_ = isPresented;
    arrange();
}

void CompareView::showOtherPlot(int by) {
    const int count = static_cast<int>(slots_.size());
    if (count == 0) return;
    int now = by > 0 ? -1 : 0;
    for (int i = 0; i < count; ++i) {
        const Slot& s = *slots_[static_cast<std::size_t>(i)];
        if (isPresented_ ? s.number == presentedSlot_ : s.plot->hasFocus()) now = i;
    }
    const Slot& next = *slots_[static_cast<std::size_t>(((now + by) % count + count) % count)];
    presentedSlot_ = next.number;
    if (isPresented_) return arrange();
    restore();
    scroll_->ensureWidgetVisible(next.card);
    next.plot->setFocus(Qt::ShortcutFocusReason);
}

/// Which plots there are, their order and their scale, from the plot itself.
void CompareView::addPlaceActions(QMenu& menu, Slot& slot) {
    QAction* const scale = menu.addAction(tr("Logarithmic scale of y"), this, [this, &slot] {
        View after = slot.view;
        after.isLog = !slot.plot->figure().y.isLog;
        after.yRange = {};  // of the other scale
        workspace_.edit(editsForPlot(workspace_.scene(), slot.view, after), tr("Scale of a plot"));
    });
    scale->setCheckable(true);
    menu.addSeparator();
    const auto move = [&](const QString& text, int by) {
        return menu.addAction(text, this, [this, &slot, by] {
            workspace_.edit(editsForMovedPlot(workspace_.scene(), slot.view, by), tr("Move a plot"));
        });
    };
    QAction* const earlier = move(tr("Move it before the last plot"), -1);
    QAction* const later = move(tr("Move it behind the next plot"), 1);
    QAction* const hide = menu.addAction(tr("Hide this plot"), this, [this, &slot] {
        workspace_.edit(editsWithoutPlot(workspace_.scene(), slot.view), tr("Hide a plot"));
    });
    connect(&menu, &QMenu::aboutToShow, this, [this, &slot, scale, earlier, later, hide] {
        const Figure& figure = slot.plot->figure();
        scale->setChecked(figure.y.isLog);
        scale->setEnabled(canHaveScale(figure, !figure.y.isLog));
        earlier->setEnabled(!editsForMovedPlot(workspace_.scene(), slot.view, -1).empty());
        later->setEnabled(!editsForMovedPlot(workspace_.scene(), slot.view, 1).empty());
        hide->setEnabled(slot.view.id != "work-precision");
    });
}

Figure CompareView::inTimes(const Figure& whole) const {
    return times_ && isPortrait(whole) ? withinTimes(whole, times_->low, times_->high) : whole;
}

/// Portraits show what happens while the plots over time do: their axes and their zoom stay.
void CompareView::showTimes(std::optional<PlotRange> range) {
    if (std::exchange(times_, range) == range) return;
    for (const auto& s : slots_)
        if (s->whole) s->plot->setFigure(inTimes(*s->whole));
}

}  // namespace extremal
