// SPDX-License-Identifier: GPL-3.0-or-later
/// Knots of the piecewise linear profile with the least energy: given, or stationary as well as the values
/// (Leok 2004, sec. 6: "horizontal" variations).
///
///     equal       elements of one length
///     arclength   elements with the same length of the graph, int sqrt(1 + u_x^2) dx
///     density     elements with the same share of |u_xx|^p and a floor of 2 % of its mean: p = 2/3 for an
///                 energy with u_x^2, 2/5 for an approximation in L2, where stationarity in the knots would
///                 have them for small elements
///     free        dE/du_i = 0 and dE/dx_i = 0
/// Free knots start from the density, several times, as there are many minima: the least one found. Newton's
/// method with the damping of Levenberg and Marquardt, on banded
/// matrices. The energy has directions with next to no curvature (5e-7 of 63 knots on a kink), where knots
/// move along the profile. Knots that approach each other stop at the least distance: where W jumps the best
/// profile has a jump of its own, which no element has.
#pragma once

#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/model/static_problem.hpp"

namespace extremal {

enum class Knots { equal, arclength, density, free };

/// Distance of knots that meet, over the length of the domain.
inline constexpr double leastKnotDistance = 1e-6;

struct KnotProfile {
    std::vector<double> x, u;    ///< knots
    std::vector<double> energy;  ///< of the elements
    std::vector<double> atLeft,
        atRight;               ///< -dE_e/dx_L and dE_e/dx_R: equal at all knots that are stationary
    std::vector<bool> hasMet;  ///< element of the least length
    Outcome outcome = Outcome::converged;
    Cost cost;

    double total() const;
    std::size_t elements() const { return energy.size(); }
};

/// The solution on so many equal elements that densities are known from it: once for all searches of a
/// problem.
KnotProfile fineProfile(const StaticProblem& problem);

/// `fine`: fineProfile(problem); not needed for equal knots. A search that would evaluate too much ends with
/// Outcome::diverged.
KnotProfile findProfile(const StaticProblem& problem, int elements, Knots knots, const KnotProfile& fine);
KnotProfile findProfile(const StaticProblem& problem, int elements, Knots knots);

}  // namespace extremal
