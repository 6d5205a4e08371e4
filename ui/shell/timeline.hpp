// SPDX-License-Identifier: GPL-3.0-or-later
/// The timeline: play, a slider over the time interval with what is computed so far, the time, the speed.
#pragma once

#include <QWidget>

class QComboBox;
class QLabel;
class QPushButton;
class QSlider;

namespace extremal {

class Playback;

class Timeline : public QWidget {
    Q_OBJECT
public:
    explicit Timeline(Playback& playback, QWidget* parent = nullptr);
    void setUnit(const QString& unit);

private:
    void showTime();

    Playback& playback_;
    QString unit_;
    QPushButton* play_;
    QSlider* slider_;
    QLabel* label_;
    QComboBox* speed_;
    bool isShowing_ = false;
};

}  // namespace extremal
