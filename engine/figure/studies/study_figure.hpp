// SPDX-License-Identifier: GPL-3.0-or-later
/// The plots of studies: a line per scheme over a ladder of steps, as the figure that the window, snapshots
/// and exports share.
#pragma once

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/study/stability/extremes_study.hpp"
#include "engine/study/stability/limits_study.hpp"
#include "engine/study/stability/linear_study.hpp"
#include "engine/study/stability/stability_study.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

/// Errors against the step, with the order of each scheme in its label and guides of orders 2, 4, 6 and 8
/// beside the curves. Adaptive schemes have no step and are left out.
Figure convergenceFigure(const Sweep& sweep);

/// Errors against the CPU time, with the spread of repeated runs as a band about each curve, the Pareto front
/// behind them, and slopes of orders 2, 4, 6 and 8 in the lower left corner.
Figure workPrecisionFigure(const Sweep& sweep);

/// The broad line through those of the points (CPU seconds, error) that are worth their cost, in place of the
/// one that the figure has.
void addFront(Figure& figure, std::vector<std::pair<double, double>> points);

/// The figure of a study by its id: errors against costs unless it has one of its own.
Figure studyFigure(std::string_view study, const Sweep& sweep);
/// Energy errors along the number that varies, or a map over both numbers with the limit along each row: of
/// one scheme, by its index in the scene, else of the first that was studied.
Figure studyFigure(std::string_view study, const StabilityStudy& stability,
                   std::optional<std::size_t> scheme = {});
/// Amplification over h w, with the limits of stability.
Figure studyFigure(std::string_view study, const LinearStudy& linear);
/// It has none.
inline Figure studyFigure(std::string_view, const ExtremesStudy&) { return {}; }

/// Of every scheme a bar over h: steps that are usable, and by shades those that are not.
Figure studyFigure(std::string_view study, const LimitsStudy& limits);

/// All plots of a study, the one above first; those behind it are named by their views.
template <class Study>
std::vector<Figure> studyFigures(std::string_view study, const Study& work) {
    return {studyFigure(study, work)};
}
/// Of a search with steps and elements, with the plane of both; of what a scene needs, with the costs of the
/// terms of its formula.
std::vector<Figure> studyFigures(std::string_view study, const Sweep& sweep);
/// With the regions of stability.
std::vector<Figure> studyFigures(std::string_view study, const LinearStudy& linear);

}  // namespace extremal
