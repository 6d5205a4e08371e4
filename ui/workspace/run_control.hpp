// SPDX-License-Identifier: GPL-3.0-or-later
/// The run of the current scene: starts automatically after an edit, cancels a run that has become stale, and
/// keeps the latest results. Only what an edit touches is computed: results that still hold are shown at
/// once, also those of schemes that were switched off. Nothing of the engine's work happens on this thread;
/// results are fetched by a timer.
#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "engine/run/comparison.hpp"
#include "engine/run/run.hpp"
#include "ui/workspace/cost_trial.hpp"
#include "ui/workspace/result_store.hpp"

namespace extremal {

class Notices;
class Workspace;

/// Expected seconds of a scene, from what its schemes cost per step so far; schemes not seen yet use an
/// estimate.
class CostModel {
public:
    void learn(const Comparison& comparison);
    void learn(const Scene& scene, const TrialCosts& trial);
    double predict(const Scene& scene) const;  ///< of its enabled schemes
    /// Whether no scheme is estimated without a measurement.
    bool knows(const Scene& scene) const;
    bool knows(const Scene& scene, const SchemeSpec& spec) const { return find(scene, spec) != nullptr; }
    /// The scheme with the largest part, and its seconds.
    std::pair<std::string, double> largestPart(const Scene& scene) const;

private:
    struct Known {
        SchemeSpec spec;
        Settings model;
        double secondsPerStep;
    };
    const Known* find(const Scene& scene, const SchemeSpec& spec) const;
    void keep(Known known);
    double secondsOf(const Scene& scene, const SchemeSpec& spec, double stepsInMaps) const;

    std::vector<Known> known_;
};

class RunControl : public QObject {
    Q_OBJECT
public:
    enum class State { idle, scheduled, offered, running, stopped, finished };

    RunControl(Workspace& workspace, Notices& notices, QObject* parent = nullptr);
    ~RunControl() override;

    State state() const { return state_; }
    bool isRunning() const { return state_ == State::running; }
    /// What was computed last, possibly of an earlier version of the scene; null before the first results.
    std::shared_ptr<const Comparison> results() const { return results_; }
    /// The results belong to an earlier version of the scene.
    bool isStale() const { return isStale_; }
    double fraction() const;                                          ///< of the work of the present run
    bool isPreparing() const { return run_ && run_->isPreparing(); }  ///< the reference is computed

    void start();  ///< computes everything, also what is known
    void stop();

    /// Above this prediction a run waits for the user.
    static constexpr double askAboveSeconds = 3;

signals:
    void resultsChanged();
    void stateChanged();
    void progressed();  ///< fraction() has come to another per cent
    void finished();    ///< a run came to its end, all results are there

private:
    void sceneChanged();
    void compute(bool usesKnown);
    bool isCoveredByRun(const Scene& scene) const;
    std::optional<Comparison> known(const Scene& scene) const;
    bool takeNames(Comparison& latest) const;
    void poll();
    void retire();
    void decide();
    void decideWith(const Scene& wanted, double referenceSeconds);
    void offer(double seconds, const std::string& largest, double ofLargest);
    void setState(State state);

    Workspace& workspace_;
    Notices& notices_;
    State state_ = State::idle;
    std::stop_source trial_{std::nostopstate};
    std::unique_ptr<Run> run_;
    Scene runScene_;  ///< of run_
    bool wasStopped_ = false;
    ResultStore store_;
    std::vector<std::unique_ptr<Run>> stopping_;  ///< stopped, not yet ended: their destructor would wait
    std::shared_ptr<const Comparison> results_;
    std::optional<Scene> lastScene_;
    bool isStale_ = false;
    long shownPercent_ = -1;
    CostModel cost_;
    QTimer debounce_, pollTimer_;
};

}  // namespace extremal
