// SPDX-License-Identifier: GPL-3.0-or-later
/// A StageFrame turned into what the renderer draws: round-ended strokes in batches.
///
/// Nearly everything on the stage is a stroke: a rod, a piece of a spring or trail, a hatch line, and a disc,
/// which is a stroke of length zero. Faces of solids are filled triangles. Widths are in pixels of the
/// picture, ends in model units relative to the camera's centre (subtracted in double precision, so that
/// zooming far in stays exact).
#pragma once

#include <vector>

#include "ui/stage/camera.hpp"
#include "ui/stage/stage_frame.hpp"

namespace extremal {

/// The vertex layout of the renderer: plain floats in this order.
struct Stroke {
    float a[3];
    float b[3];
    float halfWidth;
    float colour[3];
    float alphaA, alphaB;
};

/// A corner of a filled triangle, three in a row; the layout of the renderer.
struct FillCorner {
    float r[3];
    float colour[3];
    float alpha;
};

struct StrokeBatch {
    std::size_t first = 0, count = 0;          ///< strokes, drawn after the fills
    std::size_t fillFirst = 0, fillCount = 0;  ///< corners of triangles
    /// True: the strokes are of one colour and are united before they meet the picture, so that overlapping
    /// half-transparent pieces do not show their joints. False: each is drawn over what is there.
    bool isUnited = false;
    float opacity = 1;                        ///< of the whole batch
    float low[2] = {0, 0}, high[2] = {0, 0};  ///< pixels it may touch, from the middle, y up
};

struct StrokeList {
    std::vector<Stroke> strokes;
    std::vector<FillCorner> fills;
    std::vector<StrokeBatch> batches;  ///< from the back to the front
};

/// `width` and `height` are the picture's logical size; `pixelRatio` device pixels per logical pixel.
StrokeList makeStrokes(const StageFrame& frame, const Camera& camera, double width, double height,
                       double pixelRatio);

}  // namespace extremal
