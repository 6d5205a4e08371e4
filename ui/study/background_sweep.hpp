// SPDX-License-Identifier: GPL-3.0-or-later
/// The schemes of the scene over a few steps around their own, run in the background once a run is over: the
/// lines of "speed against accuracy". Runs that take long are not repeated, and a scheme keeps what was
/// measured as long as neither it nor the problem changes.
#pragma once

#include <QObject>
#include <QTimer>

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/scene/scene.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

class RunControl;

/// A scheme at one step, or tolerance.
struct SweptPoint {
    double step = 0, seconds = 0, error = 0;
};

struct SweptScheme {
    SchemeSpec spec;
    int style = 0;
    std::vector<SweptPoint> points;  ///< from the largest step down; of runs that came to their end
    Sweep::ErrorRange judged = {};   ///< others are not on the front
};

class BackgroundSweep : public QObject {
    Q_OBJECT
public:
    explicit BackgroundSweep(RunControl& run, QObject* parent = nullptr);
    ~BackgroundSweep() override;
    /// Of the schemes of the present results, as they are there; empty until it is known.
    std::vector<SweptScheme> known() const;
    /// Adds their lines to the figure of the view `work-precision`, in place of those it has, and the Pareto
    /// front of all points.
    void addLines(Figure& figure) const;

signals:
    void changed();

private:
    void start();
    void keep(const Scene& problem, std::vector<SweptScheme> swept);

    RunControl& run_;
    QTimer pause_;
    Scene problem_;  ///< what was swept, without its schemes and views
    std::vector<SweptScheme> swept_;
    std::stop_source stop_{std::nostopstate};
};

}  // namespace extremal
