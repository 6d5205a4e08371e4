// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/growth.hpp"

#include <algorithm>
#include <cmath>

#include "engine/figure/against.hpp"

namespace extremal {

Figure growthFigure(const FigureContext& context, const std::string& column, Take take) {
    Figure figure = startFigure(context, context.entry.item.title);
    figure.x = logAxis(timeAxis(context).title);
    addAgainstTime(figure, context, column, take);
    const double start = context.comparison.scene.start.value;
    double first = 0, last = 0;
    for (Series& s : figure.series()) {
        for (double& t : s.x) {
            t = std::abs(t - start);
            if (t > 0) first = first > 0 ? std::min(first, t) : t;
            last = std::max(last, t);
        }
    }
    if (last > first && first > 0) figure.x.range = {first, last};
    return figure;
}

std::string lastValues(const Figure& figure) {
    std::vector<std::pair<double, std::string>> each;
    for (const Series& s : figure.series())
        if (!s.y.empty() && std::isfinite(s.y.back())) each.emplace_back(s.y.back(), s.label);
    return leastToMost(each);
}

}  // namespace extremal
