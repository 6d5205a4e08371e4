// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/inspect/separation.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/algebra/line_fit.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/figure/build.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/single_scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

Value numbers(const std::vector<double>& x, std::size_t from, std::size_t count) {
    Value::Array all;
    for (std::size_t i = 0; i < count; ++i) all.emplace_back(x[from + i]);
    return all;
}

/// The scene with this scheme alone, from a state.
Scene sceneFrom(const Scene& scene, std::size_t scheme, const std::vector<double>& x) {
    const std::size_t d = x.size() / 2;
    Value document = toValue(scene);
    keepAlone(document, scheme);
    document.set("initial", Value(Value::Object{{"q", numbers(x, 0, d)}, {"p", numbers(x, d, d)}}));
    document.set("events", Value::Array{});
    document.set("reference", Value("none"));
    ReadScene read = readScene(document);
    if (!read.errors.empty()) throw InvalidScene(read.errors);
    return read.scene;
}

/// By least squares, of log(distance) while it is below a tenth of the size of the motion.
double rateOf(const std::vector<double>& t, const std::vector<double>& distance, double size) {
    std::vector<double> times, logs;
    for (std::size_t i = 0; i < t.size() && distance[i] < 0.1 * size; ++i) {
        if (distance[i] <= 0) continue;
        times.push_back(t[i]);
        logs.push_back(std::log(distance[i]));
    }
    const double slope = times.size() > 2 ? lineThrough(times, logs).slope : 0;
    return std::isfinite(slope) ? slope : 0;
}

}  // namespace

Separation separationOf(const Scene& scene, std::size_t scheme, double shift) {
    const ResolvedScene resolved = resolve(scene);
    const ResolvedScheme& spec = resolved.schemes[scheme];
    if (!resolved.system->hasCoordinates())
        throw InvalidScene("/model", "two copies need coordinates to start apart in",
                           "a model with coordinates");
    if (!spec.isFixed())
        throw InvalidScene("/schemes/" + std::to_string(scheme), "its steps differ between the copies",
                           "a scheme with a fixed step");
    std::vector<double> x = resolved.initial.x;
    const Comparison first = run(sceneFrom(scene, scheme, x), {.isTimed = false});
    x[0] += shift;
    const Comparison second = run(sceneFrom(scene, scheme, x), {.isTimed = false});

    Separation result;
    result.pair = first;
    auto moved = std::make_shared<SchemeResult>(*second.schemes.front());
    moved->spec.label += ", moved by " + formatNumber(shift, 3);
    moved->summary.label = moved->spec.label;
    moved->style = first.schemes.front()->style + 1;
    result.pair.schemes.push_back(moved);

    const SchemeResult& one = *first.schemes.front();
    const auto t = one.trajectory["t"];
    const std::size_t rows = std::min(one.trajectory.rows(), moved->trajectory.rows());
    Series s;
    s.label = one.spec.label;
    s.style = one.style;
    double size = 0;
    for (std::size_t i = 0; i < rows; ++i) {
        double distance = 0;
        for (const Quantity& column : stateColumns(*resolved.system)) {
            const double a = one.trajectory[column.name][i], b = moved->trajectory[column.name][i];
            distance = std::max(distance, std::fabs(a - b));
            size = std::max(size, std::fabs(a));
        }
        s.x.push_back(t[i]);
        s.y.push_back(distance);
    }
    result.rate = rateOf(s.x, s.y, size);
    View view;
    view.id = "error";
    const FigureContext context{result.pair, view, resolved.system.get(), *findView(view.id)};
    Figure& figure = result.distance = startFigure(context, "Distance of the two copies");
    figure.x = timeAxis(context);
    figure.y = logAxis("max |x - x'|");
    figure.subtitle = "grows at the rate " + shortNumber(result.rate, 3) + " on average";
    figure.add(std::move(s));
    finishFigure(figure, context, "Distance of two copies of a motion against time");
    figure.drop<FailureMark>();
    return result;
}

}  // namespace extremal
