// SPDX-License-Identifier: GPL-3.0-or-later
/// A solution as a table that is read off at any time, in any order: for many runs that are compared with one
/// reference at nodes of their own, none of which should have to integrate it again.
///
///     x(t) = sum_j l_j(s) x_j,   s = (t - t_k)/H,   on each of K equal intervals
///
/// with 16 Chebyshev points of the second kind. K grows by 4 until the table reproduces every entry of the
/// solution, between its points, to the tolerance or to 1e-13 of the entry's own size. A solution that is
/// stepped along and has kinks or jumps, as at walls, is taken step by step instead; a step that 16 points do
/// not reproduce is halved, down to 1e-13 of the run about a jump.
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <vector>

#include "engine/model/exact_solution.hpp"

namespace extremal {

class TabulatedSolution {
public:
    /// Null where a table of at most a million numbers does not reproduce the solution, as that of many fast
    /// periods, or where the solution ends early.
    /// `checked`: so many entries, the first ones, must be reproduced; the others are as good as they are.
    static std::shared_ptr<const TabulatedSolution> of(const ExactSolution& solution, double start,
                                                       double end, std::size_t width, std::size_t checked,
                                                       double tolerance, const std::stop_token& stop);
    /// Any number of readers, in any threads.
    static ExactSolution reader(std::shared_ptr<const TabulatedSolution> table);

    void at(double t, double* x) const;

private:
    std::vector<double> bounds_;  ///< of intervals that are not equal, ascending; else empty
    double start_ = 0, length_ = 0;
    std::size_t intervals_ = 0, width_ = 0;
    std::vector<double> states_;  ///< interval after interval, point after point
};

}  // namespace extremal
