// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/needs_job.hpp"

#include <QPointer>

#include <algorithm>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/study/catalog.hpp"
#include "ui/base/background.hpp"
#include "ui/study/problem_of.hpp"

namespace extremal {
namespace {

QString titleOf(const Sweep& sweep, std::size_t scheme) {
    const ResolvedScheme& found = sweep.scene().schemes[scheme];
    if (!sweep.isOfScene(scheme) && found.baseline) return QString::fromStdString(found.baseline->item.title);
    return QString::fromStdString(found.spec.label);
}

std::vector<NeedsRung> rungsOf(const Sweep& sweep) {
    const std::vector<Value::Array> table = findStudy("needs")->rows(sweep);
    constexpr std::size_t model = 2, knobs = 3;  // among the columns of needs.csv
    std::vector<NeedsRung> all;
    std::size_t place = 0, before = 0;
    for (std::size_t i = 0; i < sweep.rows().size(); ++i) {
        const SweepRow& row = sweep.answer(i);
        const PointResult& result = row.result;
        if (result.status == RunStatus::waiting) continue;
        const Value::Array& told = table[place++];
        const bool isSame =
            !all.empty() && before == row.point.scheme && all.back().isReached == result.isDone();
        if (!isSame && !(result.isDone() || all.empty() || all.back().isReached))
            continue;  // none was reached
        NeedsAnswer answer{sweep.options().rungs[i], result.cpuSeconds, result.error,
                           QString::fromStdString(told[knobs].asString()),
                           (result.isDone() ? schemeAt(sweep.scene(), row.point.scheme, result)
                                            : sweep.scene().schemes[row.point.scheme])
                               .spec};
        if (!isSame)
            all.push_back({result.isDone(),
                           titleOf(sweep, row.point.scheme),
                           QString::fromStdString(told[model].asString()),
                           QString::fromStdString(result.isDone() ? std::string() : result.reason),
                           0,
                           {}});
        all.back().answers.push_back(std::move(answer));
        before = row.point.scheme;
    }
    for (std::size_t i = 1; i < all.size(); ++i)
        if (all[i].isReached && all[i - 1].answers.back().seconds > 0)
            all[i].timesAbove = all[i].answers.back().seconds / all[i - 1].answers.back().seconds;
    return all;
}

}  // namespace

bool NeedsRung::serves(double error, double above) const {
    constexpr double rounding = 1 + 1e-9;
    return isReached && smallest() <= error * rounding && !(above <= error * rounding);
}

const NeedsAnswer& NeedsRung::answerFor(double error) const {
    constexpr double rounding = 1 + 1e-9;
    const bool isWithin = smallest() <= error * rounding;
    const auto found = std::find_if(answers.begin(), answers.end(),
                                    [&](const NeedsAnswer& a) { return a.wish <= error * rounding; });
    return isWithin ? *found : answers.back();
}

NeedsJob::~NeedsJob() { stop_.request_stop(); }

bool NeedsJob::isOf(const Scene& scene) const { return scene_ && problemOf(scene) == *scene_; }

void NeedsJob::clear() {
    stop_.request_stop();
    isRunning_ = wasStopped_ = false;
    scene_.reset();
    rungs_.clear();
    problem_.clear();
    fraction_ = 0;
    emit changed();
}

void NeedsJob::stop() {
    if (!isRunning_) return;
    stop_.request_stop();
    isRunning_ = false;
    wasStopped_ = true;
    emit changed();
}

void NeedsJob::start(std::shared_ptr<const ResolvedScene> scene, const std::string& metric, double seconds) {
    stop_.request_stop();
    stop_ = std::stop_source();
    scene_ = problemOf(scene->scene);
    metric_ = metric;
    seconds_ = seconds;
    fraction_ = 0;
    rungs_.clear();
    problem_.clear();
    isRunning_ = true;
    wasStopped_ = false;
    SweepOptions options;
    options.metric = metric;
    options.rungs = usualRungs();
    options.hasAllCandidates = true;
    options.searchSeconds = seconds;
    runInBackground([self = QPointer(this), scene = std::move(scene), options, stop = stop_.get_token()] {
        const auto tell = [self, stop](std::vector<NeedsRung> rungs, double fraction, bool isLast,
                                       const QString& problem) {
            sendToWindow([self, stop, rungs = std::move(rungs), fraction, isLast, problem] {
                if (!self || stop.stop_requested()) return;
                self->rungs_ = rungs;
                self->fraction_ = fraction;
                self->isRunning_ = !isLast;
                self->problem_ = problem;
                emit self->changed();
            });
        };
        QString problem;
        std::vector<NeedsRung> rungs;
        try {
            Sweep sweep(*scene, options);
            const auto size = static_cast<double>(sweep.rows().size());
            sweep.run(
                {},
                [&](std::size_t i, const PointResult&) {
                    rungs = rungsOf(sweep);
                    tell(rungs, static_cast<double>(i + 1) / size, false, {});
                },
                stop);
        } catch (const InvalidScene& e) {
            const Problem& first = e.problems().front();
            problem =
                QString::fromStdString(first.message + (first.hint.empty() ? "" : " (" + first.hint + ")"));
        }
        tell(std::move(rungs), 1, true, problem);
    });
    emit changed();
}

}  // namespace extremal
