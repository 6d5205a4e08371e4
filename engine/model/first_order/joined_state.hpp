// SPDX-License-Identifier: GPL-3.0-or-later
/// A state without coordinates, as methods for (q, p) have it: its first half is q, its second half p.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace extremal {

/// Room for one state and its rate. Of an even size.
struct JoinedState {
    explicit JoinedState(std::size_t size) : x(size), dx(size) {}
    std::vector<double> x, dx;

    const double* join(const double* q, const double* p) {
        const auto half = static_cast<std::ptrdiff_t>(x.size() / 2);
        std::copy_n(p, half, std::copy_n(q, half, x.begin()));
        return x.data();
    }
    void splitRate(double* qdot, double* pdot) const {
        const auto half = static_cast<std::ptrdiff_t>(dx.size() / 2);
        std::copy_n(dx.begin(), half, qdot);
        std::copy_n(dx.begin() + half, half, pdot);
    }
};

}  // namespace extremal
