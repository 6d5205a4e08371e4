/// The row at the top: what is open, the wanted error and what it would cost, and the main buttons.
#pragma once

#include <QWidget>

#include <vector>

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

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void showScene();
    void showState();
    void showChoice();

    Workspace& workspace_;
    RunControl& run_;
    QLabel *title_, *file_, *choice_;
    std::vector<QPushButton*> secondary_;  ///< which a narrow window does without
    QSlider* wanted_;
    QPushButton* runButton_;
};

}  // namespace extremal
