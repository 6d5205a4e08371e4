// SPDX-License-Identifier: GPL-3.0-or-later
/// A lesson above the plots: what to do next, with buttons that do it, go on and go back. Each step selects
/// its scheme, goes to its time and points at its plot. While there is no lesson it is hidden.
#pragma once

#include <QFrame>

#include <functional>
#include <string>
#include <vector>

#include "engine/scene/outlook/lesson_steps.hpp"

class QLabel;
class QPlainTextEdit;
class QPushButton;

namespace extremal {

class Playback;
class TextView;
class Workspace;

class LessonBar : public QFrame {
    Q_OBJECT
public:
    /// `viewInSight`: the id of the view of the plot that was clicked last; may be empty.
    LessonBar(Workspace& workspace, Playback& playback, std::function<std::string()> viewInSight,
              QWidget* parent = nullptr);

    /// Whether the scene has steps.
    bool hasLesson() const;
    /// From the first step; nothing where the scene has none.
    void start();
    void next();
    void back();
    void doStep();  ///< makes the edits of the step
    void end();
    /// The text of the step becomes a field; leaving it, or Ctrl+Return, takes what was written.
    void write();
    bool isWriting() const;
    bool isRunning() const { return at_ >= 0; }
    int at() const { return at_; }  ///< of the steps, from 0; -1: no lesson goes on
    const std::vector<LessonStep>& steps() const { return steps_; }

signals:
    void viewPointed(const QString& view);  ///< empty: none

private:
    void go(int step);
    void showState();
    void showScene();
    void makeMenu(QPushButton& button);
    void finishWriting();
    void editStep(const std::function<void(Value&)>& change, const QString& what);
    void moveStep(int by);
    void removeStep();
    bool eventFilter(QObject* watched, QEvent* event) override;

    Workspace& workspace_;
    Playback& playback_;
    std::vector<LessonStep> steps_;
    int at_ = -1;
    QLabel *place_, *state_;
    TextView* text_;
    QPlainTextEdit* edit_;
    std::function<std::string()> viewInSight_;
    QPushButton *back_, *do_, *next_;
};

}  // namespace extremal
