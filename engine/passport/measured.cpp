// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/measured.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/convergence.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {
namespace {

constexpr double mostSteps = 4000;

/// The scene with this scheme alone, and an end that is soon reached. Throws InvalidScene.
ResolvedScene aloneWith(const ResolvedScene& scene, std::size_t scheme, double& step) {
    Value document = toValue(scene.scene);
    keepAlone(document, scheme);
    document.set("events", Value::Array{});
    const double start = scene.scene.start.value, h = scene.schemes[scheme].spec.step.value;
    double length = scene.scene.end.value - start;
    if (h > 0) {
        const double n = std::min(mostSteps, std::max(4.0, std::round(std::abs(length) / h)));
        length = std::copysign(n * h, length);
        document.find("time")->set("end", start + length);
        step = h;
    }
    const ReadScene read = readScene(document);
    if (!read.resolved) throw InvalidScene(read.errors);
    return *read.resolved;
}

std::string known(double value, int digits) {
    return std::isfinite(value) ? formatNumber(value, digits) : "";
}

Document::Table tableOf(const Sweep& sweep, bool isAdaptive) {
    Document::Table table{
        {isAdaptive ? "tolerance" : "step", "error", "steps", "evaluations", "iterations", "CPU time"}, {}};
    for (const SweepRow& row : sweep.rows()) {
        const PointResult& r = row.result;
        const std::string step = formatNumber(isAdaptive ? row.point.tolerance : row.point.step, 6);
        if (!r.isDone()) {
            table.rows.push_back({step, std::string(name(r.cause)), "", "", "", ""});
            continue;
        }
        table.rows.push_back({step, known(r.error, 3), std::to_string(r.steps),
                              std::to_string(r.cost.evaluations), std::to_string(r.cost.iterations),
                              std::isfinite(r.cpuSeconds) ? known(1e3 * r.cpuSeconds, 3) + " ms" : ""});
    }
    return table;
}

}  // namespace

void addMeasured(const ResolvedScene& scene, std::size_t scheme, unsigned threads,
                 const std::stop_token& stop, Document& page) {
    page.blocks.emplace_back(Document::Heading{"Measured"});
    try {
        double step = 0;
        const ResolvedScene alone = aloneWith(scene, scheme, step);
        SweepOptions options;
        options.metric = "column:error";  // as runs write it, whatever the units
        options.repeat = 1;
        options.threads = threads;
        if (step > 0 && !hasStepOfItsSpace(alone, alone.schemes.front()))
            for (const double factor : {4.0, 2.0, 1.0, 0.5, 0.25}) {
                const double length = std::abs(alone.scene.end.value - alone.scene.start.value);
                const double n = std::max(1.0, std::round(length / (factor * step)));
                options.ladder.steps.push_back(length / n);
            }
        auto& steps = options.ladder.steps;
        steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
        Sweep sweep(alone, options);
        sweep.run([](const ReferenceInfo&) {}, [](std::size_t, const PointResult&) {}, stop);
        if (stop.stop_requested()) return;
        const double start = alone.scene.start.value, end = alone.scene.end.value;
        page.blocks.emplace_back(Document::Paragraph{
            "On the scene from t = " + formatNumber(start, 6) + " to " + formatNumber(end, 6) +
            "; the error is the largest of the run, in the norm of the scene."});
        page.blocks.emplace_back(tableOf(sweep, step == 0));
        const OrderFit fit = fitOrders(sweep).front();
        page.blocks.emplace_back(Document::Paragraph{
            fit.isKnown() ? "Measured order: " + formatNumber(fit.order, 3) + ", over steps from " +
                                formatNumber(fit.from, 3) + " to " + formatNumber(fit.to, 3) + "."
                          : "No order can be read off: errors do not lie on a line at these steps."});
    } catch (const InvalidScene& e) {
        const Problem& p = e.problems().front();
        page.blocks.emplace_back(Document::Paragraph{
            "Nothing could be measured: " + (p.pointer.empty() ? "" : p.pointer + " ") + p.message + "."});
    }
}

}  // namespace extremal
