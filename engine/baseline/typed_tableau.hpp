// SPDX-License-Identifier: GPL-3.0-or-later
/// Runge-Kutta tables and splittings as a user types them: the keys of the baselines "runge-kutta" and
/// "splitting".
///
/// Entries are numbers, or expressions without names such as "1/6" and "(3-sqrt(3))/6", read in quadruple
/// precision. What a table promises follows from its coefficients alone: the order from trees, symmetry and
/// symplecticity from the defects, the stability limit from its map on the oscillator (tableau/tableau.hpp).
/// Errors: InvalidScene with pointers below /baseline.
#pragma once

#include <memory>
#include <vector>

#include "engine/tableau/splitting_table.hpp"
#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/family/findings.hpp"
#include "engine/tableau/order_conditions.hpp"

namespace extremal {

/// A table with what it promises. What was read last is remembered, as trees of order 8 take milliseconds.
struct TypedTableau {
    std::shared_ptr<const Tableau> tableau;
    /// Of its trees up to order 8, of partitioned tables 6; of a splitting those for quadratic kinetic
    /// energy.
    std::vector<OrderCondition> conditions;
    /// The order is at most that of the trees, or by the simplifying assumptions of a plain method.
    Claims claims;
    /// Largest z at and below which no eigenvalue of the step on q' = z p, p' = -z q is outside the unit
    /// circle; 0: some are for every step.
    double stabilityLimit = 0;
    Splitting splitting;  ///< of kicks and drifts; of other tables without stages
};

/// Keys a, b, c, and for p a_hat, b_hat; rows of a may end with their last entry that is not 0.
std::shared_ptr<const TypedTableau> typedRungeKutta(const Settings& settings);
/// Keys kicks, drifts and first.
std::shared_ptr<const TypedTableau> typedSplitting(const Settings& settings);

/// Warnings: coefficients with few digits, nodes that are not the sums of their rows. Errors: as thrown, and
/// order 0.
void examine(const Settings& settings, bool isSplitting, Findings& findings);

}  // namespace extremal
