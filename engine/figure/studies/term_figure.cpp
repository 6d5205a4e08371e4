// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/studies/term_figure.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/figure/build.hpp"

namespace extremal {
namespace {

/// A name that has room beside a plot.
std::string shortened(const std::string& term) {
    constexpr std::size_t most = 24;
    return term.size() > most ? term.substr(0, most - 2) + " …" : term;
}

}  // namespace

Figure termFigure(const std::vector<TermCost>& costs, const std::string& error) {
    constexpr double around = 3;
    Figure figure;
    figure.view = "needs-terms";
    figure.title = "What each term costs to leave out";
    figure.subtitle = "bars: to first order; dots: measured without the term; it may go for a wish above " +
                      shortNumber(TermCost::safety) + " times its bar";
    figure.x = logAxis(error);
    double low = HUGE_VAL, high = 0;
    for (const TermCost& cost : costs)
        for (const double value : {cost.firstOrder, cost.measured})
            if (std::isfinite(value) && value > 0) low = std::min(low, value), high = std::max(high, value);
    Series measured;
    measured.label = "measured";
    measured.style = exactStyle;
    measured.kind = SeriesKind::marks;
    const double left = low / around, right = high * around;
    double height = 0;
    for (const TermCost& cost : costs) {
        figure.y.ticks.emplace_back(height, shortened(cost.term));
        if (cost.firstOrder > 0) figure.add(Guide{{left, cost.firstOrder}, {height, height}, false, true});
        if (std::isfinite(cost.measured) && cost.measured > 0) {
            measured.x.push_back(cost.measured);
            measured.y.push_back(height);
        }
        --height;
    }
    figure.y.range = {height + 0.5, 0.5};
    if (high > 0) figure.x.range = {left, right};
    if (!measured.x.empty()) figure.add(std::move(measured));
    if (!(high > 0)) figure.message = "No term has an effect on it";
    figure.summary = "First-order costs of " + std::to_string(costs.size()) + " terms.";
    return figure;
}

}  // namespace extremal
