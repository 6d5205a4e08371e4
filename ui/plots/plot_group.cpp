// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/plots/plot_group.hpp"

#include "ui/plots/plot_widget.hpp"

namespace extremal {

void PlotGroup::add(PlotWidget* plot) {
    plots_.append(plot);
    plot->setCursor(cursor_);
    plot->setPinned(pinned_);
    if (timeRange_) plot->setTimeRange(timeRange_);
    connect(plot, &QObject::destroyed, this, [this, plot] { plots_.removeAll(plot); });
    connect(plot, &PlotWidget::cursorMoved, this, &PlotGroup::cursorMoved);
    connect(plot, &PlotWidget::hoverMoved, this, [this](std::optional<double> t) {
        for (PlotWidget* p : plots_) p->setHover(t);
    });
    connect(plot, &PlotWidget::pointClicked, this, &PlotGroup::pointClicked);
    connect(plot, &PlotWidget::saveFailed, this, &PlotGroup::saveFailed);
    connect(plot, &PlotWidget::pinRequested, this, &PlotGroup::setPinned);
    connect(plot, &PlotWidget::timeRangeChanged, this, [this, plot](std::optional<PlotRange> range) {
        timeRange_ = range;
        for (PlotWidget* p : plots_)
            if (p != plot) p->setTimeRange(range);
        emit timeRangeChanged(range);
    });
}

void PlotGroup::remove(PlotWidget* plot) {
    plots_.removeAll(plot);
    plot->disconnect(this);
}

void PlotGroup::setCursor(std::optional<double> t) {
    cursor_ = t;
    for (PlotWidget* p : plots_) p->setCursor(t);
}

void PlotGroup::setPinned(std::optional<double> t) {
    pinned_ = t;
    for (PlotWidget* p : plots_) p->setPinned(t);
}

void PlotGroup::fitAll() {
    for (PlotWidget* p : plots_) p->fit();
}

}  // namespace extremal
