// SPDX-License-Identifier: GPL-3.0-or-later
/// Which nodes become rows: with output.every = E the first node at or after each multiple of E, else every
/// m-th node with the smallest m that gives at most 2,000 rows; always the first and the last node reached.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/core/text/archive.hpp"

namespace extremal {

class RowSampler {
public:
    static constexpr long long maxRows = 2000;

    /// Smallest m for N steps: nodes 0, m, 2m, ... and N are at most maxRows.
    static long long stride(long long steps) {
        long long m = std::max(1LL, steps / maxRows);
        while (steps / m + 1 + (steps % m != 0 ? 1 : 0) > maxRows) ++m;
        return m;
    }
    /// `every`: negative where time runs backwards.
    RowSampler(double start, std::optional<double> every, long long stride)
        : start_(start), every_(every.value_or(0)), stride_(stride), nextNode_(stride) {}

    /// Whether this node, not the first, is a row. Call it once per node, in order.
    bool isRow(long long node, double t, double step) {
        if (every_ == 0) {
            if (node < nextNode_) return false;
            nextNode_ += stride_;
            return true;
        }
        const double k = (t - start_) / every_ + 1e-9 * step / every_;
        if (k < next_) return false;
        next_ = std::floor(k) + 1;
        return true;
    }
    void checkpoint(Archive& archive) { archive(nextNode_, next_); }

private:
    double start_, every_;
    long long stride_;
    long long nextNode_;  ///< the next row without `every`
    double next_ = 1;     ///< the next multiple with it; node 0 is always a row
};

/// Every m-th value from the first, and the last.
inline std::vector<double> thinned(const std::vector<double>& values, std::size_t m) {
    std::vector<double> kept;
    for (std::size_t r = 0; r < values.size(); r += m) kept.push_back(values[r]);
    if ((values.size() - 1) % m != 0) kept.push_back(values.back());
    return kept;
}

}  // namespace extremal
