// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/column_figure.hpp"

#include <algorithm>
#include <string_view>

namespace extremal {
namespace {

/// Whether a title begins with a name of the scene, which is written as it is: x and X may both be there.
bool beginsWithName(const System& system, const std::string& title) {
    const std::string word = title.substr(0, title.find(' '));
    return word.size() == 1 || std::any_of(system.coordinates.begin(), system.coordinates.end(),
                                           [&](const Coordinate& c) { return c.name == word; });
}

}  // namespace

std::string titleOfColumn(const FigureContext& context, const std::string& column) {
    if (context.system)
        for (const Quantity& c : stateColumns(*context.system))
            if (column == c.name && !c.title.empty()) {
                std::string title = c.title;
                if (title == c.symbol || beginsWithName(*context.system, title)) return title;
                title[0] =
                    static_cast<char>(title[0] >= 'a' && title[0] <= 'z' ? title[0] - 'a' + 'A' : title[0]);
                return title;
            }
    constexpr std::string_view ofError = "error.";
    if (context.system && column.starts_with(ofError))
        for (const Coordinate& c : context.system->coordinates)
            if (column.substr(ofError.size()) == c.name && !c.title.empty()) return "Error: " + c.title;
    std::string symbol = columnInfo(context, column).symbol;  // of an observable
    std::replace(symbol.begin(), symbol.end(), '_', ' ');     // titles of cards have no lowered parts
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
    if (context.system && !context.system->isMotion() && y == "u_exact" && !figure.series().empty()) {
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
