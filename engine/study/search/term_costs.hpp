// SPDX-License-Identifier: GPL-3.0-or-later
/// What each term of a Lagrangian costs to leave out, by the derivative of the motion by a factor mu = 1 of
/// it:
///
///     first order   max over the nodes of the metric of (x + dx/dmu, x)
///     measured      the metric of (motion without the term, motion)
///
/// of the discrete motion of Galerkin schemes of degree 6, with steps that resolve the fastest motion at the
/// start. A term may be left out for a wish above three times its first order.
#pragma once

#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"
#include "engine/study/search/metric.hpp"

namespace extremal {

struct TermCost {
    static constexpr double safety = 3;
    std::string term;  ///< its name, or its formula
    double firstOrder = 0;
    /// Not a number where the system does not exist without it.
    double measured = std::numeric_limits<double>::quiet_NaN();
};

/// Of systems that say their Lagrangian as a formula, in a metric of errors of coordinates; from the cheapest
/// term up. Empty of others, and where the motion takes more steps than a reader waits for.
std::vector<TermCost> termCosts(const ResolvedScene& scene, const Metric& metric,
                                const std::stop_token& stop);

/// The summands of a formula, each with its sign.
std::vector<std::string> summandsOf(const std::string& formula);

}  // namespace extremal
