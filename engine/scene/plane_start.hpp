// SPDX-License-Identifier: GPL-3.0-or-later
/// States that start at a place in the plane of a view, besides the start of the scene.
///
/// Two columns are given by the place, and the others are those of the start of the scene. In a section
/// q_i = 0 the momentum of q_i follows from the energy E of that start:
///
///     H(t_0, q, p) = E,   q_i' = dH/dp_i > 0,
///
/// above the minimum of H along p_i, so that the motion passes upwards. Lagrangians that are not quadratic in
/// the velocities are solved as well, by bracketing.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/view/plane.hpp"

namespace extremal {

/// Why no start can be placed in a plane of this system, as the end of a sentence; empty: it can.
std::string startProblem(const System& system, const ViewPlane& plane);

struct PlaneStart {
    std::vector<double> x;  ///< (q, p); empty with a problem
    std::string problem;    ///< "no p.x gives the energy 0.125 of the start: it is at least 0.3 here"
};

struct PlaneBox {
    double left, right, bottom, top;
};

class StartPlane {
public:
    /// startProblem() must be empty; the system must outlive it.
    StartPlane(const System& system, State initial, const ViewPlane& plane);

    PlaneStart at(double x, double y) const;
    /// The place of a state in the plane.
    std::pair<double, double> placeOf(const std::vector<double>& state) const {
        return {state[x_], state[y_]};
    }
    /// `count` places spread evenly (by the additive recurrence of the plastic number, Roberts 2018) over a
    /// rectangle; of a section over the part of it that the energy admits, and without a rectangle over the
    /// region around the start of the scene. Fewer, or none, where there is no such room.
    std::vector<std::pair<double, double>> spread(int count, const PlaneBox* box) const;

private:
    struct Region;
    bool admits(double x, double y) const;
    std::vector<double> stateAt(double x, double y) const;
    /// H along the momentum of the section's column, which is changed in `state`.
    double energyWith(std::vector<double>& state, double p) const;

    State initial_;
    EnergyFunction energy_;
    std::size_t x_, y_, at_ = 0, momentum_ = 0;
    bool isSection_;
    double E_ = 0, scale_ = 0;  ///< energy of the start; the size of its momenta
    std::string momentumName_;
};

/// All starts of a view: those it names, then those it spreads, over its range where it has one of both axes.
std::vector<std::pair<double, double>> startsOf(const StartPlane& plane, const View& view);

}  // namespace extremal
