/// The state of a run at one node of time.
///
/// x holds the state columns of the system in their order; for a mechanical system x = (q, p), q first.
#pragma once

#include <vector>

namespace extremal {

struct State {
    double t = 0;
    long long node = 0;  ///< number of steps taken; fixed-step schemes set t = start + node * step, a product
    std::vector<double> x;
};

}  // namespace extremal
