// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/build.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/figure/fit_axes.hpp"
#include "engine/figure/sample.hpp"
#include "engine/scene/bind.hpp"
#include "engine/view/axes.hpp"

namespace extremal {

std::string axisTitle(std::string_view symbol, std::string_view unit) {
    std::string title(symbol);
    for (std::size_t at = 0; (at = title.find(" - ", at)) != std::string::npos; at += 3)
        title.replace(at, 3, " − ");
    if (!unit.empty()) title.append("  [").append(unit).append("]");
    return title;
}

std::string shortNumber(double value, int digits) {
    if (!std::isfinite(value)) return std::isnan(value) ? "unknown" : value > 0 ? "∞" : "−∞";
    std::array<char, 40> buffer;
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::general, std::max(digits, 1));
    std::string text(buffer.data(), end.ptr);
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return text;
    int exponent = 0;  // "1e+06" and "1e-06" lose their sign of plus and their zeros
    const std::size_t first = e + 1 + (text[e + 1] == '+' ? 1u : 0u);
    std::from_chars(text.data() + first, text.data() + text.size(), exponent);
    if (exponent >= 0 && exponent < 6) return std::to_string(std::llround(value));
    return text.substr(0, e + 1) + std::to_string(exponent);
}

ColumnInfo columnInfo(const FigureContext& context, std::string_view column) {
    for (const auto& scheme : context.comparison.schemes)
        if (const Column* c = scheme->trajectory.find(column))
            return {c->symbol.empty() ? c->name : c->symbol, c->unit};
    if (column == "t") return {"t", context.system ? context.system->timeUnit : ""};
    if (context.system) {
        for (const Quantity& c : stateColumns(*context.system))
            if (column == c.name) return {c.symbol, c.unit};
    }
    return {std::string(column), ""};
}

Axis timeAxis(const FigureContext& context) {
    const ColumnInfo t = columnInfo(context, "t");
    Axis axis;
    axis.title = axisTitle(t.symbol, t.unit);
    axis.isTime = true;
    const auto [start, end] = timeSpan(context.comparison.scene);
    if (std::isfinite(start) && std::isfinite(end) && end > start) axis.range = {start, end};
    return axis;
}

Axis logAxis(std::string title) {
    Axis axis;
    axis.title = std::move(title);
    axis.isLog = true;
    return axis;
}

Figure startFigure(const FigureContext& context, std::string title) {
    Figure figure;
    figure.view = context.view.id;
    figure.title = std::move(title);
    return figure;
}

namespace {

Series startSeries(const SchemeResult& scheme) {
    Series s;
    s.label = scheme.spec.label;
    s.style = scheme.style;
    return s;
}

}  // namespace

namespace {

/// A share of the samples, away from gaps and from what is small beside the range of all, at which the path
/// turns sharply: by more than 60 degrees on a curve, back on a line.
double sharpTurns(std::span<const double> x, std::span<const double> y, bool isCurve) {
    const auto rangeOf = [](std::span<const double> values) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const double v : values)
            if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
        return high > low ? high - low : 1;
    };
    constexpr double least = 0.02;
    const double xScale = isCurve ? 1 / rangeOf(x) : 0, yScale = 1 / rangeOf(y);
    int sharp = 0;
    for (std::size_t i = 2; i < x.size(); ++i) {
        const double ax = (x[i - 1] - x[i - 2]) * xScale, ay = (y[i - 1] - y[i - 2]) * yScale,
                     bx = (x[i] - x[i - 1]) * xScale, by = (y[i] - y[i - 1]) * yScale;
        const double a = std::hypot(ax, ay), b = std::hypot(bx, by);
        if (a > least && b > least && ax * bx + ay * by < 0.5 * a * b) ++sharp;
    }
    return x.size() > 2 ? sharp / static_cast<double>(x.size() - 2) : 0;
}

/// Rows that are several steps apart, so far that lines between them would be chords across the motion.
bool isSparse(const Trajectory& trajectory, const Series& series) {
    constexpr std::size_t few = 20;
    const std::vector<double>& nodes = trajectory.nodes;
    if (nodes.size() != series.x.size() || nodes.size() < few) return false;
    const double apart = (nodes.back() - nodes.front()) / static_cast<double>(nodes.size() - 1);
    const bool isCurve = series.kind == SeriesKind::curve;
    return apart > 1.5 && sharpTurns(series.x, series.y, isCurve) > (isCurve ? 0.05 : 0.25);
}

}  // namespace

void addAgainstTime(Figure& figure, const FigureContext& context, std::string_view column, Take take) {
    for (const auto& scheme : context.comparison.schemes) {
        const std::span<const double> t = scheme->trajectory["t"], y = scheme->trajectory[column];
        if (y.empty()) continue;
        Series s = startSeries(*scheme);
        s.x.assign(t.begin(), t.end());
        s.y.assign(y.begin(), y.end());
        if (take == Take::magnitude)
            for (double& v : s.y) v = std::abs(v);
        s.isSparse = isSparse(scheme->trajectory, s);
        figure.add(std::move(s));
    }
}

void addCurves(Figure& figure, const FigureContext& context, std::string_view xColumn,
               std::string_view yColumn) {
    for (const auto& scheme : context.comparison.schemes) {
        if (!context.view.scheme.empty() && scheme->spec.label != context.view.scheme) continue;
        const DenseOutput* dense = scheme->products.find<DenseOutput>();
        const bool isDense =
            dense && dense->points.find(xColumn) && dense->points.find(yColumn) &&
            dense->points.rows() >= scheme->trajectory.rows();  // rows may be the denser ones
        const Trajectory& from = isDense ? dense->points : scheme->trajectory;
        const std::span<const double> x = from[xColumn], y = from[yColumn];
        if (x.empty() || y.empty()) continue;
        Series s = startSeries(*scheme);
        s.kind = xColumn == "t" ? SeriesKind::line : SeriesKind::curve;
        if (const std::span<const double> t = from["t"]; s.kind == SeriesKind::curve)
            s.t.assign(t.begin(), t.end());
        s.x.assign(x.begin(), x.end());
        s.y.assign(y.begin(), y.end());
        s.isSparse = isSparse(from, s);
        figure.add(std::move(s));
    }
}

namespace {

/// A point with a coordinate its axis cannot show becomes a gap and is counted. The first value of an error
/// is zero by definition; it is a gap like the others.
void hideWhatAxesCannotShow(Figure& figure) {
    const double gap = Summary::unknown;
    for (Series& s : figure.series()) {
        for (std::size_t r = 0; r < s.x.size(); ++r) {
            const bool isShown = std::isfinite(s.x[r]) && std::isfinite(s.y[r]) &&
                                 (!figure.x.isLog || s.x[r] > 0) && (!figure.y.isLog || s.y[r] > 0);
            if (isShown) continue;
            s.y[r] = gap;
            if (!std::isfinite(s.x[r]) || (figure.x.isLog && s.x[r] <= 0)) s.x[r] = gap;
            ++s.hidden;
        }
    }
}

void markFailures(Figure& figure, const FigureContext& context) {
    const std::string unit = columnInfo(context, "t").unit;
    for (const auto& scheme : context.comparison.schemes) {
        const Summary& summary = scheme->summary;
        if (summary.status != RunStatus::failed || !std::isfinite(summary.failedAt)) continue;
        std::string cause(name(summary.cause));
        std::replace(cause.begin(), cause.end(), '-', ' ');
        if (cause.empty()) cause = "failed";
        figure.add(FailureMark{
            scheme->spec.label, scheme->style, summary.failedAt,
            cause + " at t = " + shortNumber(summary.failedAt, 3) + (unit.empty() ? "" : " " + unit)});
    }
}

/// "energy unsolvable".
std::string textOf(StepEvent event) {
    std::string text(name(event));
    std::replace(text.begin(), text.end(), '-', ' ');
    return text;
}

/// The steps of a scheme that had an event, on its curve; on axes of time at the lower edge where the curve
/// has no value. Some hundreds of them at most.
EventMarks marksOn(const Series& curve, const SchemeResult& scheme, bool isTime) {
    constexpr std::size_t most = 1000;
    const auto& all = scheme.events.marks;
    EventMarks marks;
    marks.label = scheme.spec.label;
    marks.style = scheme.style;
    for (std::size_t i = 0; i < all.size(); i += all.size() / most + 1) {
        const auto point = pointAt(curve, all[i].t);
        if (!point && !isTime) continue;
        marks.x.push_back(point ? point->first : all[i].t);
        marks.y.push_back(point ? point->second : Summary::unknown);
    }
    for (int e = 1; e < stepEventCount; ++e)
        if (const long long count = scheme.events.counts[static_cast<std::size_t>(e)]; count > 0)
            marks.text += (marks.text.empty() ? "" : ", ") + textOf(static_cast<StepEvent>(e)) + ": " +
                          std::to_string(count) + " of " + std::to_string(scheme.summary.steps) + " steps";
    return marks;
}

/// The events of the scene on the curve of a scheme.
EventMarks foundOn(const Series& curve, const FoundEvents& found, bool isTime) {
    constexpr std::size_t most = 1000;
    EventMarks marks;
    marks.label = curve.label;
    marks.style = curve.style;
    const std::span<const double> times = found.rows["t"];
    for (std::size_t i = 0; i < times.size(); i += times.size() / most + 1) {
        const auto point = pointAt(curve, times[i]);
        if (!point && !isTime) continue;
        marks.x.push_back(point ? point->first : times[i]);
        marks.y.push_back(point ? point->second : Summary::unknown);
    }
    for (const auto& event : found.all)
        if (event.spec.action != EventSpec::Action::count && event.count > 0)
            marks.text +=
                (marks.text.empty() ? "" : ", ") + event.spec.title() + ": " + std::to_string(event.count);
    return marks;
}

/// The first curve of a scheme, where it knows its times; else null.
const Series* curveOf(const Figure& figure, const SchemeResult& scheme) {
    for (const Series& s : figure.series())
        if (s.label == scheme.spec.label && s.style == scheme.style && !s.shade)
            return figure.x.isTime || !s.t.empty() ? &s : nullptr;
    return nullptr;
}

/// The events that the scene looks for, on the curves of its schemes.
void markFound(Figure& figure, const FigureContext& context) {
    for (const auto& scheme : context.comparison.schemes) {
        const FoundEvents* const found = scheme->products.find<FoundEvents>();
        const Series* const own = found ? curveOf(figure, *scheme) : nullptr;
        if (!own) continue;
        EventMarks marks = foundOn(*own, *found, figure.x.isTime);
        if (!marks.x.empty()) figure.add(std::move(marks));
    }
}

/// On the first curve of each scheme that knows its times. The subtitle counts: "▽ energy unsolvable: 11
/// (Reset), 110 (Keep)".
void markEvents(Figure& figure, const FigureContext& context) {
    std::array<std::string, stepEventCount> counted;
    for (const auto& scheme : context.comparison.schemes) {
        if (scheme->events.marks.empty()) continue;
        const Series* const own = curveOf(figure, *scheme);
        if (!own) continue;
        EventMarks marks = marksOn(*own, *scheme, figure.x.isTime);
        if (marks.x.empty()) continue;
        figure.add(std::move(marks));
        for (std::size_t e = 1; e < counted.size(); ++e)
            if (const long long count = scheme->events.counts[e]; count > 0)
                counted[e] += (counted[e].empty() ? "" : ", ") + std::to_string(count) + " (" +
                              scheme->spec.label + ")";
    }
    for (std::size_t e = 1; e < counted.size(); ++e)
        if (!counted[e].empty())
            figure.subtitle += (figure.subtitle.empty() ? "▽ " : " · ▽ ") +
                               textOf(static_cast<StepEvent>(e)) + ": " + counted[e];
}

/// "largest 0.03 (RK4), smallest 1e-7 (midpoint)", by the largest value of each series.
std::string extremesText(const Figure& figure) {
    const Series *most = nullptr, *least = nullptr;
    double high = 0, low = 0;
    for (const Series& s : figure.series()) {
        const double m = maxMagnitude(s.y);
        if (m == 0 || s.style < 0) continue;
        if (!most || m > high) most = &s, high = m;
        if (!least || m < low) least = &s, low = m;
    }
    if (!most) return "";
    if (most == least) return "; at most " + shortNumber(high) + " (" + most->label + ")";
    return "; at most between " + shortNumber(low) + " (" + least->label + ") and " + shortNumber(high) +
           " (" + most->label + ")";
}

}  // namespace

bool canHaveScale(const Figure& figure, bool isLog) {
    if (!figure.y.ticks.empty() || figure.heat()) return false;
    const auto all = figure.series();
    return !isLog || std::any_of(all.begin(), all.end(), [](const Series& s) {
        return std::any_of(s.y.begin(), s.y.end(), [](double y) { return y > 0 && std::isfinite(y); });
    });
}

void finishFigure(Figure& figure, const FigureContext& context, std::string_view what) {
    if (const auto isLog = context.view.isLog;
        isLog && *isLog != figure.y.isLog && canHaveScale(figure, *isLog)) {
        figure.y.isLog = *isLog;
        figure.y.range.reset();  // of the other scale
    }
    markFailures(figure, context);
    hideWhatAxesCannotShow(figure);
    markEvents(figure, context);
    markFound(figure, context);
    fitAxes(figure, context.view, context.system ? axesOf(context.view, *context.system).variable : "t");

    const bool hasPoints =
        figure.heat() || std::any_of(figure.series().begin(), figure.series().end(), [](const Series& s) {
            return std::any_of(s.y.begin(), s.y.end(), [](double v) { return std::isfinite(v); });
        });
    if (!hasPoints && figure.message.empty()) {
        const std::string& observable = context.entry.observable;
        const auto& observe = context.comparison.scene.observe;
        if (!observable.empty() && std::find(observe.begin(), observe.end(), observable) == observe.end())
            figure.message = "The scene does not observe \"" + observable + "\"";
        else
            figure.message = context.comparison.isFinished ? "Nothing to show" : "No values yet";
    }
    if (isEmpty(figure)) figure.axes = AxisStyle::none;  // ticks of nothing would be invented
    figure.summary = std::string(what);
    figure.summary += hasPoints ? extremesText(figure) : ": " + figure.message;
    for (const EventMarks& m : figure.all<EventMarks>()) figure.summary += "; " + m.label + ", " + m.text;
    for (const FailureMark& f : figure.all<FailureMark>()) figure.summary += "; " + f.label + " " + f.text;
    figure.summary += ".";
}

Figure columnAgainstTime(const FigureContext& context, std::string title, std::string_view column,
                         bool isRelative) {
    const ColumnInfo info = columnInfo(context, column);
    Figure figure = startFigure(context, title);
    figure.x = timeAxis(context);
    figure.y.title = axisTitle(info.symbol, info.unit);
    addAgainstTime(figure, context, column, Take::value);

    std::vector<std::pair<double, const Series*>> changes;
    for (const Series& s : figure.series()) {
        if (s.y.empty()) continue;
        // What steps have is not known at the first node.
        const auto first = std::find_if(s.y.begin(), s.y.end(), [](double v) { return std::isfinite(v); });
        if (first == s.y.end()) continue;
        const double start = *first;
        double change = 0;
        for (const double v : s.y)
            if (std::isfinite(v)) change = std::max(change, std::abs(v - start));
        if (isRelative) change /= std::abs(start);
        if (std::isfinite(change) && s.y.size() > 1) changes.emplace_back(change, &s);
    }
    if (!changes.empty()) {
        const auto [least, most] = std::minmax_element(
            changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        const auto text = [&](const auto& change) {
            const std::string value = shortNumber(change->first);
            return value + (isRelative || info.unit.empty() ? "" : " " + info.unit) + " (" +
                   change->second->label + ")";
        };
        figure.subtitle =
            std::string(isRelative ? "largest relative change: " : "largest change: ") + text(least);
        if (most != least) figure.subtitle += " to " + text(most);
    }
    finishFigure(figure, context,
                 title + " against time" + (figure.subtitle.empty() ? "" : ", " + figure.subtitle));
    return figure;
}

double maxMagnitude(std::span<const double> values) {
    double result = 0;
    for (double v : values)
        if (std::isfinite(v)) result = std::max(result, std::abs(v));
    return result;
}

double initialNorm(const Comparison& comparison, std::string_view prefix) {
    for (const auto& scheme : comparison.schemes) {
        if (scheme->trajectory.rows() == 0) continue;
        double norm = 0;
        for (const Column& c : scheme->trajectory.columns)
            if (c.name.starts_with(prefix) && std::isfinite(c.values.front()))
                norm = std::hypot(norm, c.values.front());
        return norm;
    }
    return 0;
}

}  // namespace extremal
