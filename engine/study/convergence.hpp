// SPDX-License-Identifier: GPL-3.0-or-later
/// The order of a scheme as it is measured: the slope of log error over log step, over the steps where errors
/// lie on a line.
///
/// The window of the fit is the longest run of neighbouring points that are done, above the floor (ten times
/// the reference's own error, and the round-off of the run) and within a tenth of a decade of their common
/// line; of equally long ones that with the smaller steps. Three points at least, r2 at least 0.98, and
/// errors that fall to a half, so that neither a plateau nor scatter has an order.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "engine/study/sweep.hpp"

namespace extremal {

struct OrderFit {
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    double order = unknown;
    double r2 = unknown;                  ///< coefficient of determination of the line
    double from = unknown, to = unknown;  ///< steps of the window, the larger one first
    double errorAt(double step) const;    ///< of the line
    double logConstant = unknown;         ///< log error = logConstant + order log step
    bool isKnown() const { return order == order; }
};

/// Of one scheme: its rows of a sweep, from the largest step down. Errors at or below `floor`, or the
/// round-off of a state of size `scale`, do not count, nor do those from `most` on, which are as large as the
/// motion.
OrderFit fitOrder(std::span<const SweepRow> rows, double floor, double scale,
                  double most = std::numeric_limits<double>::infinity());

/// Of every scheme of a sweep, in the order of bySchemes().
std::vector<OrderFit> fitOrders(const Sweep& sweep);

}  // namespace extremal
