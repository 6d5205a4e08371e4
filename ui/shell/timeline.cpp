// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/shell/timeline.hpp"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include <algorithm>
#include <cmath>

#include "ui/base/card.hpp"
#include "ui/base/combo_box.hpp"
#include "ui/base/seek_slider.hpp"
#include "ui/workspace/playback.hpp"

namespace extremal {
namespace {
constexpr int resolution = 10000;
}

Timeline::Timeline(Playback& playback, QWidget* parent) : QWidget(parent), playback_(playback) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 2, 0, 2);
    row->setSpacing(10);
    play_ = new QPushButton(tr("Play"), this);
    play_->setProperty("kind", "flat");
    play_->setToolTip(tr("Play or pause (Space)"));
    play_->setProperty("room", "play");
    slider_ = new SeekSlider(Qt::Horizontal, this);
    slider_->setRange(0, resolution);
    slider_->setAccessibleName(tr("Time"));
    label_ = makeElidedLabel({}, "caption", this);
    slider_->setMinimumWidth(48);  // the label gives way first
    speed_ = new ComboBox(this);
    speed_->setAccessibleName(tr("Speed"));
    speed_->setAccessibleDescription(tr("Speed"));  // the name of a box is read as its text
    speed_->setObjectName("speed");
    for (const double s : {0.1, 0.25, 0.5, 1.0, 2.0, 4.0}) speed_->addItem(QStringLiteral("%1×").arg(s), s);
    speed_->setCurrentIndex(3);
    row->addWidget(play_);
    row->addWidget(slider_, 1);
    row->addWidget(label_);
    row->addWidget(speed_);
    connect(play_, &QPushButton::clicked, this, [this] { playback_.setPlaying(!playback_.isPlaying()); });
    connect(slider_, &QSlider::valueChanged, this, [this](int value) {
        if (isShowing_) return;
        playback_.setTime(playback_.start() + (playback_.end() - playback_.start()) * value / resolution);
    });
    connect(speed_, &QComboBox::currentIndexChanged, this,
            [this] { playback_.setSpeed(speed_->currentData().toDouble()); });
    connect(&playback_, &Playback::timeChanged, this, &Timeline::showTime);
    connect(&playback_, &Playback::rangeChanged, this, &Timeline::showTime);
    connect(&playback_, &Playback::playingChanged, this,
            [this](bool plays) { play_->setText(plays ? tr("Pause") : tr("Play")); });
    showTime();
}

void Timeline::setUnit(const QString& unit) {
    unit_ = unit;
    showTime();
}

void Timeline::showTime() {
    isShowing_ = true;
    const double length = playback_.end() - playback_.start();
    const double f = length > 0 ? (playback_.time() - playback_.start()) / length : 0;
    slider_->setValue(static_cast<int>(std::lround(f * resolution)));
    isShowing_ = false;
    const int decimals =
        length > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(length / 10))), 0, 6) : 2;
    QString text =
        QStringLiteral("t = %1 / %2").arg(playback_.time(), 0, 'f', decimals).arg(playback_.end(), 0, 'g', 6);
    if (playback_.computedEnd() < playback_.end() - 1e-9 * std::abs(length))
        text += tr(", computed to %1").arg(playback_.computedEnd(), 0, 'g', 4);
    if (!unit_.isEmpty()) text += ' ' + unit_;
    label_->setText(text);
    slider_->setAccessibleDescription(text);
}

}  // namespace extremal
