// SPDX-License-Identifier: GPL-3.0-or-later
/// What tests of the whole window begin with.
#pragma once

#include <QTest>

#include "tests/tools/slowdown.hpp"
#include "ui/compare/compare_view.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/shell/main_window.hpp"
#include "ui/workspace/run_control.hpp"

namespace extremal {

/// Until the run of the present scene is over, the plots show it, and the discretizer has its cells.
inline bool waitForResults(MainWindow& window) {
    return QTest::qWaitFor(
        [&] {
            return window.runControl().state() == RunControl::State::finished &&
                   !window.runControl().isStale() && window.compareView().isCurrent() &&
                   window.discretizer().isCurrent();
        },
        120000 * tests::slowdown);
}

/// The first plot of a view; null: the scene has no such plot.
inline PlotWidget* plotOf(MainWindow& window, const std::string& view) {
    for (PlotWidget* plot : window.compareView().plots())
        if (plot->figure().view == view) return plot;
    return nullptr;
}

}  // namespace extremal
