/// What a table of a space and a plain rule promises: order, symmetry, stability on the harmonic oscillator,
/// and why the combination is unsupported. What every family of polynomials on a step shares.
#pragma once

#include <functional>

#include "engine/action/table.hpp"
#include "engine/family/discretization.hpp"

namespace extremal {

/// `table` makes it, and throws InvalidScene where it cannot. The order is min(2 degree, order of the rule,
/// 2 consistency), consistency as in action/table.hpp. It is measured for every discretization of the
/// handbook's table of orders.
Properties describeTable(const std::function<Table<double>()>& table, const Settings& quadrature);

}  // namespace extremal
