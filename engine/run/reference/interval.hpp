// SPDX-License-Identifier: GPL-3.0-or-later
/// Enclosures of the values that a tape takes over a range of its inputs: what samples may miss, such as a
/// pulse between them, an enclosure contains.
///
///     [a, b] + [c, d] = [a + c, b + d],   exp [a, b] = [exp a, exp b],   ...
///
/// Rounding is not directed: an end may be off by some units in the last place, which does not matter to
/// where a pulse is. An operation that is not defined on all of an interval, or that is not known here, gives
/// the whole line, in which everything is contained.
#pragma once

#include <limits>
#include <span>

#include "engine/model/typed/tape/tape.hpp"

namespace extremal {

struct RealInterval {
    double low = 0, high = 0;
    static RealInterval all() {
        return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    }
    double width() const { return high - low; }
};

/// `r` has registers() entries and the inputs in front; afterwards output(i, r) encloses root i.
void enclose(const typed::Tape& tape, RealInterval* r);

}  // namespace extremal
