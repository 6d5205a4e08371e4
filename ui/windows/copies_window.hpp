// SPDX-License-Identifier: GPL-3.0-or-later
/// Perturb and watch: the motion of the selected scheme and a copy that starts a little apart, on one stage,
/// with their distance below it. It follows the time of the window.
#pragma once

#include <QWidget>

#include "ui/base/theme.hpp"

class QLabel;
class QSpinBox;

namespace extremal {

class Playback;
class PlotWidget;
struct Separation;
class StageWidget;
class Workspace;

class CopiesWindow : public QWidget {
    Q_OBJECT
public:
    CopiesWindow(Workspace& workspace, Playback& playback, const Theme& theme, QWidget* parent = nullptr);
    void open();
    void setTheme(const Theme& theme);
    bool isCurrent() const { return !isWaiting_; }
    const PlotWidget& plot() const { return *plot_; }

private:
    void compute();
    void show(const Separation& separation);

    Workspace& workspace_;
    Playback& playback_;
    QLabel* title_;
    QSpinBox* digits_;
    StageWidget* stage_;
    PlotWidget* plot_;
    int asked_ = 0;  ///< computations so far: only the last one is shown
    bool isWaiting_ = false;
};

}  // namespace extremal
