// SPDX-License-Identifier: GPL-3.0-or-later
/// A race of the schemes of the scene: a stage for each, all with the same processor time, and the wanted
/// error as the finish line (study/search/race.hpp).
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>

#include <vector>

#include "engine/study/search/race.hpp"
#include "ui/base/theme.hpp"

class QGridLayout;
class QLabel;
class QProgressBar;
class QPushButton;
class QSlider;

namespace extremal {

class Card;
class RunControl;
class StageWidget;
class Wanted;

class RaceWindow : public QWidget {
    Q_OBJECT
public:
    RaceWindow(RunControl& run, Wanted& wanted, const Theme& theme, QWidget* parent = nullptr);
    void open();  ///< with the present results, from the start
    void setTheme(const Theme& theme);
    void setSpent(double share);  ///< of the time that the slowest needs, 0 to 1
    /// What stands below each stage.
    QStringList verdicts() const;

private:
    struct Lane {
        Card* card;
        StageWidget* stage;
        QProgressBar* bar;
        QLabel* verdict;
    };
    void build();
    void show();
    void setPlaying(bool plays);

    RunControl& run_;
    Wanted& error_;
    Theme theme_;
    std::vector<Runner> runners_;
    std::vector<Lane> lanes_;
    double longest_ = 0;  ///< seconds of the slowest
    QGridLayout* grid_;
    QLabel *spent_, *wanted_;
    QSlider *share_, *digits_;
    QPushButton* play_;
    QTimer timer_;
    QElapsedTimer sinceTick_;
};

}  // namespace extremal
