// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/studies/study_axes.hpp"

#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/figure/fit_axes.hpp"
#include "engine/run/reference/error_floor.hpp"

namespace extremal {

std::string errorTitle(const Sweep& sweep) {
    const std::string symbol = sweep.metric().title();
    const std::string size = symbol.starts_with("|") ? symbol : "|" + symbol + "|";
    return axisTitle(sweep.metric().isAtEnd ? size + " at the end" : "max " + size, sweep.metric().unit());
}

Figure studyFigureStart(const Sweep& sweep, const char* view, const char* title) {
    Figure figure;
    figure.view = view;
    figure.title = title;
    figure.y = logAxis(errorTitle(sweep));
    if (const double floor = referenceFloor(sweep.reference()); floor > 0) figure.add(DoubtfulBand{floor});
    if (sweep.metric().needsReference())
        figure.add(RoundOffFloor{0x1p-52 * largestEntry(sweep.scene().initial)});
    return figure;
}

void finishStudyFigure(Figure& figure, const std::string& what) {
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

}  // namespace extremal
