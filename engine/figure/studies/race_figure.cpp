// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/studies/race_figure.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/figure/build.hpp"
#include "engine/figure/studies/study_axes.hpp"

namespace extremal {
namespace {

/// The runs of a candidate that have a place, in their order.
std::vector<TriedRun> pathOf(const PointResult& result) {
    std::vector<TriedRun> path = result.tried;
    std::erase_if(path, [](const TriedRun& run) {
        return !(run.cost > 0 && run.error > 0 && std::isfinite(run.error));
    });
    return path;
}

/// Its place is where the candidate ended.
Label reasonAt(const TriedRun& last, const std::string& label, const std::string& reason) {
    constexpr std::size_t most = 60;
    std::string text = label + ": " + reason;
    if (text.size() > most) text = text.substr(0, text.rfind(' ', most)) + " ...";
    return {last.cost, last.error, std::move(text)};
}

/// The line that has to be reached, with the plot cut to errors that say something.
void addWish(Figure& figure, const Sweep& sweep) {
    constexpr double aboveMotion = 3, room = 2, place = 0.06;
    const double wish = sweep.options().wantedError;
    if (!figure.x.range || !figure.y.range || !(wish > 0)) return;
    const auto [left, right] = *figure.x.range;
    auto& [low, high] = *figure.y.range;
    low = std::min(low, wish / room);
    high = std::max(std::min(high, aboveMotion * sweep.metricSize()), wish * room);
    figure.add(Guide{{left, right}, {wish, wish}, true});
    figure.add(Label{left * std::pow(right / left, place), wish * std::pow(high / low, 0.02),
                     "wish " + shortNumber(wish, 2)});
}

}  // namespace

Figure raceFigure(const Sweep& sweep) {
    const bool isCounted = sweep.options().repeat == 0;
    Figure figure = studyFigureStart(sweep, "cheapest", "The race for the cheapest");
    figure.x = logAxis(isCounted ? "evaluations" : axisTitle("CPU time", "s"));
    std::vector<const SweepRow*> dropped;
    for (const SweepRow& row : sweep.rows()) {
        const PointResult& r = row.result;
        if (r.status == RunStatus::waiting) continue;
        if (!r.isDone()) {
            dropped.push_back(&row);
            continue;
        }
        const SchemeSpec& spec = sweep.scene().scene.schemes[row.point.scheme];
        Series s;
        s.label = spec.label;
        s.style = styleOf(spec, row.point.scheme);
        s.kind = SeriesKind::markedCurve;
        std::vector<TriedRun> path = pathOf(r);
        path.push_back({isCounted ? workOf(r, 1) : r.cpuSeconds, r.error});
        for (const TriedRun& run : path) {
            s.x.push_back(run.cost);
            s.y.push_back(run.error);
            s.rows.push_back(static_cast<std::size_t>(&row - sweep.rows().data()));
        }
        figure.add(std::move(s));
    }
    Series faint;
    faint.label = "dropped";
    faint.style = formulaStyle;
    faint.tone = Tone::pale;
    faint.kind = SeriesKind::marks;
    std::vector<std::pair<double, Label>> reasons;
    for (const SweepRow* row : dropped) {
        const std::vector<TriedRun> path = pathOf(row->result);
        if (path.empty()) continue;
        Guide way;
        for (const TriedRun& run : path) {
            way.x.push_back(run.cost);
            way.y.push_back(run.error);
            faint.rows.push_back(static_cast<std::size_t>(row - sweep.rows().data()));
        }
        faint.x.insert(faint.x.end(), way.x.begin(), way.x.end());
        faint.y.insert(faint.y.end(), way.y.begin(), way.y.end());
        if (way.x.size() > 1) figure.add(std::move(way));
        reasons.emplace_back(
            row->result.excess,
            reasonAt(path.back(), sweep.scene().scene.schemes[row->point.scheme].label, row->result.reason));
    }
    const bool areReached = !figure.series().empty();
    if (!faint.x.empty()) figure.add(std::move(faint));
    // Beside curves words would hide more than they say: the table has all reasons.
    const auto nearest = std::min_element(reasons.begin(), reasons.end(),
                                          [](const auto& a, const auto& b) { return a.first < b.first; });
    if (!areReached && nearest != reasons.end()) figure.add(std::move(nearest->second));
    figure.subtitle = areReached ? "the runs of each candidate; faint: those that were dropped"
                                 : "no candidate reaches it; the nearest, and why";
    finishStudyFigure(figure, "Errors against costs of the runs");
    if (sweep.options().budget <= 0) addWish(figure, sweep);
    return figure;
}

}  // namespace extremal
