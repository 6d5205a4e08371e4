// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/playback.hpp"

#include <algorithm>

namespace extremal {

namespace {
constexpr int frameMs = 33;
constexpr double wholeIntervalSeconds = 12;
}  // namespace

Playback::Playback(QObject* parent) : QObject(parent) {
    timer_.setInterval(frameMs);
    connect(&timer_, &QTimer::timeout, this, &Playback::tick);
}

void Playback::setRange(double start, double end) {
    if (start == start_ && end == end_) return;
    start_ = start;
    end_ = end;
    computedEnd_ = std::clamp(computedEnd_, start_, end_);
    followsEnd_ = true;
    stop_.reset();
    time_ = computedEnd_;
    emit rangeChanged();
    emit timeChanged(time_);
}

void Playback::setComputedEnd(double t) {
    t = std::clamp(t, start_, end_);
    if (t == computedEnd_) return;
    computedEnd_ = t;
    emit rangeChanged();
    if (stop_ && t >= std::clamp(*stop_, start_, end_)) return setTime(*stop_);
    if (followsEnd_ && !isPlaying()) {
        time_ = t;
        emit timeChanged(time_);
    }
}

void Playback::setTime(double t) {
    stop_.reset();
    t = std::clamp(t, start_, std::max(start_, computedEnd_));
    followsEnd_ = t >= computedEnd_;
    if (t == time_) return;
    time_ = t;
    emit timeChanged(time_);
}

void Playback::stopAt(double t) {
    setPlaying(false);
    if (t <= computedEnd_) return setTime(t);
    setTime(computedEnd_);
    stop_ = t;
}

void Playback::setPlaying(bool plays) {
    if (plays == isPlaying()) return;
    stop_.reset();
    if (plays) {
        if (time_ >= computedEnd_) setTime(start_);
        sinceTick_.start();
        timer_.start();
    } else {
        timer_.stop();
    }
    emit playingChanged(plays);
}

void Playback::setSpeed(double factor) {
    if (factor == speed_) return;
    speed_ = factor;
    emit speedChanged(speed_);
}

void Playback::tick() {
    const double seconds = std::min(0.2, static_cast<double>(sinceTick_.restart()) * 1e-3);
    const double next = time_ + speed_ * seconds * (end_ - start_) / wholeIntervalSeconds;
    setTime(next);
    if (next >= computedEnd_ && computedEnd_ >= end_) setPlaying(false);
}

}  // namespace extremal
