// SPDX-License-Identifier: GPL-3.0-or-later
/// What a table of a space and a plain rule promises: order, symmetry, stability on the harmonic oscillator,
/// and why the combination is unsupported. What every family of polynomials on a step shares.
#pragma once

#include <functional>
#include <string>

#include "engine/action/table.hpp"
#include "engine/family/discretization.hpp"
#include "engine/integrator/oscillator_step.hpp"

namespace extremal {

/// `table` makes it, and throws InvalidScene where it cannot. The order is measured for every discretization
/// of the handbook's table of orders.
/// `limit`: the first unstable h w of the table; empty: by its entries in double precision.
Properties describeTable(const std::function<Table<double>()>& table,
                         const std::function<double()>& limit = {});

/// The order on smooth motions:
///     min( 2 degree, degree of the rule + 1, 2 consistency ),
/// the error of the discrete action over h^(2 degree + 1) from the space, h^(order of the rule + 1) from the
/// rule on the solution, and h^(2 consistency + 1) from the rule in the equations inside the step, where it
/// counts twice.
struct OrderBounds {
    int ofSpace = 0, ofRule = 0, ofEquations = 0;
    int order() const;
    /// "order 2, not the 8 of the space: the rule is exact to degree 1"; empty where the space decides.
    std::string shortfall() const;
};
OrderBounds orderBounds(const Table<double>& table);

/// Half the trace of the map of a step of length 1 on the harmonic oscillator with frequency z: beyond +-1 it
/// is unstable.
double halfTrace(const Table<double>& table, double z);

/// What the table makes of the action of a step on the harmonic oscillator: the source of everything that is
/// said of its linear stability.
OscillatorAction oscillatorAction(const Table<double>& table);
/// The first z at which the step is unstable, by a scan of half the trace in double precision, which may miss
/// intervals narrower than 0.004: for tables of many functions, whose edges would take seconds.
double scannedStabilityLimit(const Table<double>& table);

/// What is doubtful in a rule or what it makes of the kinetic energy ("has a negative weight ..."); may be
/// empty.
std::string cautionOf(const Table<double>& table);

}  // namespace extremal
