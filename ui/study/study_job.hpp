/// A study of a scene in the background: its points arrive as they finish, and what is known stays when it is
/// stopped. Nothing of its work happens on the window's thread; points are fetched by a timer.
#pragma once

#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <optional>
#include <vector>

#include "engine/study/sweep.hpp"

namespace extremal {

class StudyJob : public QObject {
    Q_OBJECT
public:
    explicit StudyJob(QObject* parent = nullptr);
    ~StudyJob() override;

    /// Stops the present one. Throws InvalidScene where the options do not fit the scene.
    void start(const Scene& scene, const SweepOptions& options);
    void stop();
    bool isRunning() const { return work_ != nullptr; }
    bool wasStopped() const { return wasStopped_; }
    double fraction() const;
    /// Why it ended early, beside being stopped: a reference that cannot be computed.
    const QString& problem() const { return problem_; }
    /// What is known so far; null before the first study.
    const Sweep* sweep() const { return sweep_ ? &*sweep_ : nullptr; }

signals:
    void changed();  ///< points, or the state

private:
    struct Work;
    void poll();
    void fetch(Work& work);
    void retire();

    std::optional<Sweep> sweep_;
    std::unique_ptr<Work> work_;
    std::vector<std::unique_ptr<Work>> stopping_;  ///< stopped, not yet ended: their destructor would wait
    bool wasStopped_ = false;
    QString problem_;
    QTimer timer_;
};

}  // namespace extremal
