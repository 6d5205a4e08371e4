#include "engine/figure/column_figure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace extremal {
namespace {

struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(const std::vector<double>& values) {
        for (const double v : values)
            if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    double length() const { return high - low; }
};

/// Whether the curves are about as wide as they are high, in the numbers of their axes.
bool areAboutSquare(const Figure& figure) {
    constexpr double atMost = 2;
    Extent x, y;
    for (const Series& s : figure.series()) {
        x.take(s.x);
        y.take(s.y);
    }
    const double wide = x.length(), high = y.length();
    return wide > 0 && high > 0 && wide <= atMost * high && high <= atMost * wide;
}

}  // namespace

std::string titleOfColumn(const FigureContext& context, const std::string& column) {
    if (context.system)
        for (const Quantity& c : stateColumns(*context.system))
            if (column == c.name && !c.title.empty()) {
                std::string title = c.title;
                if (title == c.symbol) return title;  // a letter is that letter
                title[0] =
                    static_cast<char>(title[0] >= 'a' && title[0] <= 'z' ? title[0] - 'a' + 'A' : title[0]);
                return title;
            }
    const std::string symbol = columnInfo(context, column).symbol;  // of an observable
    return symbol.empty() ? "Trajectory" : symbol;
}

Figure columnFigure(const FigureContext& context, const std::string& x, const std::string& y) {
    Figure figure = startFigure(context, titleOfColumn(context, y));
    const ColumnInfo xInfo = columnInfo(context, x), yInfo = columnInfo(context, y);
    figure.x = x == "t" ? timeAxis(context) : Axis{axisTitle(xInfo.symbol, xInfo.unit), false, false, {}};
    figure.y.title = axisTitle(yInfo.symbol, yInfo.unit);
    if (x == "t" && (y.starts_with("momentum.") || y.starts_with("p.")))
        addAgainstTime(figure, context, y, Take::value);
    else
        addCurves(figure, context, x, y);
    const bool isBoundaryProblem = context.system && kindOf<BoundaryProblem>(*context.system);
    // The circle of an oscillator is drawn as a circle; where one axis would be crowded, each has its own
    // scale.
    if (x != "t" && !isBoundaryProblem && areAboutSquare(figure)) figure.aspect = Aspect::equal;
    if (isBoundaryProblem && y == "u_exact" && !figure.series().empty()) {
        figure.y.title = "u";
        Series exact = figure.series().front();  // the same for all schemes
        exact.label = "exact solution";
        exact.style = exactStyle;
        figure.put(std::move(exact));
    }
    finishFigure(figure, context, figure.title + " " + yInfo.symbol + " against " + xInfo.symbol);
    return figure;
}

}  // namespace extremal
