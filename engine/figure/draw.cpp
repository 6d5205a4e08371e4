// SPDX-License-Identifier: GPL-3.0-or-later
/// The recipes that views share (view/recipe.hpp), each a function of its parameters.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "engine/figure/against.hpp"
#include "engine/figure/column_figure.hpp"
#include "engine/figure/starts.hpp"

namespace extremal {
namespace {

/// How far finite values reach.
struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void take(const std::vector<double>& values) {
        for (const double v : values) {
            if (!std::isfinite(v)) continue;
            low = std::min(low, v);
            high = std::max(high, v);
        }
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

struct Draw {
    const FigureContext& context;

    Figure operator()(const NoPlot&) const {
        throw std::invalid_argument("\"" + context.entry.item.id + "\" is not a plot");
    }

    Figure operator()(const ColumnAgainstTime& recipe) const {
        return columnAgainstTime(context, context.entry.item.title, recipe.column, recipe.isChangeRelative);
    }

    Figure operator()(const ErrorAgainstTime& recipe) const {
        Figure figure = startFigure(context, context.entry.item.title);
        const ColumnInfo column = columnInfo(context, recipe.column);
        const std::string symbol = recipe.symbol.empty() ? "|" + column.symbol + "|" : recipe.symbol;
        figure.y = logAxis(axisTitle(symbol, column.unit));
        addErrors(figure, context, recipe.column);
        std::vector<std::pair<double, std::string>> each;
        for (const Series& s : figure.series())
            if (s.x.back() >= 1 && std::isfinite(s.y.back()))
                each.emplace_back(s.y.back() / s.x.back(), s.label);
        if (isAgainstSteps(context.view) && !each.empty())
            figure.subtitle = "at the end, per step: " + leastToMost(each);
        if (recipe.scale > 0) figure.put(RoundOffFloor{0x1p-52 * recipe.scale});
        addChance(figure, context);
        finishFigure(figure, context,
                     context.entry.item.title + " " + againstText(context.view) +
                         (figure.subtitle.empty() ? "" : ", " + figure.subtitle));
        return figure;
    }

    Figure operator()(const StateAgainstTime&) const {
        const std::vector<std::string> columns =
            context.system ? context.entry.columns(*context.system) : std::vector<std::string>{};
        if (!columns.empty())
            return columnFigure(context, "t", context.view.y.empty() ? columns.front() : context.view.y);
        Figure figure = startFigure(context, context.entry.item.title);
        figure.x = timeAxis(context);
        finishFigure(figure, context, context.entry.item.title);
        return figure;
    }

    Figure operator()(const ColumnAgainstColumn& recipe) const {
        const View& view = context.view;
        const auto* system = context.system;
        const std::string x = system           ? recipe.x(view, *system)
                              : view.x.empty() ? first("q.")
                                               : view.x,
                          y = system           ? recipe.y(view, *system)
                              : view.y.empty() ? first("p.")
                                               : view.y;
        Figure figure = startFigure(context, context.entry.item.title);
        const ColumnInfo xInfo = columnInfo(context, x), yInfo = columnInfo(context, y);
        figure.x = x == "t" ? timeAxis(context) : Axis{axisTitle(xInfo.symbol, xInfo.unit), false, false, {}};
        figure.y.title = axisTitle(yInfo.symbol, yInfo.unit);
        addStarts(figure, context);
        addCurves(figure, context, x, y);
        // The circle of an oscillator is drawn as a circle. Where one axis would be crowded, each has its own
        // scale.
        const bool isOfMotion = x != "t" && y != "t" && !(system && system->independent != "t");
        if (isOfMotion && areAboutSquare(figure)) figure.aspect = Aspect::equal;
        finishFigure(figure, context,
                     context.entry.item.title + " of " + yInfo.symbol + " over " + xInfo.symbol);
        return figure;
    }

    Figure operator()(const OwnRecipe& recipe) const {
        for (const RecipeEntry& own : recipeEntries())
            if (own.name == recipe.name) return own.make(context);
        throw std::invalid_argument("no recipe is called \"" + recipe.name + "\"");
    }

private:
    /// Of a system that is not known.
    std::string first(const char* prefix) const {
        for (const auto& scheme : context.comparison.schemes)
            for (const Column& c : scheme->trajectory.columns)
                if (c.name.starts_with(prefix)) return c.name;
        return std::string(prefix) + "?";
    }
};

}  // namespace

Figure draw(const FigureContext& context) { return std::visit(Draw{context}, context.entry.recipe); }

}  // namespace extremal
