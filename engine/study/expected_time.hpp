// SPDX-License-Identifier: GPL-3.0-or-later
/// How long the runs of a study will take, from a few steps of a few of them: what is announced before they
/// begin.
#pragma once

#include <cstddef>
#include <functional>
#include <stop_token>

#include "engine/model/exact_solution.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {

/// CPU seconds of a scene of one scheme: what reading it takes, and a run, where it is not refused.
double secondsOfScene(const std::function<ReadScene()>& read, const std::stop_token& stop);

/// CPU seconds that a solution takes at times `every` apart from `start` to `end` (0: those of a scheme that
/// chooses its steps), as the first of them tell it: one that is stepped along may take more than the run
/// that it is compared with. `width`: of its states.
double secondsOfSolution(const ExactSolution& solution, std::size_t width, double start, double end,
                         double every, const std::stop_token& stop);

class ExpectedTime {
public:
    /// Runs 0..n-1 that one number changes little by little. `seconds(i)`: of CPU, of the whole run i, as
    /// some trial steps tell it; 0: it fails at once. Some are tried; between them the logarithm is linear.
    void addRuns(std::size_t n, const std::function<double(std::size_t)>& seconds);
    /// Runs 0..n-1 that are such a series as long as `isSame(i, j)` of neighbours.
    void addSeries(std::size_t n, const std::function<bool(std::size_t, std::size_t)>& isSame,
                   const std::function<double(std::size_t)>& seconds);
    /// One run.
    void add(double seconds);

    /// On so many threads (0: as many as the machine has cores): all of them in equal shares, but at least
    /// the longest run.
    double onThreads(unsigned threads) const;

private:
    double all_ = 0, longest_ = 0;
};

}  // namespace extremal
