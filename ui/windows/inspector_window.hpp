// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of the selected scheme beside the window, at the time of the cursor: plots of it, and its
/// equations. It follows the time, the selection and the results.
#pragma once

#include <QTimer>
#include <QWidget>

#include <memory>
#include <stop_token>
#include <vector>

#include "ui/base/theme.hpp"

class QGridLayout;
class QLabel;

namespace extremal {

class Playback;
class PlotWidget;
class RunControl;
struct StepInspection;
class TextView;
class Workspace;

class InspectorWindow : public QWidget {
    Q_OBJECT
public:
    InspectorWindow(Workspace& workspace, RunControl& run, Playback& playback, const Theme& theme,
                    QWidget* parent = nullptr);
    ~InspectorWindow() override;
    void open();
    void setTheme(const Theme& theme);
    /// Whether it shows the step of the present time, scheme and results.
    bool isCurrent() const { return !isWaiting_ && !timer_.isActive(); }
    std::vector<PlotWidget*> plots() const { return plots_; }

signals:
    void shown();  ///< a step, or why there is none

private:
    void inspect();
    void show(const StepInspection& step);
    void say(const QString& text);

    Workspace& workspace_;
    RunControl& run_;
    Playback& playback_;
    Theme theme_;
    QLabel* title_;
    QGridLayout* grid_;
    TextView* text_;
    std::vector<PlotWidget*> plots_;
    QTimer timer_;  ///< changes that follow each other are shown once
    std::stop_source stop_{std::nostopstate};
    bool isWaiting_ = false;
};

}  // namespace extremal
