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

constexpr int gridCount = 160;

/// f over a grid of the plane, column by column.
std::vector<double> valuesOver(const Plane& plane, const std::function<double(double x, double y)>& f) {
    std::vector<double> values;
    for (int i = 0; i <= gridCount; ++i)
        for (int j = 0; j <= gridCount; ++j)
            values.push_back(f(plane.x(double(i) / gridCount), plane.y(double(j) / gridCount)));
    return values;
}

/// Where such values are `level`, segment by segment, by what they are at the corners of each cell.
Guide contourOf(const Plane& plane, const std::vector<double>& values, double level) {
    constexpr int count = gridCount;
    constexpr double gap = PointResult::unknown;
    Guide guide;
    const auto at = [&](int i, int j) {
        return values[static_cast<std::size_t>(i * (count + 1) + j)] - level;
    };
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

/// Where a contour leaves the plane to the right, or above.
Label endOf(const Plane& plane, const Guide& contour, std::string text) {
    constexpr double inside = 0.93, above = 0.015;
    std::size_t last = 0;
    for (std::size_t i = 0; i < contour.x.size(); ++i)
        if (contour.x[i] > contour.x[last]) last = i;
    return {std::min(contour.x[last], plane.x(inside)),
            std::min(contour.y[last] * plane.y(above) / plane.bottom, plane.y(inside)), std::move(text)};
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
    const std::vector<double> errors =
        valuesOver(plane, [&](double n, double N) { return std::log(fit.errorAt(N, n)); });
    const auto addErrors = [&](double error, bool isStrong, const std::string& text) {
        Guide line = contourOf(plane, errors, std::log(error));
        if (line.x.empty()) return;
        line.isStrong = isStrong;
        figure.add(endOf(plane, line, text));
        figure.add(std::move(line));
    };
    for (double decade = std::pow(10.0, std::floor(std::log10(low))); decade < 10 * high; decade *= 10)
        if (std::abs(std::log10(decade / wish)) > 0.1) addErrors(decade, false, shortNumber(decade, 1));
    if (wish > 0) addErrors(wish, true, "wish " + shortNumber(wish, 2));
    const int cells = cellsAt(sweep, {row->point.scheme, 0, 0, 0, row->result.reduction});
    const auto steps = static_cast<double>(row->result.steps);
    if (row->result.isDone()) {
        const auto cost = [&](double n, double N) { return std::log(fit.relativeCostAt(N, n)); };
        Guide equal = contourOf(plane, valuesOver(plane, cost), cost(steps, cells));
        equal.isBroad = true;
        figure.add(std::move(equal));
    }
    figure.add(std::move(runs));
    figure.subtitle = "errors as fitted to the runs, the dots";
    if (row->result.isDone())
        figure.subtitle += "; broad: what costs as much as " + std::to_string(cells) + " elements and " +
                           shortNumber(steps) + " steps";
    figure.summary = "Errors of " + spec.label + " over steps and elements, fitted to " +
                     std::to_string(row->result.tried.size()) + " runs.";
    return figure;
}

}  // namespace extremal
