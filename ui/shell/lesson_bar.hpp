// SPDX-License-Identifier: GPL-3.0-or-later
/// A lesson above the plots: what to do next, with buttons that do it, go on and go back. Each step selects
/// its scheme, goes to its time and points at its plot. While there is no lesson it is hidden.
#pragma once

#include <QFrame>

#include <vector>

#include "engine/scene/outlook/lesson_steps.hpp"

class QLabel;
class QPushButton;

namespace extremal {

class Playback;
class TextView;
class Workspace;

class LessonBar : public QFrame {
    Q_OBJECT
public:
    LessonBar(Workspace& workspace, Playback& playback, QWidget* parent = nullptr);

    /// Whether the scene has steps.
    bool hasLesson() const;
    /// From the first step; nothing where the scene has none.
    void start();
    void next();
    void back();
    void doStep();  ///< makes the edits of the step
    void end();
    bool isRunning() const { return at_ >= 0; }
    int at() const { return at_; }  ///< of the steps, from 0; -1: no lesson goes on
    const std::vector<LessonStep>& steps() const { return steps_; }

signals:
    void viewPointed(const QString& view);  ///< empty: none

private:
    void go(int step);
    void showState();

    Workspace& workspace_;
    Playback& playback_;
    std::vector<LessonStep> steps_;
    int at_ = -1;
    QLabel *place_, *state_;
    TextView* text_;
    QPushButton *back_, *do_, *next_;
};

}  // namespace extremal
