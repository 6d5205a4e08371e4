// SPDX-License-Identifier: GPL-3.0-or-later
/// The picture of one time: how far its trails go back, where each scheme stands, and what is behind them.
#include <algorithm>
#include <cmath>

#include "engine/scene/bind.hpp"
#include "ui/stage/stage_inset.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/stage_shapes.hpp"

namespace extremal {
namespace {

// Of a trail, per scheme and picture.
constexpr std::size_t trailRows = 400, longTrailRows = 1500;

void move(std::vector<TrailPoint>& points, const Point& by) {
    for (TrailPoint& p : points)
        for (std::size_t i = 0; i < 3; ++i) p.r[i] += by[i];
}

/// The extent of a box along a direction.
double extentAlong(const Bounds& bounds, const Point& direction) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += std::abs(direction[i]) * (bounds.high[i] - bounds.low[i]);
    return sum;
}

/// The box of a picture, for all places of a tiling.
Bounds tiled(const Bounds& bounds, const StageTiling& tiling, const Point& right, const Point& up) {
    Bounds all = bounds;
    const double x = tiling.width * (tiling.columns - 1) / 2, y = tiling.height * (tiling.rows - 1) / 2;
    for (const double sign : {-1.0, 1.0})
        for (const Point& corner : {bounds.low, bounds.high}) {
            Point p = corner;
            for (std::size_t i = 0; i < 3; ++i) p[i] += sign * (x * right[i] + y * up[i]);
            all.add(p);
        }
    return all;
}

}  // namespace

void StagePlayer::findPotential() {
    if (tracks_.empty()) return;
    const State start = initialState(comparison_->scene, system_);
    potential_ = potentialCurves(system_, start, comparison_->scene.end.value, bounds_);
}

StagePlayer::Trace StagePlayer::traceFor(StageTrails trails) const {
    constexpr double longer = 10;
    Trace trace = trace_;
    const double whole = end() - start();
    if (!(trace.span > 0) || trails == StageTrails::fading) return trace;
    trace.span = trails == StageTrails::whole ? whole : std::min(whole, longer * trace.span);
    return trace;
}

/// What a picture in a plane shows. `whole`: keeps it where it is more than the motion.
const Bounds& StagePlayer::flatBounds(const StageLook& look, Bounds& whole) const {
    if (!look.hasPotential || potential_.bounds.isEmpty) return bounds_;
    whole = bounds_;
    whole.add(potential_.bounds);
    return whole;
}

StageTiling StagePlayer::tilingFor(double width, double height, const Camera& direction) const {
    constexpr double gap = 1.16;
    StageTiling best;
    const auto count = static_cast<int>(tracks_.size());
    const auto axes = direction.axes();
    best.right = axes[0];
    best.up = axes[1];
    best.width = gap * (isSpatial() ? seen_.high[0] - seen_.low[0] : extentAlong(bounds_, axes[0]));
    best.height = gap * (isSpatial() ? seen_.high[1] - seen_.low[1] : extentAlong(bounds_, axes[1]));
    const double least = 0.25 * std::max(best.width, best.height);  // room for the names
    best.width = std::max(best.width, least);
    best.height = std::max(best.height, least);
    double largest = 0;
    for (int columns = 1; columns <= count; ++columns) {
        const int rows = (count + columns - 1) / columns;
        const double scale = std::min(width / (columns * best.width), height / (rows * best.height));
        if (scale <= largest) continue;
        largest = scale;
        best.columns = columns;
        best.rows = rows;
    }
    return best;
}

/// The projection from a corner fits the picture more closely than the bounding box. An inset takes a part of
/// the right, or of the bottom of what is tall.
Camera StagePlayer::fittedCamera(double width, double height, double margin, const StageLook& look) const {
    // The picture of a field over a rectangle needs no room around it.
    if (!system_.field.y.empty()) margin = std::min(margin, 10.0);
    const StageTiling& tiling = look.tiling;
    if (!isSpatial()) {
        Bounds whole;
        const Bounds& bounds = flatBounds(look, whole);
        return fitCamera(tiling.isOne() ? bounds : tiled(bounds, tiling, {1, 0, 0}, {0, 1, 0}), width, height,
                         margin);
    }
    const Bounds seen = tiling.isOne() ? seen_ : tiled(seen_, tiling, {1, 0, 0}, {0, 1, 0});
    const double taken = inset_ && tiling.isOne() ? InsetPlace::corner(width, height) : 0;
    const bool isWide = width >= height;
    const Camera flat = fitCamera(seen, width - (isWide ? taken : 0), height - (isWide ? 0 : taken), margin);
    Camera camera = cornerView();
    const auto axes = camera.axes();
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) camera.centre[i] += axes[k][i] * flat.centre[k];
    camera.pixelsPerUnit = flat.pixelsPerUnit;
    camera.centre = isWide ? camera.unproject(taken / 2, 0) : camera.unproject(0, -taken / 2);
    return camera;
}

StageFrame StagePlayer::frame(double t, const StageStyle& style, const StageLook& look) const {
    StageFrame frame;
    frame.t = t;
    frame.style = style;
    frame.bounds = bounds_;
    if (look.tiling.isOne()) frame.inset = inset_;
    if (look.hasPotential)
        for (const Curve& curve : potential_.curves) frame.scenery.push_back(curve);
    addExact(t, frame);
    const Trace trace = traceFor(look.trails);
    const std::size_t rows = look.trails == StageTrails::fading ? trailRows : longTrailRows;
    frame.trailSpan = trace.span;
    std::vector<double> x;
    Drawing drawing;
    for (const Track& track : tracks_) {
        StageLayer layer;
        layer.label =
            track.result->summary.label.empty() ? track.result->spec.label : track.result->summary.label;
        if (!style.series.empty())
            layer.colour =
                style
                    .series[static_cast<std::size_t>(std::max(track.result->style, 0)) % style.series.size()];
        const double tolerance = 1e-9 * (1 + std::abs(t));
        layer.hasEnded = track.hasFailed && t > track.t.back() + tolerance;
        if (layer.hasEnded) frame.notes.push_back(failureNote(track, layer.label));
        stateAt(track, t, x);
        drawing.clear();
        systemOf(track).draw(x.data(), drawing);
        const bool isFirst = frame.layers.empty();
        for (const Shape& shape : drawing.shapes) {
            if (!isScenery(shape))
                layer.shapes.push_back(shape);
            else if (isFirst)
                frame.scenery.push_back(shape);
        }
        addClocks(track, t, layer);
        layer.trail = trail(track, trace, t, rows);
        layer.marks = marks(track, trace, t);
        if (const std::string note = eventNote(track, layer.label, t); !note.empty())
            frame.notes.push_back(note);
        if (frame.inset) {
            layer.insetTracer = tracer(track, x, true);
            layer.insetTrail = trail(track, insetTrace_, t, trailRows);
        }
        frame.layers.push_back(std::move(layer));
    }
    constexpr double oldest = 0.7;  // a trail to the start does not fade away
    if (look.trails == StageTrails::whole)
        for (StageLayer& layer : frame.layers)
            for (TrailPoint& p : layer.trail) p.age *= oldest;
    if (!look.tiling.isOne()) tile(frame, look.tiling);
    return frame;
}

/// Each scheme at its place, with the scenery, and its name below.
void StagePlayer::tile(StageFrame& frame, const StageTiling& tiling) const {
    const std::vector<Shape> scenery = std::move(frame.scenery);
    frame.scenery.clear();
    Point middle = isSpatial() ? Point{} : Point{(bounds_.low[0] + bounds_.high[0]) / 2, bounds_.low[1], 0};
    if (isSpatial()) {
        const auto axes = cornerView().axes();
        for (std::size_t i = 0; i < 3; ++i)
            middle[i] = axes[0][i] * (seen_.low[0] + seen_.high[0]) / 2 + axes[1][i] * seen_.low[1];
    }
    for (std::size_t i = 0; i < frame.layers.size(); ++i) {
        const Point by = tiling.offset(i);
        StageLayer& layer = frame.layers[i];
        for (Shape& shape : layer.shapes) shape = movedBy(std::move(shape), by);
        move(layer.trail, by);
        move(layer.marks, by);
        for (const Shape& shape : scenery) frame.scenery.push_back(movedBy(shape, by));
        Point below = middle;
        for (std::size_t k = 0; k < 3; ++k) below[k] += by[k] - 0.05 * tiling.height * tiling.up[k];
        frame.scenery.push_back(Word{below, layer.label});
    }
}

}  // namespace extremal
