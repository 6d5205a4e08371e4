/// The angular momentum of a rigid body by components, in body or space axes: one plot each against time.
#pragma once

#include "engine/figure/view.hpp"

namespace extremal {

/// A view of the state columns momentum.<frame>.<component>; `frame` is "body" or "space".
std::vector<std::string> momentumColumns(const System& system, const std::string& frame);

/// The component that view.y names; without one the first, and without a rigid body a message in its place.
Figure momentumComponent(const FigureContext& context, const std::string& frame);

}  // namespace extremal
