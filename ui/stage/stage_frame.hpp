// SPDX-License-Identifier: GPL-3.0-or-later
/// One picture of the stage as data: what to draw at a time t, in model coordinates, with colours.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/model/drawing.hpp"
#include "ui/stage/camera.hpp"

namespace extremal {

struct Rgb {
    float r = 0, g = 0, b = 0;  ///< 0..1, as on screen
    bool operator==(const Rgb&) const = default;
};
/// From 0xRRGGBB.
constexpr Rgb rgb(unsigned hex) {
    return {static_cast<float>((hex >> 16) & 255u) / 255.f, static_cast<float>((hex >> 8) & 255u) / 255.f,
            static_cast<float>(hex & 255u) / 255.f};
}

/// The colours of the stage, made from the theme.
struct StageStyle {
    Rgb background, scenery, grid;
    std::vector<Rgb> series;  ///< by SchemeResult::style, repeating
    bool hasGrid = false;
    bool operator==(const StageStyle&) const = default;
};

/// A point of a trail. A point that is not joined starts a new piece; a piece of one point is drawn as a dot:
/// that is how rows too far apart for a curve are shown.
struct TrailPoint {
    Point r;
    double age = 0;  ///< 0 now .. 1 about to vanish
    bool isJoined = true;
};

/// One scheme.
struct StageLayer {
    std::string label;
    Rgb colour;
    std::vector<Shape> shapes;      ///< of role body
    std::vector<TrailPoint> trail;  ///< oldest first
    std::vector<TrailPoint> marks;  ///< where steps had an event, as far back as the trail
    Point insetTracer{};            ///< its point in the inset, if there is one
    std::vector<TrailPoint> insetTrail;
    bool hasEnded = false;  ///< the scheme failed before t: its last state, drawn faintly
};

/// The small picture in the corner (Inset of the system).
struct StageInset {
    std::string title;
    std::vector<Shape> backdrop;  ///< in units of the tracers, as all of it
    double reach = 1;             ///< radius of the ball
};

struct StageFrame {
    double t = 0;
    StageStyle style;
    Bounds bounds;  ///< over the whole run, so that the picture does not jump
    std::vector<Shape> scenery;
    double trailSpan = 0;            ///< time that the trails go back
    std::vector<StageLayer> layers;  ///< in the order of the scene
    std::optional<StageInset> inset;
    /// Failures before t, "Stormer-Verlet diverged at t = 0.31", and events, "SEM 2: energy unsolvable, 3
    /// steps".
    std::vector<std::string> notes;
};

}  // namespace extremal
