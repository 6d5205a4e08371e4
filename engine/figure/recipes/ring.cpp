// SPDX-License-Identifier: GPL-3.0-or-later
/// A ring of starts as each scheme moves it: a closed curve that changes with time, over the faint one of the
/// start.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/figure/build.hpp"
#include "engine/figure/range.hpp"
#include "engine/observe/moving_ring.hpp"

namespace extremal::recipes {
namespace {

/// One component of a frame, closed.
std::vector<double> closed(const Frame& frame, std::size_t component) {
    constexpr std::size_t n = MovingRing::size;
    const auto first = frame.values->begin() + static_cast<std::ptrdiff_t>(component * n);
    std::vector<double> values(first, first + static_cast<std::ptrdiff_t>(n));
    values.push_back(values.front());
    return values;
}

const std::vector<Frame>* ringsOf(const SchemeResult& scheme) {
    const MovedRings* const rings = scheme.products.find<MovedRings>();
    return rings && !rings->frames.empty() ? &rings->frames : nullptr;
}

/// Of all times: what moves stays in sight. The rings of failed schemes count as little as their curves do.
std::pair<double, double> rangeOf(const Figure& figure, const Comparison& comparison,
                                  std::vector<double> MovingCurve::Moment::*component) {
    std::vector<std::vector<double>> values;
    std::vector<RangeInput> inputs;
    values.reserve(figure.series().size());
    for (const Series& s : figure.series()) {
        std::vector<double>& all = values.emplace_back();
        for (const MovingCurve::Moment& moment : s.moving->moments)
            all.insert(all.end(), (moment.*component).begin(), (moment.*component).end());
        const bool hasFailed =
            std::any_of(comparison.schemes.begin(), comparison.schemes.end(), [&](const auto& r) {
                return r->spec.label == s.label && r->summary.status == RunStatus::failed;
            });
        inputs.push_back({all, hasFailed});
    }
    return fitRange(inputs, false);
}

Figure makeRing(const FigureContext& context) {
    Figure figure = startFigure(context, "Moving ring");
    if (context.system) {
        const auto columns = stateColumns(*context.system);
        const auto title = [&](std::size_t entry) {
            return axisTitle(columns[entry].symbol, columns[entry].unit);
        };
        const MovingRing::Plane plane = MovingRing::planeOf(*context.system);
        figure.x.title = title(plane[0]);
        figure.y.title = title(plane[1]);
    }
    std::string said;
    for (const auto& scheme : context.comparison.schemes) {
        const std::vector<Frame>* const frames = ringsOf(*scheme);
        if (!frames) continue;
        if (figure.series().empty())
            figure.add(Guide{.x = closed(frames->front(), 0), .y = closed(frames->front(), 1)});
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.kind = SeriesKind::curve;
        s.x = closed(frames->back(), 0);
        s.y = closed(frames->back(), 1);
        auto moving = std::make_shared<MovingCurve>();
        for (const Frame& frame : *frames)
            moving->moments.push_back({frame.t, closed(frame, 0), closed(frame, 1)});
        s.moving = std::move(moving);
        figure.add(std::move(s));
        const double before = frames->front().values->back(), after = frames->back().values->back();
        if (figure.series().size() <= 3)
            said += (said.empty() ? "∮ θ changes by " : ", ") + shortNumber(std::abs(after / before - 1)) +
                    " (" + scheme->spec.label + ")";
    }
    figure.subtitle = said;
    if (!figure.series().empty()) {
        figure.x.range = rangeOf(figure, context.comparison, &MovingCurve::Moment::x);
        figure.y.range = rangeOf(figure, context.comparison, &MovingCurve::Moment::y);
    } else if (context.comparison.isFinished) {
        figure.message = "A ring needs a scheme with a fixed step";
    }
    finishFigure(figure, context, "A ring of starts moved by each scheme");
    figure.drop<FailureMark>();
    return figure;
}

}  // namespace

RecipeEntry ring() { return {"ring", makeRing}; }

}  // namespace extremal::recipes
