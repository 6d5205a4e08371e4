// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/studies/study_figure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "engine/figure/build.hpp"
#include "engine/figure/fit_axes.hpp"
#include "engine/figure/studies/mesh_figure.hpp"
#include "engine/figure/studies/race_figure.hpp"
#include "engine/figure/studies/region_figure.hpp"
#include "engine/figure/studies/study_axes.hpp"
#include "engine/figure/studies/term_figure.hpp"
#include "engine/run/reference/error_floor.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/convergence.hpp"
#include "engine/study/search/pareto.hpp"

namespace extremal {
namespace {

Series curveOf(const Sweep& sweep, const SchemeRows& scheme) {
    Series s;
    const SchemeSpec& spec = sweep.scene().scene.schemes[scheme.scheme];
    s.label = spec.label;
    s.style = styleOf(spec, scheme.scheme);
    s.kind = SeriesKind::markedLine;
    return s;
}

/// Lines of slope 2, 4, 6 and 8 through the lower right corner of the data.
void addOrderGuides(Figure& figure) {
    double right = 0, low = HUGE_VAL, left = HUGE_VAL, high = 0;
    for (const Series& s : figure.series())
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            if (!(s.y[i] > 0) || !std::isfinite(s.y[i])) continue;
            right = std::max(right, s.x[i]);
            left = std::min(left, s.x[i]);
            low = std::min(low, s.y[i]);
            high = std::max(high, s.y[i]);
        }
    if (!(right > left) || !(high > low)) return;
    for (const int order : {2, 4, 6, 8}) {
        // From the top right corner down, as far as the data go.
        const double reach = std::pow(low / high, 1.0 / order) * right;
        const double from = std::max(left, reach);
        figure.add(Guide{{from, right}, {high * std::pow(from / right, order), high}});
        figure.add(Label{from, high * std::pow(from / right, order),
                         "h" + std::string(order == 2   ? "²"
                                           : order == 4 ? "⁴"
                                           : order == 6 ? "⁶"
                                                        : "⁸")});
    }
}

}  // namespace

Figure convergenceFigure(const Sweep& sweep) {
    Figure figure = studyFigureStart(sweep, "convergence", "Error against step");
    figure.x = logAxis(axisTitle("step h", sweep.scene().system->timeUnit));
    const std::vector<OrderFit> fits = fitOrders(sweep);
    auto next = fits.begin();
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        const OrderFit& fit = *next++;
        Series s = curveOf(sweep, scheme);
        for (const SweepRow& row : scheme.rows)
            if (row.point.step > 0 && row.result.isDone()) {
                s.x.push_back(row.point.step);
                s.y.push_back(row.result.error);
                s.rows.push_back(static_cast<std::size_t>(&row - sweep.rows().data()));
            }
        if (s.x.empty()) continue;
        if (fit.isKnown()) s.label += ": " + shortNumber(fit.order, 3);
        figure.add(std::move(s));
    }
    figure.subtitle = areMeshesRefined(sweep.rows()) ? "the mesh refined with it, with the measured orders"
                                                     : "with the measured orders";
    addOrderGuides(figure);
    finishStudyFigure(figure, "Errors against the step");
    return figure;
}

namespace {

/// What the times of a scheme may be as well, by their repetitions.
Area noiseOf(const Sweep& sweep, const SchemeRows& scheme) {
    Area area;
    const SchemeSpec& spec = sweep.scene().scene.schemes[scheme.scheme];
    area.label = spec.label;
    area.style = styleOf(spec, scheme.scheme);
    std::vector<const PointResult*> shown;
    for (const auto& [point, result] : scheme.rows)
        if (result.isDone() && result.cpuSpread > 0 && result.error > 0) shown.push_back(&result);
    for (const PointResult* r : shown) {
        area.x.push_back(std::max(r->cpuSeconds - r->cpuSpread, r->cpuSeconds / 4));
        area.y.push_back(r->error);
    }
    std::reverse(shown.begin(), shown.end());
    for (const PointResult* r : shown) {
        area.x.push_back(r->cpuSeconds + r->cpuSpread);
        area.y.push_back(r->error);
    }
    return area;
}

/// Triangles whose long sides fall as the error of orders 2, 4 and 8 does with the work, in the corner where
/// no curve is: accurate and cheap.
void addOrderTriangles(Figure& figure) {
    if (!figure.x.range || !figure.y.range) return;
    const auto [left, right] = *figure.x.range;
    const auto [low, high] = *figure.y.range;
    const double width = std::pow(right / left, 0.05), height = std::log(high / low);
    const double foot = left * std::pow(right / left, 0.13), bottom = low * std::exp(0.06 * height);
    for (const int order : {2, 4, 8}) {
        const double top = bottom * std::pow(width, order);
        if (std::log(top / bottom) > 0.5 * height) break;
        figure.add(Guide{{foot, foot / width, foot / width, foot}, {bottom, bottom, top, bottom}, true});
        figure.add(Label{foot / std::pow(width, 1.25), top, std::to_string(order)});
    }
}

}  // namespace

Figure workPrecisionFigure(const Sweep& sweep) {
    Figure figure = studyFigureStart(sweep, "work-precision", "Speed against accuracy");
    figure.x = logAxis(axisTitle("CPU time", "s"));
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        Series s = curveOf(sweep, scheme);
        s.kind = SeriesKind::markedCurve;
        for (const SweepRow& row : scheme.rows)
            if (row.result.isDone()) {
                s.x.push_back(row.result.cpuSeconds);
                s.y.push_back(row.result.error);
                s.rows.push_back(static_cast<std::size_t>(&row - sweep.rows().data()));
            }
        if (s.x.empty()) continue;
        if (Area noise = noiseOf(sweep, scheme); noise.x.size() > 2) figure.add(std::move(noise));
        figure.add(std::move(s));
    }
    std::vector<std::pair<double, double>> points;
    for (const SweepRow& row : sweep.rows())
        if (sweep.isJudged(row.result)) points.emplace_back(row.result.cpuSeconds, row.result.error);
    addFront(figure, std::move(points));
    figure.subtitle = "lower left is better; on the broad line is what is worth its cost";
    finishStudyFigure(figure, "Errors against CPU time");
    addOrderTriangles(figure);
    return figure;
}

void addFront(Figure& figure, std::vector<std::pair<double, double>> points) {
    std::erase_if(figure.layers, [](const Layer& layer) {
        const Guide* const guide = std::get_if<Guide>(&layer);
        return guide && guide->isBroad;
    });
    std::erase_if(points, [](const auto& point) { return point.second == 0; });  // the axis is logarithmic
    Guide guide;
    guide.isBroad = true;
    for (const std::size_t i : paretoFront(points)) {
        guide.x.push_back(points[i].first);
        guide.y.push_back(points[i].second);
    }
    if (guide.x.size() > 1) figure.add(std::move(guide));
}

Figure studyFigure(std::string_view study, const Sweep& sweep) {
    if (study == "convergence") return convergenceFigure(sweep);
    const bool isRace = std::any_of(sweep.rows().begin(), sweep.rows().end(),
                                    [](const SweepRow& row) { return !row.result.tried.empty(); });
    if (study == "cheapest" && isRace) return raceFigure(sweep);
    return workPrecisionFigure(sweep);
}

namespace {

/// "k  [N/m]" of a number of the model, "step h  [s]"; else its place in the scene.
std::string titleOf(const VariedNumber& number, const StabilityStudy& study) {
    for (const ModelParameter& p : parametersOf(study.scene().scene))
        if (p.pointer == number.pointer) return axisTitle(p.symbol, p.unit);
    if (number.pointer.starts_with("/schemes/") && number.pointer.ends_with("/step"))
        return axisTitle("step h", study.scene().system->timeUnit);
    return number.pointer;
}

Axis axisOf(const VariedNumber& number, const StabilityStudy& study) {
    Axis axis = number.isLog ? logAxis({}) : Axis{};
    axis.title = titleOf(number, study);
    return axis;
}

/// Energy errors against the number that varies; a gap where a run was not bounded, with a mark at its edge.
Figure alongX(const StabilityStudy& study) {
    Figure figure;
    figure.x = axisOf(study.options().x, study);
    figure.y = logAxis(axisTitle("max |H - H(0)|", study.scene().system->energyUnit));
    for (std::size_t scheme = 0; scheme < study.scene().scene.schemes.size(); ++scheme) {
        Series s;
        s.label = study.scene().scene.schemes[scheme].label;
        s.style = styleOf(study.scene().scene.schemes[scheme], scheme);
        s.kind = SeriesKind::markedLine;
        for (std::size_t i = 0; i < study.rows().size(); ++i) {
            const StabilityStudy::Row& row = study.rows()[i];
            if (row.scheme != scheme || row.result.kind == StabilityClass::waiting) continue;
            s.rows.push_back(i);
            s.x.push_back(row.x);
            s.y.push_back(row.result.isBounded() ? row.result.maxEnergyError : PointResult::unknown);
        }
        if (s.x.empty()) continue;
        for (const StabilityStudy::Limit& each : study.limits())
            if (each.scheme == scheme && std::isfinite(each.limit.limit))
                s.label += ": up to " + shortNumber(each.limit.low, 5);
        figure.add(std::move(s));
    }
    double low = HUGE_VAL, high = 0;
    for (const Series& s : figure.series())
        for (const double y : s.y)
            if (y > 0 && std::isfinite(y)) low = std::min(low, y), high = std::max(high, y);
    if (high > 0) figure.y.range = {low / 2, high * 4};
    for (const StabilityStudy::Limit& each : study.limits()) {
        const double limit = each.limit.limit;
        if (!std::isfinite(limit) || !(high > 0)) continue;
        figure.add(Guide{{limit, limit}, {low / 2, 4 * high}});
    }
    const std::vector<ResonancePeak> resonances = resonancesOf(study);
    for (const ResonancePeak& r : resonances) {
        const double turns = r.phase / std::numbers::pi;
        const std::string text =
            std::isfinite(turns) ? "hω = " + shortNumber(turns, 3) + " π" : shortNumber(r.x, 3);
        const double top = std::isfinite(r.energyError) ? r.energyError : high;
        figure.add(Label{r.x, 2 * top, text});  // above the mark
    }
    figure.subtitle = "gaps where a run was not bounded";
    if (!resonances.empty()) figure.subtitle += "; peaks: " + std::to_string(resonances.size());
    finishStudyFigure(figure, "Energy errors against " + study.options().x.pointer);
    return figure;
}

/// Of one scheme: energy errors as colours over both numbers, with the class of a run that is not stable, and
/// the limits along x as a line.
Figure overBoth(const StabilityStudy& study, std::size_t scheme) {
    const VariedNumber &x = study.options().x, &y = *study.options().y;
    Figure figure;
    figure.x = axisOf(x, study);
    figure.y = axisOf(y, study);
    HeatMap heat;
    heat.columns = x.count;
    heat.rows = y.count;
    heat.xs = x.values();
    heat.ys = y.values();
    const auto edges = [](const VariedNumber& number) {
        const std::vector<double> all = number.values();
        const double half = 0.5 / (number.count - 1);
        return number.isLog ? std::pair{all.front() * std::pow(number.from / number.to, half),
                                        all.back() * std::pow(number.to / number.from, half)}
                            : std::pair{all.front() - half * (number.to - number.from),
                                        all.back() + half * (number.to - number.from)};
    };
    std::tie(heat.left, heat.right) = edges(x);
    std::tie(heat.bottom, heat.top) = edges(y);
    const auto cells = static_cast<std::size_t>(heat.columns) * static_cast<std::size_t>(heat.rows);
    heat.values.assign(cells, PointResult::unknown);
    heat.faults.assign(cells, "");
    heat.scale = axisTitle("max |H - H(0)|", study.scene().system->energyUnit);
    heat.low = HUGE_VAL;
    heat.high = 0;
    const auto first = std::find_if(study.rows().begin(), study.rows().end(),
                                    [&](const StabilityStudy::Row& row) { return row.scheme == scheme; });
    for (std::size_t i = 0; i < cells; ++i) {
        const StabilityStudy::Row& row = first[static_cast<std::ptrdiff_t>(i)];  // y by y, along x
        const std::size_t at = i % heat.xs.size() * heat.ys.size() + i / heat.xs.size();
        if (row.result.kind != StabilityClass::stable) heat.faults[at] = name(row.result.kind);
        if (!row.result.isBounded()) continue;
        const double value = row.result.maxEnergyError;
        if (!(value > 0)) continue;
        heat.values[at] = value;
        heat.low = std::min(heat.low, value);
        heat.high = std::max(heat.high, value);
    }
    if (!(heat.high > heat.low)) heat.low = 1e-16, heat.high = 1;
    figure.x.range = {heat.left, heat.right};
    figure.y.range = {heat.bottom, heat.top};
    figure.subtitle = study.scene().scene.schemes[scheme].label;
    figure.summary = "Energy errors of " + figure.subtitle + " over " + x.pointer + " and " + y.pointer + ".";
    figure.add(std::move(heat));
    Guide boundary;
    boundary.isStrong = true;
    for (const StabilityStudy::Limit& each : study.limits())
        if (each.scheme == scheme && each.isKnown) {
            boundary.x.push_back(each.limit.limit);
            boundary.y.push_back(each.y);
        }
    if (!boundary.x.empty()) figure.add(std::move(boundary));
    return figure;
}

}  // namespace

Figure studyFigure(std::string_view study, const StabilityStudy& stability,
                   std::optional<std::size_t> scheme) {
    Figure figure = stability.options().y
                        ? overBoth(stability, scheme.value_or(stability.rows().front().scheme))
                        : alongX(stability);
    figure.view = study;
    figure.title = "Stability";
    return figure;
}

Figure studyFigure(std::string_view study, const LinearStudy& linear) {
    Figure figure;
    figure.view = study;
    figure.title = "Linear stability";
    figure.subtitle = "amplification of one step; 1 is conserved, above it grows";
    figure.x.title = axisTitle("h ω", "");
    figure.y = logAxis(axisTitle("max |r|", ""));
    for (const LinearStudy::Row& row : linear.rows()) {
        if (row.result.points.empty()) continue;
        Series s;
        s.label = linear.scene().scene.schemes[row.scheme].label + ": " +
                  (row.result.hasLimit ? "up to " + shortNumber(row.result.low, 5) : "no limit");
        s.style = static_cast<int>(row.scheme);
        s.kind = SeriesKind::line;
        for (const LinearStability::Point& p : row.result.points) {
            s.x.push_back(p.z);
            s.y.push_back(p.amplification);
        }
        figure.add(std::move(s));
    }
    finishStudyFigure(figure, "Amplification of one step over h ω");
    figure.y.range = {0.5, 4};  // what grows faster is unstable all the same
    return figure;
}

Figure studyFigure(std::string_view study, const LimitsStudy& limits) {
    Figure figure;
    figure.view = study;
    figure.title = "How large may h be?";
    figure.subtitle = "broad: usable steps; thin: not usable, and why";
    figure.x = logAxis(axisTitle("step h", limits.scene().system->timeUnit));
    double height = 0, left = HUGE_VAL, right = 0;
    for (const LimitsStudy::Row& row : limits.rows()) {
        const SchemeSpec& spec = limits.scene().scene.schemes[row.scheme];
        Series usable;
        usable.label = spec.label;
        usable.style = styleOf(spec, row.scheme);
        usable.kind = SeriesKind::markedLine;
        for (const StepRange& range : row.result.ranges) {
            left = std::min(left, range.from);
            right = std::max(right, range.to);
            if (range.isUsable()) {
                const std::vector<double> ends{range.from, range.to, PointResult::unknown};
                usable.x.insert(usable.x.end(), ends.begin(), ends.end());
                usable.y.insert(usable.y.end(), {height, height, PointResult::unknown});
                figure.add(Guide{{range.from, range.to}, {height, height}, false, true});
            } else {
                figure.add(Guide{{range.from, range.to}, {height, height}});
                constexpr double room = 1.4;  // for the word
                if (range.to < room * range.from && row.result.ranges.size() > 1) continue;
                figure.add(
                    Label{std::sqrt(range.from * range.to), height + 0.25, std::string(name(range.reason))});
            }
        }
        figure.y.ticks.emplace_back(height, spec.label);
        if (!usable.x.empty()) figure.add(std::move(usable));
        --height;
    }
    constexpr double around = 2;  // a single step
    if (right > 0)
        figure.x.range = {right > left ? left : left / around, right > left ? right : right * around};
    figure.y.range = {height + 0.5, 0.5};
    if (!(right > 0)) figure.message = "No point has a result";
    figure.summary = "Usable steps of " + std::to_string(limits.rows().size()) + " schemes.";
    return figure;
}

std::vector<Figure> studyFigures(std::string_view study, const Sweep& sweep) {
    std::vector<Figure> all{studyFigure(study, sweep)};
    if (sweep.options().wantedError > 0)
        if (std::optional<Figure> plane = meshFigure(sweep)) all.push_back(std::move(*plane));
    if (!sweep.terms().empty()) all.push_back(termFigure(sweep.terms(), errorTitle(sweep)));
    return all;
}

std::vector<Figure> studyFigures(std::string_view study, const LinearStudy& linear) {
    return {studyFigure(study, linear), regionFigure(linear)};
}

}  // namespace extremal
