// SPDX-License-Identifier: GPL-3.0-or-later
/// The time that is shown: a cursor independent of the running computation.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>

#include "engine/run/comparison.hpp"

namespace extremal {

class Playback : public QObject {
    Q_OBJECT
public:
    explicit Playback(QObject* parent = nullptr);

    double time() const { return time_; }
    double start() const { return start_; }
    double end() const { return end_; }
    double computedEnd() const { return computedEnd_; }  ///< some scheme has been computed up to here
    bool isPlaying() const { return timer_.isActive(); }
    double speed() const { return speed_; }

    void setRange(double start, double end);  ///< another scene: the cursor goes to its end until it is moved
    void setComputedEnd(double t);
    void setTime(double t);
    /// Stops at a time, as soon as it has been computed; until then a cursor that is moved stays where it is.
    void stopAt(double t);
    void setPlaying(bool plays);
    void setSpeed(double factor);  ///< 1: the whole interval in about twelve seconds
    void stepBy(int nodes, double step) { setTime(time_ + nodes * step); }

signals:
    void timeChanged(double t);
    void rangeChanged();
    void playingChanged(bool plays);
    void speedChanged(double factor);

private:
    void tick();

    double time_ = 0, start_ = 0, end_ = 1, computedEnd_ = 0, speed_ = 1;
    bool followsEnd_ = true;
    std::optional<double> stop_;  ///< that is not computed yet
    QTimer timer_;
    QElapsedTimer sinceTick_;
};

}  // namespace extremal
