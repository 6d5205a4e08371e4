// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/study/background_sweep.hpp"

#include <QPointer>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/figure/studies/study_figure.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/study/sweep.hpp"
#include "ui/base/background.hpp"
#include "ui/workspace/run_control.hpp"
#include "ui/study/problem_of.hpp"

namespace extremal {
namespace {

constexpr int sweepPauseMs = 500;
constexpr double longestRun = 0.1;  // seconds of a run that is still worth being swept
constexpr double stepRatio = 4;     // steps from so many times the scheme's own to as small a part of it
constexpr int sweptPoints = 5;
constexpr const char* otherSteps = "other steps";

bool isSameRun(SchemeSpec a, SchemeSpec b) {
    a.label = b.label = {};
    a.isEnabled = b.isEnabled = true;
    a.style = b.style = {};
    return a == b;
}

SweptScheme sweepOf(const ResolvedScene& scene, const SchemeSpec& spec, const std::stop_token& stop) {
    SweptScheme swept{spec, 0, {}, {}};
    const double own = spec.tolerance ? *spec.tolerance : spec.step.value,
                 wide = spec.tolerance ? 100 : stepRatio;
    SweepOptions options;
    options.metric = "column:error";  // as the runs beside it have it, whatever the units
    options.ladder = {{}, own * wide, own / wide, sweptPoints};
    options.repeat = 1;
    options.knobs.isCells = false;  // a click on a point changes the step alone
    options.only = {spec.label};
    options.threads = 1;
    try {
        Sweep sweep(scene, options);
        sweep.run({}, {}, stop);
        for (const SweepRow& row : sweep.rows())
            if (row.result.isDone() && row.result.error > 0 && row.result.cpuSeconds > 0)
                swept.points.push_back({row.point.step > 0 ? row.point.step : row.point.tolerance,
                                        row.result.cpuSeconds, row.result.error});
        swept.judged = sweep.judgedErrors();
    } catch (const InvalidScene&) {  // no ladder, or no error to measure: no line
    }
    return swept;
}

/// The least and the largest value with some room, on a logarithmic axis.
void widen(Axis& axis, const std::vector<double>& values) {
    if (!axis.range || values.empty()) return;
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    const double low = std::min(axis.range->first, *least / 1.3),
                 high = std::max(axis.range->second, *most * 1.3);
    axis.range = std::pair{low, high};
}

}  // namespace

BackgroundSweep::BackgroundSweep(RunControl& run, QObject* parent) : QObject(parent), run_(run) {
    pause_.setSingleShot(true);
    pause_.setInterval(sweepPauseMs);
    connect(&pause_, &QTimer::timeout, this, &BackgroundSweep::start);
    connect(&run_, &RunControl::finished, this, [this] { pause_.start(); });
    connect(&run_, &RunControl::stateChanged, this, [this] {
        if (!run_.isRunning()) return;
        pause_.stop();
        stop_.request_stop();
    });
}

BackgroundSweep::~BackgroundSweep() { stop_.request_stop(); }

std::vector<SweptScheme> BackgroundSweep::known() const {
    std::vector<SweptScheme> all;
    const auto results = run_.results();
    if (!results || !(problemOf(results->scene) == problem_)) return all;
    for (const auto& scheme : results->schemes)
        for (const SweptScheme& swept : swept_)
            if (isSameRun(swept.spec, scheme->spec))
                all.push_back({scheme->spec, scheme->style, swept.points, swept.judged});
    return all;
}

void BackgroundSweep::addLines(Figure& figure) const {
    std::erase_if(figure.layers, [](const Layer& layer) {
        const Series* const series = std::get_if<Series>(&layer);
        return series && series->part == otherSteps;
    });
    std::vector<double> seconds, errors;
    std::vector<std::pair<double, double>> points;
    const std::vector<SweptScheme> all = known();
    for (const SweptScheme& swept : all) {
        if (swept.points.size() < 2) continue;
        Series line;
        line.label = swept.spec.label;
        line.style = swept.style;
        line.kind = SeriesKind::curve;
        line.part = otherSteps;
        for (const SweptPoint& p : swept.points) {
            line.x.push_back(p.seconds);
            line.y.push_back(p.error);
            if (swept.judged.has(p.error)) points.emplace_back(p.seconds, p.error);
        }
        seconds.insert(seconds.end(), line.x.begin(), line.x.end());
        errors.insert(errors.end(), line.y.begin(), line.y.end());
        figure.add(std::move(line));
    }
    widen(figure.x, seconds);
    widen(figure.y, errors);
    if (!all.empty())
        for (const auto& scheme : run_.results()->schemes)
            if (scheme->summary.status == RunStatus::done && all.front().judged.has(scheme->summary.maxError))
                points.emplace_back(scheme->summary.cpuSeconds, scheme->summary.maxError);
    addFront(figure, std::move(points));
}

void BackgroundSweep::start() {
    const auto results = run_.results();
    if (!results || !results->isFinished || run_.isRunning() || results->reference.type == "none") return;
    const Scene problem = problemOf(results->scene);
    const bool isSameProblem = problem == problem_;
    std::vector<SchemeSpec> wanted;
    for (const auto& scheme : results->schemes) {
        const bool isKnown =
            isSameProblem && std::any_of(swept_.begin(), swept_.end(), [&](const SweptScheme& swept) {
                return isSameRun(swept.spec, scheme->spec);
            });
        const Summary& m = scheme->summary;
        if (!isKnown && m.status == RunStatus::done && std::isfinite(m.maxError) && m.cpuSeconds < longestRun)
            wanted.push_back(scheme->spec);
    }
    if (wanted.empty()) return;
    stop_.request_stop();
    stop_ = std::stop_source();
    runInBackground(
        [self = QPointer(this), scene = results->scene, problem, wanted, stop = stop_.get_token()] {
            auto swept = std::make_shared<std::vector<SweptScheme>>();
            try {
                const ResolvedScene resolved = resolve(scene);
                for (const SchemeSpec& spec : wanted)
                    if (!stop.stop_requested()) swept->push_back(sweepOf(resolved, spec, stop));
            } catch (const InvalidScene&) {  // the run itself has said why
            }
            sendToWindow([self, swept, problem, stop] {
                if (self && !stop.stop_requested()) self->keep(problem, std::move(*swept));
            });
        });
}

void BackgroundSweep::keep(const Scene& problem, std::vector<SweptScheme> swept) {
    constexpr std::size_t most = 60;
    if (!(problem == problem_)) swept_.clear();
    problem_ = problem;
    std::move(swept.begin(), swept.end(), std::back_inserter(swept_));
    if (swept_.size() > most) swept_.erase(swept_.begin(), swept_.end() - static_cast<std::ptrdiff_t>(most));
    emit changed();
}

}  // namespace extremal
