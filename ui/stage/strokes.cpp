// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/strokes.hpp"

#include "engine/figure/image/phase_colour.hpp"
#include "ui/stage/stage_inset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace extremal {
namespace {

constexpr double farAway = 2e4;   // logical pixels: what lies beyond is not drawn
constexpr double rodWidth = 2.4;  // of the first scheme; the others are a little thinner
constexpr double hatchSpacing = 8, hatchLength = 8;
constexpr double veiled = 0.3;  // strength of what is behind the middle of an inset
constexpr double springLead = 10, slimmestSpring = 5, widestSpring = 11;

/// Collects strokes of one picture; batches are opened and closed around them.
class Pen {
public:
    Pen(const Camera& camera, double pixelRatio)
        : camera_(camera), axes_(camera.axes()), ratio_(pixelRatio) {}

    void open(bool isUnited, double opacity) {
        StrokeBatch batch;
        batch.first = list_.strokes.size();
        batch.fillFirst = list_.fills.size();
        batch.isUnited = isUnited;
        batch.opacity = static_cast<float>(opacity);
        list_.batches.push_back(batch);
    }

    /// From here on what is behind this point is drawn faintly.
    void veilBehind(const Point& middle) { veil_ = seen(middle)[2]; }

    void stroke(const Point& a, const Point& b, double width, const Rgb& colour, double alphaA = 1,
                double alphaB = 1) {
        const Point pa = seen(a), pb = seen(b);
        for (std::size_t i = 0; i < 2; ++i)  // negated: also true for NaN
            if (!(std::abs(pa[i]) < farAway) || !(std::abs(pb[i]) < farAway)) return;
        if ((pa[2] + pb[2]) / 2 < veil_) {
            alphaA *= veiled;
            alphaB *= veiled;
        }
        Stroke s{};
        for (std::size_t i = 0; i < 3; ++i) {
            s.a[i] = static_cast<float>(a[i] - camera_.centre[i]);
            s.b[i] = static_cast<float>(b[i] - camera_.centre[i]);
        }
        s.halfWidth = static_cast<float>(width / 2 * ratio_);
        s.colour[0] = colour.r;
        s.colour[1] = colour.g;
        s.colour[2] = colour.b;
        s.alphaA = static_cast<float>(alphaA);
        s.alphaB = static_cast<float>(alphaB);
        list_.strokes.push_back(s);
        grow(pa, width);
        grow(pb, width);
    }

    /// A convex polygon.
    void fill(const std::vector<Point>& corners, const Rgb& colour, double alpha) {
        if (!isNear(corners)) return;
        for (std::size_t k = 2; k < corners.size(); ++k)
            for (const std::size_t c : {std::size_t(0), k - 1, k}) corner(corners[c], colour, alpha);
    }

    /// A quadrangle with a colour at each corner, mixed between them.
    struct Tinted {
        Rgb colour;
        double alpha;
    };
    void blend(const std::vector<Point>& corners, const std::array<Tinted, 4>& tints) {
        if (!isNear(corners)) return;
        for (const std::size_t c : {0, 1, 2, 0, 2, 3}) corner(corners[c], tints[c].colour, tints[c].alpha);
    }

    void disc(const Point& centre, double radius, const Rgb& colour) {
        stroke(centre, centre, 2 * radius, colour);
    }

    /// The point this many logical pixels right of and above r, as seen.
    Point shifted(const Point& r, double right, double up) const {
        Point p = r;
        for (std::size_t i = 0; i < 3; ++i)
            p[i] += (axes_[0][i] * right + axes_[1][i] * up) / camera_.pixelsPerUnit;
        return p;
    }
    const Camera& camera() const { return camera_; }
    /// Pixels from the middle: Camera::project() without the sines and cosines, for thousands of points.
    Point seen(const Point& r) const { return camera_.project(r, axes_); }

    StrokeList take() {
        std::erase_if(list_.batches, [](const StrokeBatch& b) { return b.count == 0 && b.fillCount == 0; });
        return std::move(list_);
    }

private:
    bool isNear(const std::vector<Point>& corners) const {
        return std::all_of(corners.begin(), corners.end(), [&](const Point& p) {
            const Point at = seen(p);
            return std::abs(at[0]) < farAway && std::abs(at[1]) < farAway;  // false for NaN
        });
    }
    void corner(const Point& p, const Rgb& colour, double alpha) {
        FillCorner f{};
        for (std::size_t i = 0; i < 3; ++i) f.r[i] = static_cast<float>(p[i] - camera_.centre[i]);
        f.colour[0] = colour.r;
        f.colour[1] = colour.g;
        f.colour[2] = colour.b;
        f.alpha = static_cast<float>(alpha);
        list_.fills.push_back(f);
        grow(seen(p), 0);
    }
    void grow(const Point& p, double width) {
        StrokeBatch& batch = list_.batches.back();
        const double reach = (width / 2 + 2) * ratio_;
        for (std::size_t i = 0; i < 2; ++i) {
            const auto low = static_cast<float>(p[i] * ratio_ - reach);
            const auto high = static_cast<float>(p[i] * ratio_ + reach);
            const bool isFirst = batch.count == 0 && batch.fillCount == 0;
            batch.low[i] = isFirst ? low : std::min(batch.low[i], low);
            batch.high[i] = isFirst ? high : std::max(batch.high[i], high);
        }
        batch.count = list_.strokes.size() - batch.first;
        batch.fillCount = list_.fills.size() - batch.fillFirst;
    }

    Camera camera_;
    std::array<Point, 3> axes_;
    double ratio_;
    double veil_ = -std::numeric_limits<double>::infinity();
    StrokeList list_;
};

Point between(const Point& a, const Point& b, double s) {
    return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1]), a[2] + s * (b[2] - a[2])};
}

void drawSpring(Pen& pen, const Spring& spring, double width, const Rgb& colour) {
    const Point pa = pen.seen(spring.a), pb = pen.seen(spring.b);
    const double dx = pb[0] - pa[0], dy = pb[1] - pa[1], length = std::hypot(dx, dy);
    if (!(length > 1e-6) || !(length < farAway)) return;
    const double lead = std::min(springLead, length / 6);
    const int halves = 2 * std::max(spring.coils, 1);
    const double amplitude = std::min(std::clamp(length / halves, slimmestSpring, widestSpring), length / 8);
    Point previous = between(spring.a, spring.b, lead / length);
    pen.stroke(spring.a, previous, width, colour);
    for (int k = 0; k <= halves; ++k) {
        // Peaks lie in the middle of each half coil; the last point is the foot of the far lead.
        const double s = k < halves ? (k + 0.5) / halves : 1.0;
        const double side = k == halves ? 0 : (k % 2 == 0 ? amplitude : -amplitude);
        const Point foot = between(spring.a, spring.b, (lead + s * (length - 2 * lead)) / length);
        const Point next = pen.shifted(foot, -dy / length * side, dx / length * side);
        pen.stroke(previous, next, width, colour);
        previous = next;
    }
    pen.stroke(previous, spring.b, width, colour);
}

void drawSupport(Pen& pen, const Support& support, const Rgb& colour) {
    const Point left = {support.centre[0] - support.width / 2, support.centre[1], support.centre[2]};
    const Point right = {support.centre[0] + support.width / 2, support.centre[1], support.centre[2]};
    pen.stroke(left, right, 1.8, colour);
    const Point pl = pen.seen(left), pr = pen.seen(right);
    const double length = std::hypot(pr[0] - pl[0], pr[1] - pl[1]);
    if (!(length < farAway)) return;
    const int strokes = std::max(2, static_cast<int>(length / hatchSpacing));
    for (int k = 0; k < strokes; ++k) {
        const Point foot = between(left, right, k / static_cast<double>(strokes));
        pen.stroke(foot, pen.shifted(foot, hatchLength, hatchLength), 1.2, colour);
    }
}

void drawCurve(Pen& pen, const Curve& curve, const Rgb& colour) {
    for (std::size_t k = 1; k < curve.points.size(); ++k)
        pen.stroke(curve.points[k - 1], curve.points[k], curve.width, colour, curve.strength, curve.strength);
}

/// The colour of a point as its hue, or as the grey of the scenery, and how much of it there is as its
/// opacity.
void drawRaster(Pen& pen, const Raster& raster, const Rgb& grey, double strength) {
    const auto columns = static_cast<std::size_t>(raster.columns),
               rows = static_cast<std::size_t>(raster.rows);
    const auto tint = [&](std::size_t k) -> Pen::Tinted {
        Rgb colour = grey;
        if (!raster.hues.empty()) {
            const auto c = phaseColour(raster.hues[k]);
            colour = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
        }
        return {colour, strength * std::clamp(raster.strengths[k], 0.0, 1.0)};
    };
    const auto place = [&](std::size_t i, std::size_t j) -> Point {
        return {raster.corner[0] + raster.width * static_cast<double>(i) / static_cast<double>(columns - 1),
                raster.corner[1] + raster.height * static_cast<double>(j) / static_cast<double>(rows - 1),
                raster.corner[2]};
    };
    for (std::size_t j = 0; j + 1 < rows; ++j)
        for (std::size_t i = 0; i + 1 < columns; ++i) {
            const std::size_t k = i + j * columns;
            constexpr double unseen = 1.0 / 512;
            if (std::max({raster.strengths[k], raster.strengths[k + 1], raster.strengths[k + columns],
                          raster.strengths[k + columns + 1]}) < unseen)
                continue;
            pen.blend({place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)},
                      {tint(k), tint(k + 1), tint(k + columns + 1), tint(k + columns)});
        }
}

void drawScenery(Pen& pen, const StageFrame& frame) {
    pen.open(false, 1);
    for (const Shape& shape : frame.scenery)
        if (const auto* raster = std::get_if<Raster>(&shape))
            drawRaster(pen, *raster, frame.style.scenery, 1);
    pen.open(true, 1);
    for (const Shape& shape : frame.scenery) {
        if (const auto* curve = std::get_if<Curve>(&shape)) drawCurve(pen, *curve, frame.style.scenery);
        if (const auto* support = std::get_if<Support>(&shape))
            drawSupport(pen, *support, frame.style.scenery);
        if (const auto* segment = std::get_if<Segment>(&shape))
            pen.stroke(segment->a, segment->b, segment->width, frame.style.scenery);
        if (const auto* spring = std::get_if<Spring>(&shape))
            drawSpring(pen, *spring, 1.6, frame.style.scenery);
        if (const auto* disc = std::get_if<Disc>(&shape))
            pen.disc(disc->centre, disc->radius, frame.style.scenery);
    }
}

/// Lines at 1, 2 or 5 times a power of ten, about 90 pixels apart, in the plane of the picture's centre.
void drawGrid(Pen& pen, const StageFrame& frame, double width, double height) {
    const double wanted = 90 / pen.camera().pixelsPerUnit;
    if (!(wanted > 1e-300) || !(wanted < 1e300)) return;
    const double decade = std::pow(10, std::floor(std::log10(wanted)));
    const double ratio = wanted / decade;
    const double step = decade * (ratio < 2 ? 1 : ratio < 5 ? 2 : 5);
    pen.open(true, 1);
    const Point& centre = pen.camera().centre;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double half = (axis == 0 ? width : height) / 2 / pen.camera().pixelsPerUnit;
        const double first = std::ceil((centre[axis] - half) / step) * step;
        for (int k = 0; first + k * step <= centre[axis] + half && k < 1000; ++k) {
            const double offset = (first + k * step - centre[axis]) * pen.camera().pixelsPerUnit;
            const Point a = axis == 0 ? pen.shifted(centre, offset, -height / 2)
                                      : pen.shifted(centre, -width / 2, offset);
            const Point b =
                axis == 0 ? pen.shifted(centre, offset, height / 2) : pen.shifted(centre, width / 2, offset);
            pen.stroke(a, b, 1, frame.style.grid);
        }
    }
}

double fade(double age) { return std::pow(std::clamp(1 - age, 0.0, 1.0), 1.4); }

void drawTrail(Pen& pen, const StageLayer& layer, double width) {
    for (std::size_t i = 0; i < layer.trail.size(); ++i) {
        const TrailPoint& p = layer.trail[i];
        const bool startsPiece = i == 0 || !p.isJoined;
        const bool endsPiece = i + 1 == layer.trail.size() || !layer.trail[i + 1].isJoined;
        if (!startsPiece)
            pen.stroke(layer.trail[i - 1].r, p.r, width, layer.colour, fade(layer.trail[i - 1].age),
                       fade(p.age));
        else if (endsPiece)
            pen.stroke(p.r, p.r, 2.2 * width, layer.colour, fade(p.age), fade(p.age));
    }
}

/// A ring where a step had an event.
void drawMarks(Pen& pen, const StageLayer& layer, const Rgb& ground) {
    constexpr double outer = 4.2, inner = 2.6;
    for (const TrailPoint& p : layer.marks) {
        if (!(p.age < 1)) continue;
        pen.disc(p.r, outer, layer.colour);
        pen.disc(p.r, inner, ground);
    }
}

/// Schemes that agree lie on top of each other. Their discs get smaller from the first to the last and are
/// drawn in this order, so that coinciding schemes show as rings.
double ringScale(std::size_t index, std::size_t count) {
    return count <= 1 ? 1
                      : 1 - 0.55 * static_cast<double>(index) /
                                static_cast<double>(std::max<std::size_t>(count - 1, 2));
}

void drawBodies(Pen& pen, const StageLayer& layer, bool isFirst) {
    const double width = isFirst ? rodWidth : 0.75 * rodWidth;
    for (const Shape& shape : layer.shapes) {
        if (const auto* segment = std::get_if<Segment>(&shape))
            pen.stroke(segment->a, segment->b, segment->width / 2 * width, layer.colour);
        if (const auto* spring = std::get_if<Spring>(&shape))
            drawSpring(pen, *spring, 0.8 * width, layer.colour);
        if (const auto* curve = std::get_if<Curve>(&shape)) drawCurve(pen, *curve, layer.colour);
    }
}

/// Faces towards the viewer are tinted by how they stand to the light, their edges drawn; hidden edges shine
/// through. Of several schemes only the first is tinted: where they differ, their edges tell.
void drawSolid(Pen& pen, const Solid& solid, const Rgb& colour, double strength, double width,
               bool isFilled) {
    const auto axes = pen.camera().axes();
    constexpr Point light = {-0.36, 0.72, 0.6};  // right, up, towards
    struct Sides {
        bool isFront = false, isBack = false;
    };
    std::map<std::pair<int, int>, Sides> edges;  // what the faces on both sides are
    for (const std::vector<int>& face : solid.faces) {
        std::vector<Point> corners;
        for (const int c : face) corners.push_back(solid.corners[static_cast<std::size_t>(c)]);
        Point normal{};  // Newell's
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
            for (std::size_t k = 0; k < 3; ++k)
                normal[k] += (a[(k + 1) % 3] - b[(k + 1) % 3]) * (a[(k + 2) % 3] + b[(k + 2) % 3]);
        }
        const double length = std::sqrt(dot(normal, normal));
        if (!(length > 0)) continue;
        const Point seen = {dot(axes[0], normal) / length, dot(axes[1], normal) / length,
                            dot(axes[2], normal) / length};
        const bool isFront = seen[2] > 0;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const int a = face[i], b = face[(i + 1) % face.size()];
            Sides& sides = edges[{std::min(a, b), std::max(a, b)}];
            (isFront ? sides.isFront : sides.isBack) = true;
        }
        if (isFront && isFilled)
            pen.fill(corners, colour, strength * (0.14 + 0.34 * std::max(0.0, dot(light, seen))));
    }
    for (const bool wantsSeen : {false, true})
        for (const auto& [edge, sides] : edges) {
            const bool isSeen = sides.isFront, isOutline = sides.isFront && sides.isBack;
            if (isSeen != wantsSeen || (solid.isSmooth && !isOutline)) continue;
            const double alpha = strength * (isSeen ? 1 : 0.22);
            pen.stroke(solid.corners[static_cast<std::size_t>(edge.first)],
                       solid.corners[static_cast<std::size_t>(edge.second)], isSeen ? width : 0.7 * width,
                       colour, alpha, alpha);
        }
}

/// The area in the colours of the curve, of the first scheme alone; the curve in the colour of its scheme.
void drawCurtain(Pen& pen, const Curtain& curtain, const Rgb& colour, double strength, double width,
                 bool isFilled) {
    const std::size_t n = curtain.top.size(), every = std::max<std::size_t>(1, n / 800);
    for (std::size_t j = 0; isFilled && j + every < n; j += every) {
        const Point &a = curtain.top[j], &b = curtain.top[j + every];
        Rgb tint = colour;
        if (!curtain.hues.empty()) {
            const auto c = phaseColour(curtain.hues[j]);
            tint = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2])};
        }
        pen.fill({{a[0], curtain.ground, a[2]}, {b[0], curtain.ground, b[2]}, b, a}, tint, 0.75 * strength);
    }
    for (std::size_t j = 0; j + every < n; j += every)
        pen.stroke(curtain.top[j], curtain.top[j + every], width, colour, strength, strength);
}

void drawDiscs(Pen& pen, const StageFrame& frame, const StageLayer& layer, double scale, bool isFirst) {
    // A faint scheme is mixed with the background, so that its outline does not shine through.
    const double strength = layer.hasEnded ? 0.35 : 1;
    const auto mix = [&](float c, float back) {
        return static_cast<float>(strength * c + (1 - strength) * back);
    };
    const Rgb& back = frame.style.background;
    const Rgb colour = {mix(layer.colour.r, back.r), mix(layer.colour.g, back.g),
                        mix(layer.colour.b, back.b)};
    pen.open(false, 1);
    for (const Shape& shape : layer.shapes)
        if (const auto* disc = std::get_if<Disc>(&shape)) {
            const double radius = 1.15 * disc->radius * scale;
            pen.disc(disc->centre, radius + (isFirst ? 1.6 : 0.6), back);
            pen.disc(disc->centre, radius, colour);
        }
}

void drawLayers(Pen& pen, const StageFrame& frame) {
    const std::size_t count = frame.layers.size();
    // Rods, springs and trails of the first scheme lie above those of the others, which show where they
    // differ.
    for (std::size_t i = count; i-- > 0;) {
        const StageLayer& layer = frame.layers[i];
        pen.open(true, layer.hasEnded ? 0.25 : i == 0 ? 1 : 0.85);
        drawTrail(pen, layer, i == 0 ? 2.2 : 1.6);
    }
    for (std::size_t i = count; i-- > 0;) {
        if (frame.layers[i].marks.empty()) continue;
        pen.open(false, 1);
        drawMarks(pen, frame.layers[i], frame.style.background);
    }
    for (std::size_t i = count; i-- > 0;) {
        const StageLayer& layer = frame.layers[i];
        pen.open(false, 1);
        for (const Shape& shape : layer.shapes)
            if (const auto* solid = std::get_if<Solid>(&shape))
                drawSolid(pen, *solid, layer.colour, layer.hasEnded ? 0.3 : 1, i == 0 ? 1.8 : 1.4, i == 0);
        // A picture hides what is behind it: that of the first scheme alone is shown.
        for (const Shape& shape : layer.shapes)
            if (const auto* raster = std::get_if<Raster>(&shape); raster && i == 0)
                drawRaster(pen, *raster, layer.colour, layer.hasEnded ? 0.3 : 1);
        for (const Shape& shape : layer.shapes)
            if (const auto* curtain = std::get_if<Curtain>(&shape))
                drawCurtain(pen, *curtain, layer.colour, layer.hasEnded ? 0.3 : 1, i == 0 ? 2 : 1.4, i == 0);
        pen.open(true, layer.hasEnded ? 0.3 : 1);
        drawBodies(pen, layer, i == 0);
    }
    for (const bool hasEnded : {true, false})  // those that have failed lie below the others
        for (std::size_t i = 0; i < count; ++i)
            if (frame.layers[i].hasEnded == hasEnded)
                drawDiscs(pen, frame, frame.layers[i], ringScale(i, count), i == 0);
}

/// A ball of the background's colour with its outline, and the picture of the inset on it.
void drawInset(Pen& pen, const StageFrame& frame, double width, double height) {
    const InsetPlace place(frame, pen.camera(), width, height);
    StageFrame small;
    small.style = frame.style;
    for (const Shape& shape : frame.inset->backdrop) small.scenery.push_back(place.map(shape));
    for (const StageLayer& layer : frame.layers) {
        StageLayer part;
        part.colour = layer.colour;
        part.hasEnded = layer.hasEnded;
        part.trail = place.map(layer.insetTrail);
        part.shapes.push_back(Disc{place.map(layer.insetTracer), 3.6});
        small.layers.push_back(std::move(part));
    }
    const double pixels = InsetPlace::pixels(width, height);
    std::vector<Point> outline;
    for (int k = 0; k < 96; ++k) {
        const double phi = 2 * std::numbers::pi * k / 96;
        outline.push_back(pen.shifted(place.centre(), pixels * std::cos(phi), pixels * std::sin(phi)));
    }
    pen.open(false, 1);
    pen.fill(outline, frame.style.background, 0.85);
    pen.open(true, 1);
    for (std::size_t k = 0; k < outline.size(); ++k)
        pen.stroke(outline[k], outline[(k + 1) % outline.size()], 1, frame.style.scenery);
    pen.veilBehind(place.centre());
    drawScenery(pen, small);
    drawLayers(pen, small);
}

}  // namespace

StrokeList makeStrokes(const StageFrame& frame, const Camera& camera, double width, double height,
                       double pixelRatio) {
    Pen pen(camera, pixelRatio);
    if (frame.style.hasGrid) drawGrid(pen, frame, width, height);
    drawScenery(pen, frame);
    drawLayers(pen, frame);
    if (frame.inset) drawInset(pen, frame, width, height);
    return pen.take();
}

}  // namespace extremal
