// SPDX-License-Identifier: GPL-3.0-or-later
/// Records a lesson: what is done becomes its steps. Each step has a sentence, the plot that was looked at,
/// the scheme that is selected, the time of the cursor where the motion stands still, and the changes of the
/// scene since the step before, which the reader is then asked to make. At the end the scene is again what it
/// was at the beginning, with the steps; all of it is one edit.
#pragma once

#include <QFrame>

#include <functional>
#include <string>

#include "engine/core/value.hpp"

class QLabel;
class QLineEdit;

namespace extremal {

class Playback;
class Workspace;

class RecordBar : public QFrame {
    Q_OBJECT
public:
    /// `viewInSight`: the id of the view of the plot that was clicked last; may be empty.
    RecordBar(Workspace& workspace, Playback& playback, std::function<std::string()> viewInSight,
              QWidget* parent = nullptr);

    bool isRecording() const { return !before_.isNull(); }
    void start();
    /// Adds a step; without a sentence it names the changes.
    void recordStep();
    /// Ends it; without any step nothing changes.
    void finish();
    /// Ends it without a lesson; the scene stays as it is now.
    void cancel();

private:
    Value stepNow() const;
    void show();

    Workspace& workspace_;
    Playback& playback_;
    std::function<std::string()> viewInSight_;
    Value before_;  ///< the scene at the beginning; null: nothing is recorded
    Value last_;    ///< at the last step
    Value::Array steps_;
    QLabel* count_;
    QLineEdit* text_;
};

}  // namespace extremal
