/// Where a function of the state passes zero inside a step: its sign is seen at the nodes, the place is found
/// on the dense output, to round-off of tau. A function that passes zero twice within one step is not seen.
#pragma once

#include <boost/math/tools/toms748_solve.hpp>

#include <cstdint>

namespace extremal {

/// A zero at the later node belongs to the step, one at the earlier node to the step before.
inline bool passesUpwards(double first, double last) { return first < 0 && last >= 0; }
inline bool passesDownwards(double first, double last) { return first > 0 && last <= 0; }

/// tau in [0, 1] of the zero of value(tau), of which passesUpwards or passesDownwards holds at the nodes.
template <class Value>
double crossingOf(double last, const Value& value) {
    if (last == 0) return 1;
    // The curve meets the nodes to round-off only: an end that is at zero to round-off is the place.
    const double atFirst = value(0.0), atLast = value(1.0);
    if (!(atFirst * atLast < 0) || (atLast < 0) != (last < 0)) return 1;
    std::uintmax_t evaluations = 100;
    const auto found = boost::math::tools::toms748_solve(
        value, 0.0, 1.0, atFirst, atLast, boost::math::tools::eps_tolerance<double>(), evaluations);
    return (found.first + found.second) / 2;
}

}  // namespace extremal
