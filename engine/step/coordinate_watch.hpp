// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether every coordinate of a step is solved, for iterations that compare the largest correction with the
/// largest entry of the state.
///
/// That comparison alone ends too early where entries have very different sizes: momenta of 1e-6 beside
/// positions of 30, or a light body beside a heavy one. So each entry is measured by itself as well
/// (solve/correction_size.hpp), and the iteration goes on while that measure shrinks. It need not become
/// small: an entry that a symmetry keeps at rest moves by round-off alone, and stalls at once.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/solve/correction_size.hpp"

namespace extremal {

class CoordinateWatch {
public:
    /// One entry of the correction: its change, what it has moved in this step, and its value at the start.
    void add(double change, double increment, double value) {
        largest_ = std::max(largest_, relativeCorrection(std::abs(change), std::abs(increment), value));
    }
    /// Once for each correction, after its entries. `stall`: a correction that is larger than this part of
    /// the one before has stopped shrinking; a quarter for Newton's method.
    bool isSettled(double stall = 0.25) {
        const bool isSmall = largest_ <= roundOffOfSums<double>(), hasStalled = largest_ >= stall * last_;
        last_ = largest_;
        largest_ = 0;
        return isSmall || hasStalled;
    }

private:
    double largest_ = 0, last_ = std::numeric_limits<double>::infinity();
};

/// For iterations by repeated evaluation, which contract more slowly.
inline constexpr double stallOfSweeps = 0.8;

}  // namespace extremal
