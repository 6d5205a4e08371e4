// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/studies/mesh_figure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/figure/build.hpp"
#include "engine/figure/studies/study_axes.hpp"
#include "engine/study/search/mesh_fit.hpp"

namespace extremal {
namespace {

/// The fit that the search ended with, from its runs.
MeshFit fitOf(const Sweep& sweep, const SweepRow& row) {
    const ResolvedScheme& scheme = sweep.scene().schemes[row.point.scheme];
    const std::vector<TriedRun>& tried = row.result.tried;
    MeshFit fit(tried.front().cells, tried.front().steps, scheme.claims.order, scheme.orderInSpace(), 1);
    for (const TriedRun& run : tried) fit.take({run.cells, run.steps, run.error, run.cost});
    return fit;
}

bool hasMeshes(const SweepRow& row) {
    const std::vector<TriedRun>& tried = row.result.tried;
    return std::any_of(tried.begin(), tried.end(),
                       [&](const TriedRun& run) { return run.cells != tried.front().cells; });
}

/// The cheapest that reaches the wish; else the nearest.
const SweepRow* shownRow(const Sweep& sweep) {
    const SweepRow* best = nullptr;
    const auto isBetter = [&](const PointResult& a, const PointResult& b) {
        if (a.isDone() != b.isDone()) return a.isDone();
        if (!a.isDone()) return a.error < b.error;
        return sweep.options().repeat == 0 ? workOf(a, 1) < workOf(b, 1) : a.cpuSeconds < b.cpuSeconds;
    };
    for (const SweepRow& row : sweep.rows())
        if (hasMeshes(row) && fitOf(sweep, row).isKnown() && (!best || isBetter(row.result, best->result)))
            best = &row;
    return best;
}

/// What is shown of a plane with two logarithmic axes.
struct Plane {
    double left = HUGE_VAL, right = 0, bottom = HUGE_VAL, top = 0;

    double x(double part) const { return left * std::pow(right / left, part); }
    double y(double part) const { return bottom * std::pow(top / bottom, part); }
};

/// Where f is 0, segment by segment, by its signs at the corners of a grid.
Guide contourOf(const Plane& plane, const std::function<double(double x, double y)>& f) {
    constexpr int count = 48;
    constexpr double gap = PointResult::unknown;
    Guide guide;
    const auto at = [&](int i, int j) { return f(plane.x(double(i) / count), plane.y(double(j) / count)); };
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
            const int corners[5][2] = {{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}, {i, j}};
            std::vector<std::pair<double, double>> crossings;
            for (int k = 0; k < 4; ++k) {
                const auto &a = corners[k], &b = corners[k + 1];
                const double before = at(a[0], a[1]), after = at(b[0], b[1]);
                if ((before > 0) == (after > 0)) continue;
                const double part = before / (before - after);
                crossings.emplace_back((a[0] + part * (b[0] - a[0])) / count,
                                       (a[1] + part * (b[1] - a[1])) / count);
            }
            for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
                for (const auto& [x, y] : {crossings[k], crossings[k + 1]}) {
                    guide.x.push_back(plane.x(x));
                    guide.y.push_back(plane.y(y));
                }
                guide.x.push_back(gap);
                guide.y.push_back(gap);
            }
        }
    return guide;
}

HeatMap errorsOver(const Plane& plane, const MeshFit& fit, const std::string& title, double low,
                   double high) {
    constexpr int count = 64;
    HeatMap heat;
    heat.left = plane.left, heat.right = plane.right;
    heat.bottom = plane.bottom, heat.top = plane.top;
    heat.columns = heat.rows = count;
    heat.scale = title;
    heat.low = low, heat.high = high;
    for (int i = 0; i < count; ++i) heat.xs.push_back(plane.x((i + 0.5) / count));
    for (int j = 0; j < count; ++j) heat.ys.push_back(plane.y((j + 0.5) / count));
    for (const double steps : heat.xs)
        for (const double cells : heat.ys) heat.values.push_back(fit.errorAt(cells, steps));
    heat.faults.assign(heat.values.size(), "");
    return heat;
}

}  // namespace

std::optional<Figure> meshFigure(const Sweep& sweep) {
    constexpr double around = 1.6;
    const SweepRow* const row = shownRow(sweep);
    if (!row) return {};
    const MeshFit fit = fitOf(sweep, *row);
    const double wish = sweep.options().wantedError;
    const SchemeSpec& spec = sweep.scene().scene.schemes[row->point.scheme];
    Plane plane;
    Series runs;
    runs.label = spec.label;
    runs.style = styleOf(spec, row->point.scheme);
    runs.kind = SeriesKind::marks;
    double low = HUGE_VAL, high = 0;
    for (const TriedRun& run : row->result.tried) {
        runs.x.push_back(run.steps);
        runs.y.push_back(run.cells);
        plane.left = std::min(plane.left, run.steps / around);
        plane.right = std::max(plane.right, run.steps * around);
        plane.bottom = std::min(plane.bottom, run.cells / around);
        plane.top = std::max(plane.top, run.cells * around);
        low = std::min(low, run.error);
        high = std::max(high, run.error);
    }
    Figure figure;
    figure.view = "two-knobs";
    figure.title = "Steps and elements together";
    figure.x = logAxis("steps n");
    figure.y = logAxis("elements N");
    figure.x.range = {plane.left, plane.right};
    figure.y.range = {plane.bottom, plane.top};
    figure.add(errorsOver(plane, fit, errorTitle(sweep), low, std::max(high, 2 * low)));
    if (wish > 0) {
        Guide line = contourOf(plane, [&](double n, double N) { return fit.errorAt(N, n) - wish; });
        line.isStrong = true;
        if (!line.x.empty()) {
            figure.add(Label{line.x.front(), line.y.front(), "wish " + shortNumber(wish, 2)});
            figure.add(std::move(line));
        }
    }
    const MeshRun* const best = wish > 0 ? fit.best(wish) : nullptr;
    for (const double times : {0.25, 1.0, 4.0}) {
        if (!best) break;
        const double cost = times * fit.relativeCostAt(best->cells, best->steps);
        figure.add(contourOf(plane, [&](double n, double N) { return fit.relativeCostAt(N, n) - cost; }));
    }
    if (best)
        figure.add(Label{best->steps, double(best->cells),
                         std::to_string(best->cells) + " elements, " + shortNumber(best->steps) + " steps"});
    figure.add(std::move(runs));
    figure.subtitle = spec.label + ": errors as fitted to its runs, the dots; faint lines: equal cost";
    figure.summary = "Errors of " + spec.label + " over steps and elements, fitted to " +
                     std::to_string(row->result.tried.size()) + " runs.";
    return figure;
}

}  // namespace extremal
