// SPDX-License-Identifier: GPL-3.0-or-later
/// A study in the background: its points arrive as they finish, and what is known stays when it is stopped.
/// Nothing of its work happens on the window's thread; points are fetched by a timer.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "engine/study/stability/extremes_study.hpp"
#include "engine/study/stability/limits_study.hpp"
#include "engine/study/stability/linear_study.hpp"
#include "engine/study/stability/stability_study.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

using Study = std::variant<Sweep, StabilityStudy, LinearStudy, ExtremesStudy, LimitsStudy>;

/// How many of its points are known, of all.
struct StudyCount {
    std::size_t known = 0, all = 0;
};
StudyCount countOf(const Study& study);

class StudyJob : public QObject {
    Q_OBJECT
public:
    explicit StudyJob(QObject* parent = nullptr);
    ~StudyJob() override;

    /// Stops the present one.
    void start(Study study);
    void stop();
    bool isRunning() const { return work_ != nullptr; }
    bool wasStopped() const { return wasStopped_; }
    double fraction() const;
    bool isPreparing() const;
    AnnouncedTime announced() const;
    /// Why it ended early, beside being stopped: a reference that cannot be computed.
    const QString& problem() const { return problem_; }
    /// What is known so far; null before the first study.
    const Study* study() const { return study_ ? &*study_ : nullptr; }
    /// The same, if it is of this kind.
    template <class Kind>
    const Kind* as() const {
        return study_ ? std::get_if<Kind>(&*study_) : nullptr;
    }

signals:
    void pointsArrived();  ///< study() has changed
    void changed();        ///< so has the state, the progress, or both

private:
    struct Work;
    void poll();
    void fetch(Work& work);
    void retire();

    std::optional<Study> study_;
    std::unique_ptr<Work> work_;
    std::vector<std::unique_ptr<Work>> stopping_;  ///< stopped, not yet ended: their destructor would wait
    bool wasStopped_ = false;
    QString problem_;
    QTimer timer_;
};

}  // namespace extremal
