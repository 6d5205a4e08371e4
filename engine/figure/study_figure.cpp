#include "engine/figure/study_figure.hpp"

#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/figure/fit_axes.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/convergence.hpp"
#include "engine/study/pareto.hpp"

namespace extremal {
namespace {

std::string errorTitle(const Sweep& sweep) {
    const Observer observer =
        sweep.metric().observable->bind({*sweep.scene().system, sweep.scene().initial, {}});
    const Column& column = observer.columns[static_cast<std::size_t>(observer.extreme)];
    const std::string symbol = column.symbol.empty() ? column.name : column.symbol;
    return axisTitle((sweep.metric().isAtEnd ? "|" + symbol + "| at the end" : "max |" + symbol + "|"),
                     column.unit);
}

Figure startOf(const Sweep& sweep, const char* view, const char* title) {
    Figure figure;
    figure.view = view;
    figure.title = title;
    figure.y = logAxis(errorTitle(sweep));
    const double own = sweep.reference().estimatedError;
    if (std::isfinite(own) && own > 0) figure.add(DoubtfulBand{10 * own});
    return figure;
}

Series curveOf(const Sweep& sweep, const SchemeRows& scheme) {
    Series s;
    s.label = sweep.scene().scene.schemes[scheme.scheme].label;
    s.style = static_cast<int>(scheme.scheme);
    s.kind = SeriesKind::markedLine;
    return s;
}

/// Values that a logarithmic axis cannot show become gaps.
void finish(Figure& figure, const std::string& what) {
    std::size_t points = 0, schemes = 0;
    for (Series& s : figure.series()) {
        for (std::size_t i = 0; i < s.y.size(); ++i) {
            const bool isShown = std::isfinite(s.y[i]) && s.y[i] > 0;
            if (!isShown) s.y[i] = PointResult::unknown, ++s.hidden;
            points += isShown;
        }
        ++schemes;
    }
    fitAxes(figure, View{}, "h");
    if (points == 0) figure.message = "No point has a result";
    figure.summary =
        what + " of " + std::to_string(schemes) + " schemes, " + std::to_string(points) + " points.";
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
    Figure figure = startOf(sweep, "convergence", "Error against step");
    figure.x = logAxis(axisTitle("step h", sweep.scene().system->timeUnit));
    double scale = 0;
    for (const double v : sweep.scene().initial.x) scale = std::max(scale, std::abs(v));
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        Series s = curveOf(sweep, scheme);
        for (const auto& [point, result] : scheme.rows)
            if (point.step > 0 && result.isDone()) {
                s.x.push_back(point.step);
                s.y.push_back(result.error);
            }
        if (s.x.empty()) continue;
        const OrderFit fit = fitOrder(scheme.rows, floorOf(sweep.reference()), scale);
        if (fit.isKnown()) s.label += ": " + shortNumber(fit.order, 3);
        figure.add(std::move(s));
    }
    figure.subtitle = "with the measured orders";
    addOrderGuides(figure);
    finish(figure, "Errors against the step");
    return figure;
}

Figure workPrecisionFigure(const Sweep& sweep) {
    Figure figure = startOf(sweep, "work-precision", "Speed against accuracy");
    figure.x = logAxis(axisTitle("CPU time", "s"));
    for (const SchemeRows& scheme : bySchemes(sweep)) {
        Series s = curveOf(sweep, scheme);
        s.kind = SeriesKind::markedCurve;
        for (const auto& [point, result] : scheme.rows)
            if (result.isDone()) {
                s.x.push_back(result.cpuSeconds);
                s.y.push_back(result.error);
            }
        if (s.x.empty()) continue;
        figure.add(std::move(s));
    }
    const std::vector<SweepRow>& rows = sweep.rows();
    const std::vector<bool> isOnFront = paretoFront(rows);
    std::vector<std::pair<double, double>> front;
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (isOnFront[i] && rows[i].result.error > 0)
            front.emplace_back(rows[i].result.cpuSeconds, rows[i].result.error);
    std::sort(front.begin(), front.end());
    Guide guide;
    guide.isStrong = true;
    for (const auto& [x, y] : front) {
        guide.x.push_back(x);
        guide.y.push_back(y);
    }
    if (guide.x.size() > 1) figure.add(std::move(guide));
    figure.subtitle = "lower left is better; the front behind the curves is what is worth its cost";
    finish(figure, "Errors against CPU time");
    return figure;
}

Figure studyFigure(std::string_view study, const Sweep& sweep) {
    if (study == "convergence") return convergenceFigure(sweep);
    if (study == "work-precision") return workPrecisionFigure(sweep);
    return {};
}

}  // namespace extremal
