// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/stage_player.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "engine/core/text/text.hpp"
#include "engine/scene/bind.hpp"
#include "ui/stage/stage_inset.hpp"
#include "ui/stage/stage_shapes.hpp"

namespace extremal {
namespace {

constexpr std::size_t maxBoundsRows = 500;  // per scheme

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
bool isFinite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

/// The points that make up the extent of one shape.
void addExtent(const Shape& shape, std::vector<Point>& points) {
    if (const auto* segment = std::get_if<Segment>(&shape))
        points.insert(points.end(), {segment->a, segment->b});
    if (const auto* spring = std::get_if<Spring>(&shape)) points.insert(points.end(), {spring->a, spring->b});
    if (const auto* disc = std::get_if<Disc>(&shape)) points.push_back(disc->centre);
    if (const auto* solid = std::get_if<Solid>(&shape))
        for (std::size_t c = 0; c < solid->corners.size();
             c += solid->isSmooth ? 5 : 1)  // some of many close ones
            points.push_back(solid->corners[c]);
    if (const auto* curtain = std::get_if<Curtain>(&shape))
        points.insert(points.end(), curtain->top.begin(), curtain->top.end());
    if (const auto* raster = std::get_if<Raster>(&shape)) {
        const Point& p = raster->corner;
        points.insert(points.end(), {p, {p[0] + raster->width, p[1] + raster->height, p[2]}});
    }
    if (const auto* curve = std::get_if<Curve>(&shape))
        points.insert(points.end(), curve->points.begin(), curve->points.end());
    if (const auto* support = std::get_if<Support>(&shape)) {
        Point left = support->centre, right = support->centre;
        left[0] -= support->width / 2;
        right[0] += support->width / 2;
        points.insert(points.end(), {left, right});
    }
}

/// The box of the points without those far beyond the rest: more than 6 times the median distance from the
/// component-wise median. An ellipse of eccentricity 0.99 stays whole, the tail of a blow-up goes.
Bounds robustBounds(const std::vector<Point>& points) {
    Bounds bounds;
    if (points.empty()) return bounds;
    const auto median = [](std::vector<double>& v) {
        std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
        return v[v.size() / 2];
    };
    Point middle{};
    std::vector<double> values(points.size());
    for (std::size_t i = 0; i < 3; ++i) {
        std::transform(points.begin(), points.end(), values.begin(), [i](const Point& p) { return p[i]; });
        middle[i] = median(values);
    }
    std::transform(points.begin(), points.end(), values.begin(),
                   [&](const Point& p) { return distance(p, middle); });
    const double reach = 6 * median(values);
    for (const Point& p : points)
        if (reach == 0 || distance(p, middle) <= reach) bounds.add(p);
    return bounds;
}

/// Whether all points lie on one line, within a thousandth of its length: |a x b| = |a| times the distance
/// from it.
bool isStraight(const std::vector<Point>& path) {
    const auto far = std::max_element(path.begin(), path.end(), [&](const Point& a, const Point& b) {
        return distance(a, path[0]) < distance(b, path[0]);
    });
    const Point a = {(*far)[0] - path[0][0], (*far)[1] - path[0][1], (*far)[2] - path[0][2]};
    const double length = distance(*far, path[0]);
    return std::all_of(path.begin(), path.end(), [&](const Point& p) {
        const Point b = {p[0] - path[0][0], p[1] - path[0][1], p[2] - path[0][2]};
        const double away =
            std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
        return away <= 1e-3 * length * length;
    });
}

}  // namespace

StagePlayer::StagePlayer(std::shared_ptr<const Comparison> comparison) : comparison_(std::move(comparison)) {
    if (!comparison_) return;
    const Settings& model = comparison_->scene.model;
    if (const ModelEntry* entry = findModel(model.type)) system_ = entry->make(model);
    prepare();
}

StagePlayer::StagePlayer(std::shared_ptr<const Comparison> comparison, System system)
    : comparison_(std::move(comparison)), system_(std::move(system)) {
    if (comparison_) prepare();
}

void StagePlayer::prepare() {
    if (!system_.draw) return;
    for (const auto& result : comparison_->schemes) addTrack(result);
    if (tracks_.empty()) return;
    for (Track& track : tracks_) {
        const auto& scheme = track.result->scheme;
        track.system = scheme && scheme->ownSystem ? scheme->ownSystem.get() : nullptr;
    }
    if (system_.field.isGraph) {
        const State start = initialState(comparison_->scene, system_);
        exact_ = exactSolution(comparison_->scene, system_, start);
        exactWidth_ = start.x.size();
    }

    // Schemes that failed, or that reach far beyond the others, do not set the scale of the picture.
    std::vector<Extent> all;
    for (const Track& track : tracks_)
        if (!track.hasFailed) all.push_back(findBounds(track));
    if (all.empty())
        for (const Track& track : tracks_) all.push_back(findBounds(track));
    std::vector<double> sizes;
    for (const Extent& e : all) sizes.push_back(e.bounds.diagonal());
    std::sort(sizes.begin(), sizes.end());
    const double typical = sizes[(sizes.size() - 1) / 2];
    for (const Extent& e : all)
        if (e.bounds.diagonal() <= 2.5 * typical) {
            bounds_.add(e.bounds);
            seen_.add(e.seen);
        }
    makeRoomForClocks();
    trace_.size = bounds_.diagonal();
    trace_.span = findTrailSpan(trace_, 1.3);
    prepareInset();
}

/// Its size is that of the first scheme's start, so that what leaves the ball is seen to leave it.
void StagePlayer::prepareInset() {
    if (system_.inset.title.empty()) return;
    std::vector<double> x;
    rowState(tracks_.front(), 0, x);
    const double reach = system_.inset.reach(x.data());
    if (!(reach > 0) || !std::isfinite(reach)) return;
    inset_ = StageInset{system_.inset.title, system_.inset.backdrop, reach};
    for (Shape& shape : inset_->backdrop) {
        const auto grow = [reach](Point& p) {
            for (double& c : p) c *= reach;
        };
        if (auto* curve = std::get_if<Curve>(&shape))
            std::for_each(curve->points.begin(), curve->points.end(), grow);
        if (auto* word = std::get_if<Word>(&shape)) grow(word->centre);
        if (auto* segment = std::get_if<Segment>(&shape)) {
            grow(segment->a);
            grow(segment->b);
        }
    }
    insetTrace_.size = 2 * reach;
    insetTrace_.span = findTrailSpan(insetTrace_, 4);
}

void StagePlayer::addTrack(const std::shared_ptr<const SchemeResult>& result) {
    if (!result) return;
    if (system_.field) {
        const FieldFrames* frames = result->products.find<FieldFrames>();
        if (!frames || frames->all.empty()) return;
        Track track;
        track.result = result;
        for (const Frame& frame : frames->all) track.frameTimes.push_back(frame.t);
        track.t = track.frameTimes;
        track.hasFailed = result->summary.status == RunStatus::failed;
        tracks_.push_back(std::move(track));  // the times stay where they are
        return;
    }
    const std::size_t width = stateColumns(system_).size();
    // If there are few steps, along their dense output.
    const DenseOutput* dense = result->products.find<DenseOutput>();
    const Trajectory& from =
        dense && dense->points.columns.size() > width ? dense->points : result->trajectory;
    const auto& columns = from.columns;
    if (columns.size() < 1 + width) return;
    std::size_t rows = from.rows();
    for (std::size_t c = 0; c <= width; ++c) {
        const auto& values = columns[c].values;
        const auto bad = std::find_if(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rows),
                                      [](double v) { return !std::isfinite(v); });
        rows = static_cast<std::size_t>(bad - values.begin());
    }
    if (rows == 0) return;
    Track track;
    track.result = result;
    track.t = std::span(columns[0].values).first(rows);
    for (std::size_t c = 1; c <= width; ++c) track.state.push_back(std::span(columns[c].values).first(rows));
    track.hasFailed = result->summary.status == RunStatus::failed || rows < from.rows();
    tracks_.push_back(std::move(track));
}

void StagePlayer::rowState(const Track& track, std::size_t row, std::vector<double>& x) const {
    if (!track.frameTimes.empty()) {
        x = *track.result->products.find<FieldFrames>()->all[row].values;
        return;
    }
    x.resize(track.state.size());
    for (std::size_t c = 0; c < x.size(); ++c) x[c] = track.state[c][row];
}

Point StagePlayer::tracer(const Track& track, const std::vector<double>& x, bool isInset) const {
    const System& system = systemOf(track);
    if (isInset) return system.inset.tracer(x.data());
    Drawing drawing;
    drawing.isTracerOnly = true;
    system.draw(x.data(), drawing);
    return drawing.tracer;
}

StagePlayer::Extent StagePlayer::findBounds(const Track& track) const {
    // A field over a rectangle takes the same room at all times.
    const std::size_t stride =
        system_.field.y.empty() ? (track.t.size() + maxBoundsRows - 1) / maxBoundsRows : track.t.size();
    std::vector<Point> points;
    std::vector<double> x;
    Drawing drawing;
    for (std::size_t row = 0; row < track.t.size(); row += stride) {
        rowState(track, row, x);
        drawing.clear();
        systemOf(track).draw(x.data(), drawing);
        // What stands still counts once: many equal points would make all that moves seem far away.
        for (const Shape& shape : drawing.shapes)
            if (row == 0 || !isScenery(shape)) addExtent(shape, points);
        points.push_back(drawing.tracer);
    }
    std::erase_if(points, [](const Point& p) { return !isFinite(p); });
    Extent extent;
    extent.bounds = robustBounds(points);
    if (isSpatial()) {
        const Camera corner = cornerView();
        for (Point& p : points) p = corner.project(p);
        extent.seen = robustBounds(points);
    }
    return extent;
}

/// Long enough to see where the motion comes from: the time in which the tracer, at its mean speed,
/// covers `lengths` times the size of the picture; two digits. A motion to and fro on a line has no trail to
/// show: 0.
double StagePlayer::findTrailSpan(const Trace& trace, double lengths) const {
    const auto healthy =
        std::find_if(tracks_.begin(), tracks_.end(), [](const Track& k) { return !k.hasFailed; });
    const Track& track = healthy != tracks_.end() ? *healthy : tracks_.front();
    const std::size_t stride = (track.t.size() + maxBoundsRows - 1) / maxBoundsRows;
    std::vector<Point> path;
    std::vector<double> x;
    double length = 0;
    for (std::size_t row = 0; row < track.t.size(); row += stride) {
        rowState(track, row, x);
        path.push_back(tracer(track, x, trace.isInset));
        if (path.size() > 1) length += distance(path[path.size() - 2], path.back());
    }
    const double time = track.t[(path.size() - 1) * stride] - track.t[0], whole = end() - start();
    if (!(length > 0) || !std::isfinite(length) || (path.size() > 2 && isStraight(path))) return 0;
    const double span = lengths * trace.size * time / length;
    const double digits = std::pow(10, std::floor(std::log10(span)) - 1);
    return std::min(std::round(span / digits) * digits, whole);
}

double StagePlayer::start() const { return tracks_.empty() ? 0 : tracks_.front().t.front(); }

double StagePlayer::end() const {
    double last = start();
    for (const Track& track : tracks_) last = std::max(last, track.t.back());
    return last;
}

/// The cubic Hermite interpolant between row and row + 1. False if the slopes are not to be had.
bool StagePlayer::stateBetween(const Track& track, std::size_t row, double t, std::vector<double>& x) const {
    const std::size_t n = track.state.size();
    const double h = track.t[row + 1] - track.t[row], s = h > 0 ? (t - track.t[row]) / h : 0;
    std::vector<double> x0, x1, v0(n), v1(n);
    rowState(track, row, x0);
    rowState(track, row + 1, x1);
    if (!track.frameTimes.empty()) return false;
    if (!rateOf(systemOf(track), track.t[row], x0.data(), v0.data()) ||
        !rateOf(systemOf(track), track.t[row + 1], x1.data(), v1.data()))
        return false;
    x.resize(n);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = (1 + 2 * s) * (1 - s) * (1 - s) * x0[i] + s * (1 - s) * (1 - s) * h * v0[i] +
               s * s * (3 - 2 * s) * x1[i] + s * s * (s - 1) * h * v1[i];
    return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

/// Whether the curve between row and row + 1 is known: its middle must lie near the chord, within a fifth of
/// its length (a quarter of a circle) or half a percent of the picture. `bend` is that distance.
bool StagePlayer::isResolved(const Track& track, std::size_t row, const Trace& trace, double& bend) const {
    std::vector<double> x;
    bend = 0;
    if (!stateBetween(track, row, (track.t[row] + track.t[row + 1]) / 2, x)) return false;
    const Point middle = tracer(track, x, trace.isInset);
    rowState(track, row, x);
    const Point a = tracer(track, x, trace.isInset);
    rowState(track, row + 1, x);
    const Point b = tracer(track, x, trace.isInset);
    bend = distance(middle, {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
    return bend <= 0.2 * distance(a, b) + 0.005 * trace.size;
}

void StagePlayer::stateAt(const Track& track, double t, std::vector<double>& x) const {
    const auto after = std::upper_bound(track.t.begin(), track.t.end(), t);
    if (after == track.t.begin()) return rowState(track, 0, x);
    const auto row = static_cast<std::size_t>(after - track.t.begin()) - 1;
    if (after == track.t.end() || track.t[row] == t) return rowState(track, row, x);
    double bend = 0;
    if (isResolved(track, row, trace_, bend) && stateBetween(track, row, t, x)) return;
    rowState(track, t - track.t[row] <= track.t[row + 1] - t ? row : row + 1, x);
}

std::vector<TrailPoint> StagePlayer::trail(const Track& track, const Trace& trace, double t,
                                           std::size_t rows) const {
    std::vector<TrailPoint> points;
    const double now = std::min(t, track.t.back());
    if (!(trace.span > 0) || now < track.t.front()) return points;
    const auto index = [&](auto it) { return static_cast<std::size_t>(it - track.t.begin()); };
    const std::size_t first = index(std::lower_bound(track.t.begin(), track.t.end(), now - trace.span));
    const std::size_t last = index(std::upper_bound(track.t.begin(), track.t.end(), now));  // one past
    const std::size_t stride = first < last ? (last - first + rows - 1) / rows : 1;
    const auto add = [&](const std::vector<double>& x, double time, bool isJoined) {
        const Point p = tracer(track, x, trace.isInset);
        if (isFinite(p)) points.push_back({p, (now - time) / trace.span, isJoined && !points.empty()});
    };
    std::vector<double> x;
    const double smooth = 0.0002 * trace.size;
    // From the row, along its interval while it is resolved, to the next.
    const auto follow = [&](std::size_t row, double until) {
        double bend = 0;
        if (row + 1 >= track.t.size() || !isResolved(track, row, trace, bend)) return false;
        const int pieces = std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / smooth))), 1, 12);
        const double h = (track.t[row + 1] - track.t[row]) / pieces;
        for (int k = 1; k <= pieces && track.t[row] + k * h < until; ++k)
            if (k < pieces && stateBetween(track, row, track.t[row] + k * h, x))
                add(x, track.t[row] + k * h, true);
        return true;
    };
    bool isJoined = false;
    for (std::size_t row = first; row < last; row += stride) {
        rowState(track, row, x);
        add(x, track.t[row], isJoined);
        isJoined = stride > 1 || follow(row, now);
    }
    if (isJoined && track.t[last - 1] < now) {
        stateAt(track, now, x);
        add(x, now, true);
    }
    return points;
}

/// Where steps had an event: as far back as the trail, or since the start where there is none.
std::vector<TrailPoint> StagePlayer::marks(const Track& track, const Trace& trace, double t) const {
    constexpr std::size_t most = 200;
    std::vector<TrailPoint> points;
    const double now = std::min(t, track.t.back()), span = trace.span;
    const auto& all = track.result->events.marks;
    std::vector<double> x;
    for (auto mark = all.rbegin(); mark != all.rend() && points.size() < most; ++mark) {
        if (mark->t > now) continue;
        if (span > 0 && now - mark->t > span) break;
        stateAt(track, mark->t, x);
        const Point p = tracer(track, x, false);
        if (isFinite(p)) points.push_back({p, span > 0 ? (now - mark->t) / span : 0, false});
    }
    return points;
}

std::string StagePlayer::eventNote(const Track& track, const std::string& label, double t) const {
    const auto& all = track.result->events.marks;
    const auto count = std::count_if(all.begin(), all.end(), [&](const auto& m) { return m.t <= t; });
    if (count == 0) return {};
    std::string event(name(all.front().event));
    std::replace(event.begin(), event.end(), '-', ' ');
    return label + ": " + event + ", " + std::to_string(count) + (count == 1 ? " step" : " steps");
}

std::string StagePlayer::failureNote(const Track& track, const std::string& label) const {
    const Summary& summary = track.result->summary;
    std::string cause(name(summary.cause));
    std::replace(cause.begin(), cause.end(), '-', ' ');
    const double when = std::isfinite(summary.failedAt) ? summary.failedAt : track.t.back();
    return label + (cause.empty() ? " ended" : ": " + cause) + " at t = " + formatNumber(when, 3) +
           (system_.timeUnit.empty() ? "" : " " + system_.timeUnit);
}

/// The exact solution as a line.
void StagePlayer::addExact(double t, StageFrame& frame) const {
    if (!exact_) return;
    std::vector<double> x(exactWidth_);
    exact_(t, x);
    Drawing drawing;
    system_.draw(x.data(), drawing);
    for (Shape& shape : drawing.shapes)
        if (auto* curtain = std::get_if<Curtain>(&shape))
            frame.scenery.push_back(Curve{std::move(curtain->top), 1.6, 1, ShapeRole::scenery});
}

}  // namespace extremal
