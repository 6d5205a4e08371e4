// SPDX-License-Identifier: GPL-3.0-or-later
/// What became of the starts of a view: motions of one scheme from many places in the plane of the view.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/trajectory/trajectory.hpp"
#include "engine/view/plane.hpp"

namespace extremal {

/// The motion from one start.
struct Orbit {
    double x = 0, y = 0;        ///< the start, in the plane
    std::vector<double> start;  ///< the state there; empty: the energy admits none
    std::string problem;        ///< why there is none
    bool isDone = false;
    Outcome outcome = Outcome::converged;
    /// Of the motion up to its end; NaN where the scheme has no tangent map.
    double lyapunov = std::numeric_limits<double>::quiet_NaN(), megno = lyapunov;
    long long steps = 0;
    /// t and the state: of a section the start and where it is passed upwards, else the first part of the
    /// motion. At most `mostPoints`.
    Trajectory points;
    bool isCut = false;  ///< there would be more points
};

struct StartSet {
    std::size_t view = 0;  ///< index in Scene::views
    std::string scheme;    ///< its label
    int style = 0;
    ViewPlane plane;
    std::vector<std::shared_ptr<const Orbit>> orbits;  ///< null: not computed yet
};

/// Of a comparison: one per view with starts.
struct StartSets {
    std::vector<StartSet> all;
};

}  // namespace extremal
