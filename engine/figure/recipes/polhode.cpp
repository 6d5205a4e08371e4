// SPDX-License-Identifier: GPL-3.0-or-later
/// The polhode: the momentum in the body on its sphere, with the curves of constant energy on which a free
/// body moves.
///
/// The sphere |Pi| = |Pi(0)| is seen in parallel projection from a side where the start is in front; what is
/// behind is left out.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/figure/build.hpp"
#include "engine/model/energy_curves.hpp"

namespace extremal::recipes {
namespace {

using Three = std::array<double, 3>;

double dot(const Three& a, const Three& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Three cross(const Three& a, const Three& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Three scaled(const Three& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

/// From where the sphere is seen.
struct Eye {
    Three towards, right, up;

    explicit Eye(const Three& start) {
        towards = {std::copysign(0.62, start[0]), std::copysign(0.48, start[1]),
                   std::copysign(0.62, start[2])};
        towards = scaled(towards, 1 / std::sqrt(dot(towards, towards)));
        const Three third{0, 0, std::copysign(1.0, start[2])};
        up = {third[0] - dot(third, towards) * towards[0], third[1] - dot(third, towards) * towards[1],
              third[2] - dot(third, towards) * towards[2]};
        up = scaled(up, 1 / std::sqrt(dot(up, up)));
        right = cross(up, towards);
    }
    bool sees(const Three& n) const { return dot(n, towards) >= 0; }
};

void add(Guide& guide, const Eye& eye, const Three& n) {
    const bool isSeen = eye.sees(n);
    guide.x.push_back(isSeen ? dot(eye.right, n) : Summary::unknown);
    guide.y.push_back(isSeen ? dot(eye.up, n) : Summary::unknown);
}

void addOutline(Figure& figure) {
    Guide circle;
    for (int k = 0; k <= 180; ++k) {
        circle.x.push_back(std::cos(k * std::numbers::pi / 90));
        circle.y.push_back(std::sin(k * std::numbers::pi / 90));
    }
    circle.isStrong = true;
    figure.add(std::move(circle));
}

void addEnergyCurves(Figure& figure, const Eye& eye, const std::array<double, 6>& inertia) {
    for (const EnergyCurve& curve : energyCurves({inertia[0], inertia[1], inertia[2]}, 160)) {
        Guide guide;
        guide.isStrong = curve.isSeparatrix;
        for (const Three& n : curve.points) add(guide, eye, n);
        figure.add(std::move(guide));
    }
}

void addAxes(Figure& figure, const Eye& eye) {
    const char* names[] = {"Π₁", "Π₂", "Π₃"};
    for (std::size_t i = 0; i < 3; ++i) {
        Three n{};
        n[i] = std::copysign(1.0, eye.towards[i]);
        const std::string sign = n[i] > 0 ? "" : "−";
        // Beyond the end of the mark as it is seen, however much it points at the viewer.
        const double x = dot(eye.right, n), y = dot(eye.up, n),
                     away = 1.06 + 0.09 / std::max(std::hypot(x, y), 1e-3);
        figure.add(Label{away * x, away * y, sign + names[i]});
        Guide axis;
        for (const double s : {1.0, 1.06}) {
            axis.x.push_back(s * dot(eye.right, n));
            axis.y.push_back(s * dot(eye.up, n));
        }
        axis.isStrong = true;
        figure.add(std::move(axis));
    }
}

std::array<std::span<const double>, 3> momenta(const SchemeResult& scheme) {
    const Trajectory& t = scheme.trajectory;
    return {t["momentum.body.1"], t["momentum.body.2"], t["momentum.body.3"]};
}

Figure makePolhode(const FigureContext& context) {
    Figure figure = startFigure(context, "Polhode");
    figure.aspect = Aspect::equal;
    figure.axes = AxisStyle::none;
    figure.x = {"Π / |Π(0)|, seen from a side", false, false, std::pair{-1.25, 1.25}};
    figure.y = {"", false, false, std::pair{-1.2, 1.2}};
    const Body* const body = context.system ? context.system->parts.find<Body>() : nullptr;
    if (!body) {
        figure.message = "Only rigid bodies have a polhode";
        finishFigure(figure, context, "Polhode");
        return figure;
    }
    Three start{};
    bool hasStart = false;
    for (const auto& scheme : context.comparison.schemes)
        if (const auto p = momenta(*scheme); !p[0].empty() && !hasStart) {
            start = {p[0][0], p[1][0], p[2][0]};
            hasStart = true;
        }
    const double size = std::sqrt(dot(start, start));
    if (hasStart && size == 0) figure.message = "The body starts at rest: it has no momentum";
    const Eye eye(start);
    const bool isFree = body->isFree();
    if (size > 0) {
        addOutline(figure);
        if (isFree) addEnergyCurves(figure, eye, body->inertia);
        addAxes(figure, eye);
    }
    for (const auto& scheme : context.comparison.schemes) {
        const auto p = momenta(*scheme);
        const auto t = scheme->trajectory["t"];
        if (p[0].empty() || !(size > 0)) continue;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.kind = SeriesKind::curve;
        s.t.assign(t.begin(), t.end());
        for (std::size_t r = 0; r < t.size(); ++r) {
            const Three n = scaled({p[0][r], p[1][r], p[2][r]}, 1 / size);
            // Off its sphere (a top) nothing hides it.
            const bool isSeen = !isFree || eye.sees(n);
            s.x.push_back(isSeen ? dot(eye.right, n) : Summary::unknown);
            s.y.push_back(isSeen ? dot(eye.up, n) : Summary::unknown);
        }
        figure.add(std::move(s));
    }
    if (isFree) figure.subtitle = "on the momentum sphere, with curves of equal energy";
    finishFigure(figure, context, "Momentum in the body on its sphere");
    for (Series& s : figure.series()) s.hidden = 0;  // what is behind is no loss
    figure.drop<FailureMark>();                      // they stand at times
    return figure;
}

}  // namespace

RecipeEntry polhode() { return {"polhode", makePolhode}; }

}  // namespace extremal::recipes
