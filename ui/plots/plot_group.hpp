// SPDX-License-Identifier: GPL-3.0-or-later
/// Plots that belong together: one time axis, one cursor, aligned left margins in each column.
#pragma once

#include <QList>
#include <QObject>

#include <optional>

#include "ui/plots/view_state.hpp"

namespace extremal {

class PlotWidget;

class PlotGroup : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    void add(PlotWidget* plot);  ///< a plot that is deleted leaves by itself
    void remove(PlotWidget* plot);
    void setCursor(std::optional<double> t);
    void setPinned(std::optional<double> t);  ///< the second cursor
    std::optional<double> pinned() const { return pinned_; }
    void fitAll();
    void forget() { timeRange_.reset(); }  ///< what new plots would take over
    const QList<PlotWidget*>& plots() const { return plots_; }

signals:
    void cursorMoved(double t);
    void pointClicked(int style);
    void timeRangeChanged(std::optional<PlotRange> range);  ///< of all plots over time; none: all times
    void saveFailed(const QString& reason);

private:
    QList<PlotWidget*> plots_;
    std::optional<double> cursor_, pinned_;
    std::optional<PlotRange> timeRange_;  ///< chosen by the user; plots that join take it
};

}  // namespace extremal
