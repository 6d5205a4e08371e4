// SPDX-License-Identifier: GPL-3.0-or-later
/// One solution for many readers: its states at the times that will be asked for, computed once, in order and
/// only as far as somebody has asked.
///
/// The schemes of a comparison, and the cells of a column of a map, are measured at the nodes of their grids
/// against the same reference. Whoever asks first for a time computes all up to it; others find it. Memory is
/// that of all times: isSmall() says whether it is bearable. Times that are not in the table are answered by
/// a solution of the reader's own.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/model/exact_solution.hpp"

namespace extremal {

class SharedSolution {
public:
    /// Numbers that may be held: 160 MB.
    static constexpr double mostNumbers = 2e7;
    static bool isSmall(double times, std::size_t width) {
        return times * static_cast<double>(width) <= mostNumbers;
    }

    /// `make` makes a solution; `times` in any order, equal ones count once.
    SharedSolution(std::function<ExactSolution()> make, std::vector<double> times, std::size_t width);

    /// The shared solution as one reader sees it. Any number of readers, each in one thread at a time.
    static ExactSolution reader(std::shared_ptr<SharedSolution> shared);

private:
    void fill(std::size_t upTo);

    std::function<ExactSolution()> make_;
    std::vector<double> times_;
    std::size_t width_;
    std::mutex mutex_;
    ExactSolution solution_;      ///< guarded by the mutex, as what follows
    std::vector<double> states_;  ///< of the first times
    std::size_t known_ = 0;
};

}  // namespace extremal
