// SPDX-License-Identifier: GPL-3.0-or-later
/// The potential behind a motion, of systems whose picture has their coordinates for axes:
///
///     V(q) = H(t, q, 0)
///
/// In two dimensions its level lines, among them that of the energy at the start, which bounds the motion. In
/// one dimension its graph, moved so that the line along which the body moves is the level of that energy:
/// the motion turns where the graph crosses it.
#pragma once

#include <vector>

#include "engine/core/state.hpp"
#include "engine/model/drawing.hpp"
#include "engine/model/system.hpp"
#include "ui/stage/camera.hpp"

namespace extremal {

struct PotentialCurves {
    std::vector<Curve> curves;
    Bounds bounds;  ///< of a graph, which has to be seen whole; empty for level lines, which go on
};

/// `seen`: the motion in the picture. Nothing where the picture has other axes, the system has no potential,
/// or it is constant or changes in time.
PotentialCurves potentialCurves(const System& system, const State& start, double end, const Bounds& seen);

}  // namespace extremal
