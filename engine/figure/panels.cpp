// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <type_traits>

#include "engine/figure/sample.hpp"

namespace extremal {
namespace {

/// The scheme that a layer belongs to; null: none.
const std::string* schemeOfLayer(const Layer& layer) {
    return std::visit(
        [](const auto& l) -> const std::string* {
            using L = std::decay_t<decltype(l)>;
            if constexpr (std::is_same_v<L, Series>)
                return l.style >= 0 ? &l.label : nullptr;
            else if constexpr (std::is_same_v<L, Area> || std::is_same_v<L, FailureMark> ||
                               std::is_same_v<L, EventMarks>)
                return &l.label;
            else
                return nullptr;
        },
        layer);
}

/// The points between two times, and those at both times.
void cut(Series& series, double from, double to) {
    Series part = series;
    part.x.clear();
    part.y.clear();
    part.t.clear();
    part.rows.clear();
    const auto add = [&](double t, double x, double y) {
        part.t.push_back(t);
        part.x.push_back(x);
        part.y.push_back(y);
    };
    const auto addEnd = [&](double t) {
        if (const auto p = hasLine(series.kind) && !series.isSparse ? pointAt(series, t) : std::nullopt)
            add(t, p->first, p->second);
    };
    addEnd(from);
    for (std::size_t i = 0; i < series.t.size(); ++i)
        if (series.t[i] > from && series.t[i] < to) add(series.t[i], series.x[i], series.y[i]);
    addEnd(to);
    series = std::move(part);
}

/// A place on an axis, 0 at its low and 1 at its high end.
double partOf(double value, const Axis& axis) {
    const auto [low, high] = *axis.range;
    return axis.isLog ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

/// Times spent in cells of the unit square.
class Visits {
public:
    explicit Visits(int cells) : cells_(cells), times_(static_cast<std::size_t>(cells * cells), 0.0) {}

    void addPoint(double x, double y, double time) {
        const double column = std::floor(x * cells_), row = std::floor(y * cells_);
        if (!(column >= 0 && column < cells_ && row >= 0 && row < cells_)) return;
        times_[static_cast<std::size_t>(column) * static_cast<std::size_t>(cells_) +
               static_cast<std::size_t>(row)] += time;
    }
    /// In pieces of at most a sixteenth of a cell, so that the time of a cell hardly depends on where they
    /// begin; of very long lines there are not too many.
    void addLine(double x0, double y0, double x1, double y1, double time) {
        const double length = std::hypot(x1 - x0, y1 - y0) * cells_;
        if (!std::isfinite(length)) return;
        const int pieces = std::clamp(static_cast<int>(16 * length) + 1, 1, 4000);
        for (int i = 0; i < pieces; ++i) {
            const double part = (i + 0.5) / pieces;
            addPoint(x0 + part * (x1 - x0), y0 + part * (y1 - y0), time / pieces);
        }
    }
    const std::vector<double>& times() const { return times_; }

private:
    int cells_;
    std::vector<double> times_;
};

void addVisits(Visits& visits, const Series& s, const Figure& figure) {
    const bool isTimed = s.t.size() == s.x.size();
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        const double x = partOf(s.x[i], figure.x), y = partOf(s.y[i], figure.y);
        if (!hasLine(s.kind) || s.isSparse) {
            visits.addPoint(x, y, 1);
        } else if (i + 1 < s.x.size()) {
            visits.addLine(x, y, partOf(s.x[i + 1], figure.x), partOf(s.y[i + 1], figure.y),
                           isTimed ? std::abs(s.t[i + 1] - s.t[i]) : 1);
        }
    }
}

HeatMap mapOf(const Figure& figure, int cells, std::vector<double> times) {
    double whole = 0;
    for (const double t : times) whole += t;
    double least = 1, most = 0;
    for (double& t : times) {
        t = t > 0 && whole > 0 ? t / whole : std::numeric_limits<double>::quiet_NaN();
        if (std::isnan(t)) continue;
        least = std::min(least, t);
        most = std::max(most, t);
    }
    HeatMap heat;
    std::tie(heat.left, heat.right) = *figure.x.range;
    std::tie(heat.bottom, heat.top) = *figure.y.range;
    heat.columns = heat.rows = cells;
    constexpr double decades = 3;  // rarer visits have the first colour
    heat.high = most > 0 ? std::pow(10, std::ceil(std::log10(most))) : 1;
    heat.low = std::max(std::pow(10, std::floor(std::log10(least))), heat.high * std::pow(10, -decades));
    if (!(heat.low < heat.high)) heat.low = heat.high / 10;
    heat.faults.assign(times.size(), "");
    heat.values = std::move(times);
    heat.scale = "share of the time";
    const auto middles = [cells](const Axis& axis) {
        const auto [low, high] = *axis.range;
        std::vector<double> all;
        for (int i = 0; i < cells; ++i) {
            const double part = (i + 0.5) / cells;
            all.push_back(axis.isLog ? low * std::pow(high / low, part) : low + part * (high - low));
        }
        return all;
    };
    heat.xs = middles(figure.x);
    heat.ys = middles(figure.y);
    return heat;
}

}  // namespace

bool isPortrait(const Figure& figure) {
    if (figure.x.isTime || figure.heat() || (figure.x.isLog && figure.y.isLog)) return false;
    if (!figure.x.range || !figure.y.range) return false;
    const auto all = figure.series();
    return std::any_of(all.begin(), all.end(), [](const Series& s) {
        return s.style >= 0 && (isParametric(s.kind) || (s.kind == SeriesKind::marks && s.rows.empty()));
    });
}

std::vector<std::string> schemesIn(const Figure& figure) {
    std::vector<std::string> labels;
    for (const Series& s : figure.series())
        if (s.style >= 0 && std::find(labels.begin(), labels.end(), s.label) == labels.end())
            labels.push_back(s.label);
    return labels;
}

Figure withSchemes(const Figure& figure, std::span<const std::string> labels) {
    Figure part = figure;
    if (labels.empty()) return part;
    std::erase_if(part.layers, [&](const Layer& layer) {
        const std::string* label = schemeOfLayer(layer);
        return label && std::find(labels.begin(), labels.end(), *label) == labels.end();
    });
    return part;
}

Figure withinTimes(const Figure& figure, double from, double to) {
    Figure part = figure;
    if (!(from < to)) return part;
    if (part.x.isTime) {
        part.x.range = {from, to};
        return part;
    }
    for (Series& s : part.series())
        if (!s.t.empty() && s.t.size() == s.x.size()) cut(s, from, to);
    return part;
}

std::vector<Figure> besideEachOther(const Figure& figure) {
    const std::vector<std::string> labels = schemesIn(figure);
    if (labels.size() < 2 || !isPortrait(figure)) return {figure};
    std::vector<Figure> panels;
    for (const std::string& label : labels) {
        panels.push_back(withSchemes(figure, std::span(&label, 1)));
        panels.back().title = label;
        panels.back().subtitle.clear();
        panels.back().summary = figure.title + " of " + label;
    }
    return panels;
}

Figure densityOf(const Figure& figure, int cells) {
    if (!isPortrait(figure) || cells < 1) return figure;
    Visits visits(cells);
    for (const Series& s : figure.series())
        if (s.style >= 0) addVisits(visits, s, figure);
    Figure map = figure;
    std::erase_if(map.layers, [](const Layer& layer) {
        const Series* s = std::get_if<Series>(&layer);
        return s && s->style >= 0;
    });
    map.add(mapOf(figure, cells, visits.times()));
    return map;
}

}  // namespace extremal
