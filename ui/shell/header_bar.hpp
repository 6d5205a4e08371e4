/// The row at the top: what is open, the wanted error and what it would cost, and the main buttons.
#pragma once

#include <QWidget>

class QLabel;
class QPushButton;
class QSlider;

namespace extremal {

class Playback;
class RunControl;
class Workspace;

class HeaderBar : public QWidget {
    Q_OBJECT
public:
    HeaderBar(Workspace& workspace, RunControl& run, QWidget* parent = nullptr);

signals:
    void runRequested();
    void stopRequested();
    void stepRequested();
    void exportRequested();
    void paletteRequested();

private:
    void showScene();
    void showState();
    void showChoice();

    Workspace& workspace_;
    RunControl& run_;
    QLabel *title_, *file_, *choice_;
    QSlider* wanted_;
    QPushButton* runButton_;
};

}  // namespace extremal
