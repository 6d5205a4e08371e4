// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene needs (study `needs`), searched in the background: the rungs of a ladder of wishes, each the
/// cheapest of all schemes that accept the scene, as they are found. Stopped, it keeps what is known.
#pragma once

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// The answer to one wish.
struct NeedsAnswer {
    double wish = 0;
    double seconds = 0, error = 0;  ///< measured; of a wish that is not reached the error of the nearest
    QString kept;                   ///< "degree 4, 36 steps"
    SchemeSpec scheme;              ///< with the step or tolerance that was found
};

/// Wishes with the same answer: one scheme, which may be a reduced model.
struct NeedsRung {
    bool isReached = false;
    QString title;          ///< of the scheme: "rigid pendulum", "RK4", or its label in the scene
    QString model;          ///< "rigid pendulum in place of spring-pendulum"; empty: the system itself
    QString reason;         ///< why it is not reached
    double timesAbove = 0;  ///< its cost over that of the rung above; 0: there is none
    std::vector<NeedsAnswer> answers;  ///< from the largest wish down

    double largest() const { return answers.front().wish; }
    double smallest() const { return answers.back().wish; }
    /// Whether it is the cheapest for this error: `above` is the smallest wish of the rung above, or
    /// infinity.
    bool serves(double error, double above) const;
    /// The cheapest answer that reaches the error; the finest where none does, or where all do.
    const NeedsAnswer& answerFor(double error) const;
};

class NeedsJob : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    ~NeedsJob() override;

    /// Stops the present one. `seconds`: of CPU for the search, after the reference.
    void start(std::shared_ptr<const ResolvedScene> scene, const std::string& metric, double seconds);
    void stop();
    bool isRunning() const { return isRunning_; }
    bool wasStopped() const { return wasStopped_; }
    double seconds() const { return seconds_; }
    /// 0..1: of the wishes.
    double fraction() const { return fraction_; }
    const std::vector<NeedsRung>& rungs() const { return rungs_; }
    const std::string& metric() const { return metric_; }
    /// Whether the rungs are of this scene: of its problem, whatever its schemes and plots.
    bool isOf(const Scene& scene) const;
    /// Why there is no ladder at all.
    const QString& problem() const { return problem_; }
    void clear();

signals:
    void changed();

private:
    std::optional<Scene> scene_;
    std::string metric_;
    double seconds_ = 0, fraction_ = 0;
    bool isRunning_ = false, wasStopped_ = false;
    std::vector<NeedsRung> rungs_;
    QString problem_;
    std::stop_source stop_{std::nostopstate};
};

}  // namespace extremal
