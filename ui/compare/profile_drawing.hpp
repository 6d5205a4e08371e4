// SPDX-License-Identifier: GPL-3.0-or-later
/// Initial data of a field, drawn with the mouse on the stage.
///
/// A stroke goes from one point of the stage to another: between them u at the start becomes the height of
/// the line. What comes of it are values at places, {"values": {"x": .., "u": .., "u_t": ..}}, which schemes
/// on any mesh can start from; u_t stays as it was.
#pragma once

#include <optional>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"
#include "ui/workspace/document.hpp"

namespace extremal {

/// How high 1 stands on the stage, of a field over an interval; 0: its picture is no graph.
double heightOfOne(const System& system);

class ProfileDrawing {
public:
    /// None where the scene's model is not a field over an interval.
    static std::optional<ProfileDrawing> of(const Scene& scene);

    /// From and to points of the stage, in the model's coordinates.
    void stroke(const Point& from, const Point& to);
    /// The initial data drawn so far.
    std::vector<Edit> edits() const;
    /// The profile as it stands on the stage.
    std::vector<Point> line() const;

private:
    std::vector<double> x_, u_, v_;
    double unit_ = 1;  ///< how high 1 stands on the stage
    bool isPeriodic_ = false, isHeld_ = false;
};

}  // namespace extremal
