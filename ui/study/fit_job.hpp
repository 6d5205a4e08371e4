// SPDX-License-Identifier: GPL-3.0-or-later
/// A fit of numbers of a scene to measurements (study/fit/fit.hpp), beside the window's thread.
#pragma once

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <stop_token>

#include "engine/scene/resolve.hpp"
#include "engine/study/fit/fit.hpp"
#include "engine/study/fit/measured_data.hpp"

namespace extremal {

class FitJob : public QObject {
    Q_OBJECT
public:
    using QObject::QObject;
    ~FitJob() override;

    /// Stops the present one.
    void start(std::shared_ptr<const ResolvedScene> scene, std::shared_ptr<const MeasuredData> data,
               const FitRequest& request);
    bool stop();  ///< false: none was running
    bool isRunning() const { return isRunning_; }
    /// How many steps have lowered the sum, and the last of them; none: the start is being computed.
    int steps() const { return steps_; }
    const std::optional<FitStep>& step() const { return step_; }
    double firstSum() const { return firstSum_; }
    /// After the end; none: there is no fit, for this reason.
    const std::optional<FitAnswer>& answer() const { return answer_; }
    const QString& problem() const { return problem_; }
    const QString& remedy() const { return remedy_; }

signals:
    void stepped();
    void ended();

private:
    void take(const FitStep& step);
    void end(const std::optional<FitAnswer>& answer, const QString& problem, const QString& remedy);

    bool isRunning_ = false;
    int steps_ = 0;
    double firstSum_ = 0;
    std::optional<FitStep> step_;
    std::optional<FitAnswer> answer_;
    QString problem_, remedy_;
    std::stop_source stop_{std::nostopstate};
};

}  // namespace extremal
