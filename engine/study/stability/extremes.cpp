// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/stability/extremes.hpp"

#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/outlook/two_positions.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/write/codec.hpp"

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

double measureOf(const ResolvedScene& scene, const Summary& s, ExtremeAxis::Metric metric) {
    const ResolvedScheme& scheme = scene.schemes.front();
    const System& system = *systemOf(scene, scheme);
    const State& start = initialOf(scene, scheme);
    if (metric == ExtremeAxis::Metric::norm) return s.maxNormError;
    if (metric == ExtremeAxis::Metric::energy) {
        const double scale = MotionCheck(system, start, scheme.spec.step.value).scale();
        return scale > 0 ? s.maxEnergyError / scale : s.maxEnergyError;
    }
    const double scale = errorMeasure(system, start).scale;
    return scale > 0 ? s.maxError / scale : s.maxError;
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

std::vector<ExtremeCase> extremeCases(bool withLong) {
    std::vector<ExtremeCase> all;
    for (const ExtremeAxis& axis : extremeAxes())
        for (std::size_t s = 0; s < axis.schemes.size(); ++s)
            for (std::size_t v = 0; v < (withLong ? axis.values.size() : axis.usual); ++v)
                all.push_back({&axis, v, s});
    return all;
}

ExtremeResult runExtreme(const ExtremeCase& extreme, const std::stop_token& stop) {
    constexpr double right = 0.1;
    ExtremeResult result;
    const ReadScene read = readScene(extreme.text());
    if (!read.resolved) {
        result.kind = "refused";
        return result;
    }
    try {
        RunOptions options;
        options.threads = 1;
        Run run(*read.resolved, options);
        const std::stop_callback onStop(stop, [&] { run.stop(); });
        run.start();
        run.wait();
        const Summary s = run.latest().schemes.front()->summary;
        if (s.status == RunStatus::partial) return {};
        result.measure = measureOf(*read.resolved, s, extreme.axis->metric);
        result.failedAt = s.failedAt;
        if (s.status == RunStatus::done)
            result.kind = result.measure <= right ? "right" : "coarse";
        else
            result.kind = name(s.cause);
    } catch (const InvalidScene&) {
        result.kind = "refused";
    }
    return result;
}

}  // namespace extremal
