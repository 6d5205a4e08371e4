// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/extremes.hpp"

#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/overrides.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/expected_time.hpp"
#include "engine/study/search/point.hpp"
#include "engine/study/stability/judged_wishes.hpp"

namespace extremal {
namespace {

/// Every `from` by `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

ExtremeAxis axisOf(const Preset& file) {
    const Value document = parseJson(std::string(file.json));
    ExtremeAxis axis;
    axis.id = file.id;
    axis.title = document.find("title")->asString();
    axis.scene = *document.find("scene");
    const std::string& metric = document.find("metric")->asString();
    axis.metric = metric == "error"  ? ExtremeAxis::Metric::error
                  : metric == "norm" ? ExtremeAxis::Metric::norm
                                     : ExtremeAxis::Metric::energy;
    for (const Value& value : document.find("values")->asArray()) axis.values.push_back(value.asString());
    axis.usual = axis.values.size();
    if (const Value* late = document.find("long"))
        for (const Value& value : late->asArray()) axis.values.push_back(value.asString());
    axis.schemes = document.find("schemes")->asArray();
    return axis;
}

/// What an error of this metric is divided by.
double scaleOf(const ResolvedScene& scene, ExtremeAxis::Metric metric) {
    const ResolvedScheme& scheme = scene.schemes.front();
    const System& system = *systemOf(scene, scheme);
    const State& start = initialOf(scene, scheme);
    double scale = 1;
    if (metric == ExtremeAxis::Metric::energy)
        scale = MotionCheck(system, start, scheme.spec.step.value).scale();
    else if (metric == ExtremeAxis::Metric::error)
        scale = errorMeasure(system, start).scale;
    return scale > 0 ? scale : 1;
}

double valueOf(const Summary& s, ExtremeAxis::Metric metric) {
    if (metric == ExtremeAxis::Metric::norm) return s.maxNormError;
    return metric == ExtremeAxis::Metric::energy ? s.maxEnergyError : s.maxError;
}

/// The scene of the user with its numbers changed and this scheme alone.
std::string textOfChanged(const ExtremeAxis& axis, const std::string& value, std::size_t scheme) {
    Value document = axis.scene;
    std::vector<Change> changed;
    std::vector<Problem> errors;  // of a pointer that is none, which the study has refused
    for (const auto& [pointer, number] : axis.fixed)
        applyOverride(document, {pointer, number}, changed, errors);
    applyOverride(document, {axis.pointer, parseNumber(value).value_or(0)}, changed, errors);
    keepAlone(document, scheme);
    document.find("schemes")->asArray().front().set("allow_unstable", true);
    std::erase_if(document.asObject(), [](const Value::Member& m) { return m.first == "output"; });
    return writeCompactJson(document);
}

/// A whole run of the axes of resources/extremes.
ExtremeResult runOwn(const ResolvedScene& scene, const ExtremeAxis& axis, const std::stop_token& stop) {
    constexpr double right = 0.1;
    RunOptions options;
    options.threads = 1;
    Run run(scene, options);
    const std::stop_callback onStop(stop, [&] { run.stop(); });
    run.start();
    run.wait();
    const Comparison done = run.latest();
    const Summary& s = done.schemes.front()->summary;
    if (s.status == RunStatus::partial) return {};
    ExtremeResult result;
    const double scale = scaleOf(scene, axis.metric);
    result.measure = valueOf(s, axis.metric) / scale;
    result.failedAt = s.failedAt;
    const bool isOfReference = axis.metric == ExtremeAxis::Metric::error;
    if (isOfReference) result.floor = done.reference.estimatedError / scale;
    const JudgedValue judged{result.measure, right, 1, isOfReference && result.floor > 0 ? result.floor : 0};
    result.judgement = judge(s.status, s.cause, {&judged, 1});
    if (s.status == RunStatus::done)
        result.kind = result.measure <= right ? "right" : "coarse";
    else
        result.kind = name(s.cause);
    return result;
}

JudgedWishes judgedOn(const ResolvedScene& scene, const ExtremeAxis& axis, const std::stop_token& stop) {
    return {scene, metricsOf(axis.wishes, axis.measured, axis.isAtEnd, scene), axis.wishes, stop};
}

/// A run of a scene of the user, against its own reference.
ExtremeResult runChanged(const ResolvedScene& scene, const ExtremeAxis& axis, const std::stop_token& stop) {
    const ResolvedScheme& scheme = scene.schemes.front();
    const JudgedWishes judged = judgedOn(scene, axis, stop);
    if (stop.stop_requested()) return {};
    StudyPoint point;
    if (scheme.isAdaptive())
        point.tolerance = scheme.spec.tolerance.value_or(1e-6);
    else
        point.step = scheme.spec.step.value;
    const PointResult run = runPoint(scene, point, judged.metrics, judged.reference.of(scheme), 0, {}, stop);
    ExtremeResult result;
    if (run.status == RunStatus::partial) return result;
    std::vector<double> measured;
    for (std::size_t i = 0; i < judged.values.size(); ++i) measured.push_back(run.errorIn(i));
    result.measure = run.error;
    result.failedAt = run.failedAt;
    result.floor = judged.values.front().floor;
    result.judgement = judged.of(run.status, run.cause, measured);
    bool isRight = true;
    for (std::size_t i = 0; i < measured.size(); ++i)
        isRight = isRight && measured[i] <= judged.values[i].wish;
    result.kind = !run.isDone() ? std::string(name(run.cause)) : isRight ? "right" : "coarse";
    return result;
}

}  // namespace

const std::vector<ExtremeAxis>& extremeAxes() {
    static const std::vector<ExtremeAxis> all = [] {
        std::vector<ExtremeAxis> axes;
        for (const Preset& file : extremeScenes()) axes.push_back(axisOf(file));
        return axes;
    }();
    return all;
}

std::string ExtremeCase::text() const {
    using By = ExtremeAxis::Metric;
    const std::string& at = axis->values[value];
    if (!axis->pointer.empty()) return textOfChanged(*axis, at, scheme);
    Value document{Value::Object{}}, only = axis->schemes[scheme];
    document.set("extremal", 1);
    for (const auto& [key, part] : axis->scene.asObject()) document.set(key, part);
    document.set("reference", axis->metric == By::error ? "exact" : "none");
    document.set("observe", Value::Array{axis->metric == By::error    ? "error"
                                         : axis->metric == By::energy ? "energy"
                                                                      : "norm"});
    document.set("views", Value::Array{});
    only.set("allow_unstable", true);
    document.set("schemes", Value::Array{only});
    const std::string text = writeCompactJson(document);
    return replaced(parseNumber(at) ? replaced(text, "\"$\"", at) : text, "$", at);
}

std::vector<ExtremeCase> extremeCases(bool withLong) { return extremeCases(extremeAxes(), withLong); }

std::vector<ExtremeCase> extremeCases(const std::vector<ExtremeAxis>& axes, bool withLong) {
    std::vector<ExtremeCase> all;
    for (const ExtremeAxis& axis : axes)
        for (std::size_t s = 0; s < axis.schemes.size(); ++s)
            for (std::size_t v = 0; v < (withLong ? axis.values.size() : axis.usual); ++v)
                all.push_back({&axis, v, s});
    return all;
}

ExtremeResult runExtreme(const ExtremeCase& extreme, const std::stop_token& stop) {
    ExtremeResult refused;
    refused.kind = "refused";
    refused.judgement = Judgement::refused;
    const ReadScene read = readScene(extreme.text());
    if (!read.resolved) return refused;
    try {
        return extreme.axis->pointer.empty() ? runOwn(*read.resolved, *extreme.axis, stop)
                                             : runChanged(*read.resolved, *extreme.axis, stop);
    } catch (const InvalidScene&) {
        return refused;
    }
}

double secondsOfJudging(const ExtremeCase& extreme, const std::stop_token& stop) {
    const ExtremeAxis& axis = *extreme.axis;
    if (axis.pointer.empty()) return 0;
    const ReadScene read = readScene(extreme.text());
    if (!read.resolved) return 0;
    const ResolvedScene& scene = *read.resolved;
    const double begin = threadSeconds();
    try {
        const JudgedWishes judged = judgedOn(scene, axis, stop);
        const double made = threadSeconds() - begin;
        const ResolvedScheme& scheme = scene.schemes.front();
        const ExactSolution solution = judged.reference.of(scheme);
        if (!solution) return made;
        return made + secondsOfSolution(solution, initialOf(scene, scheme).x.size(), scene.initial.t,
                                        scene.scene.end.value, scheme.spec.step.value, stop);
    } catch (const InvalidScene&) {
        return 0;
    }
}

}  // namespace extremal
