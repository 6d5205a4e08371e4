// SPDX-License-Identifier: GPL-3.0-or-later
/// The row at the top: what is open, the wanted error and what it would cost, and the main buttons.
#pragma once

#include <QWidget>

#include <string>
#include <vector>

class QHBoxLayout;
class QLabel;
class QLineEdit;
class QPushButton;
class QSlider;

namespace extremal {

class BackgroundSweep;
class Playback;
class RunControl;
class Wanted;
class Workspace;

class HeaderBar : public QWidget {
    Q_OBJECT
public:
    HeaderBar(Workspace& workspace, RunControl& run, const BackgroundSweep& sweep, Wanted& wanted,
              QWidget* parent = nullptr);
    /// While the scene is not in sight, nothing here acts on it.
    void setSceneInSight(bool isInSight);

signals:
    void runRequested();
    void stopRequested();
    void stepRequested();
    void exportRequested();
    void paletteRequested();

protected:
    void resizeEvent(QResizeEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void writeTitle();
    void takeTitle();
    void makeWanted(QHBoxLayout& row);
    void makeButtons(QHBoxLayout& row);
    void showScene();
    void showState();
    void showWanted();
    void showChoice();
    bool offersReference() const;
    void computeReference();
    void useChoice();

    Workspace& workspace_;
    RunControl& run_;
    const BackgroundSweep& sweep_;
    Wanted& error_;
    QLabel *title_, *file_, *choice_;
    QLineEdit* titleEdit_;                 ///< in its place after a click
    std::vector<QPushButton*> secondary_;  ///< which a narrow window does without
    QSlider* wanted_;
    QPushButton *runButton_, *use_;
    std::string chosen_;  ///< label of the scheme that is proposed with another step; empty: none is
    bool isSceneInSight_ = false;
    double chosenStep_ = 0;  ///< or tolerance
};

}  // namespace extremal
