// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers of the scene from measurements, beside the window: a file is dropped or chosen, the numbers that
/// may move are ticked, and the fit is watched as it converges. What comes of it goes into the scene as one
/// edit, and stays here with deviations, correlations and residuals.
#pragma once

#include <QWidget>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/scene/scene.hpp"
#include "engine/study/fit/measured_data.hpp"
#include "ui/base/theme.hpp"

class QLabel;
class QPushButton;
class QTableWidget;
class QVBoxLayout;

namespace extremal {

struct Figure;
class FitJob;
class Notices;
class PlotWidget;
class Workspace;

class FitWindow : public QWidget {
    Q_OBJECT
public:
    FitWindow(Workspace& workspace, Notices& notices, const Theme& theme, QWidget* parent = nullptr);
    /// Asks for a file where there is none yet.
    void open();
    /// With the measurements of a file; says in a notice why it has none.
    void open(const QString& path);
    bool isRunning() const;
    bool stop();  ///< false: nothing was fitted
    void setTheme(const Theme& theme);
    std::vector<PlotWidget*> plots() const { return plots_; }

private:
    void chooseFile();
    QWidget* makeNumbers();
    void fillNumbers();
    void startOrStop();
    void showButton();
    void showStep();
    void showEnd();
    void applyAnswer();
    std::vector<std::string> ticked() const;
    void setCell(int row, int column, const QString& text);
    int rowOf(const std::string& pointer) const;
    void showPlots(const std::vector<Figure>& figures);
    std::vector<Figure> measuredFigures(const std::vector<double>& computed) const;

    Workspace& workspace_;
    Notices& notices_;
    Theme theme_;
    FitJob* job_;
    std::shared_ptr<const MeasuredData> data_;
    std::vector<NumberOfScene> numbers_;
    std::optional<Scene> fitted_;  ///< whose numbers were fitted last
    bool isApplying_ = false;
    QLabel *title_, *about_, *state_, *found_;
    QTableWidget* table_;
    QPushButton *file_, *start_;
    QVBoxLayout* column_;
    std::vector<PlotWidget*> plots_;
};

}  // namespace extremal
