// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/fit_job.hpp"

#include <QPointer>

#include <utility>

#include "engine/core/problem.hpp"
#include "ui/base/background.hpp"

namespace extremal {

FitJob::~FitJob() { stop_.request_stop(); }

bool FitJob::stop() {
    if (!isRunning_) return false;
    stop_.request_stop();
    isRunning_ = false;
    return true;
}

void FitJob::start(std::shared_ptr<const ResolvedScene> scene, std::shared_ptr<const MeasuredData> data,
                   const FitRequest& request) {
    stop_.request_stop();
    stop_ = std::stop_source();
    isRunning_ = true;
    steps_ = 0;
    step_.reset();
    answer_.reset();
    problem_.clear();
    remedy_.clear();
    runInBackground([self = QPointer(this), scene = std::move(scene), data = std::move(data), request,
                     stop = stop_.get_token()] {
        const auto tell = [&](const FitStep& step) {
            sendToWindow([self, stop, step] {
                if (self && !stop.stop_requested()) self->take(step);
            });
        };
        std::optional<FitAnswer> answer;
        QString problem, remedy;
        try {
            answer = fit(*scene, *data, request, stop, tell);
            problem = QString::fromStdString(answer->problem);
            remedy = QString::fromStdString(answer->remedy);
            if (!answer->isFound()) answer.reset();
        } catch (const InvalidScene& e) {
            problem = QString::fromStdString(e.problems().front().message);
            remedy = QString::fromStdString(e.problems().front().hint);
        }
        sendToWindow([self, stop, answer, problem, remedy] {
            if (self && !stop.stop_requested()) self->end(answer, problem, remedy);
        });
    });
}

void FitJob::take(const FitStep& step) {
    if (step_)
        ++steps_;
    else
        firstSum_ = step.sum;
    step_ = step;
    emit stepped();
}

void FitJob::end(const std::optional<FitAnswer>& answer, const QString& problem, const QString& remedy) {
    isRunning_ = false;
    answer_ = answer;
    problem_ = problem;
    remedy_ = remedy;
    emit ended();
}

}  // namespace extremal
