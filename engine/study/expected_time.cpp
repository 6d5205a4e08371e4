// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/expected_time.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/pool.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/scene/outlook/cost.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostTried = 4;
constexpr double least = 1e-7;  ///< seconds: a run that fails at once costs something as well

}  // namespace

double secondsOfScene(const std::function<ReadScene()>& read, const std::stop_token& stop) {
    constexpr double observed = 0.5;  // of the steps
    const double begin = threadSeconds();
    const ReadScene scene = read();
    const double reading = threadSeconds() - begin;
    if (!scene.resolved) return reading;
    return reading + (1 + observed) * trialSeconds(*scene.resolved, scene.resolved->schemes.front(), stop);
}

double secondsOfSolution(const ExactSolution& solution, std::size_t width, double start, double end,
                         double every, const std::stop_token& stop) {
    constexpr double budget = 2e-2, usualSteps = 256;
    if (!(every > 0)) every = (end - start) / usualSteps;
    std::vector<double> x(width);
    const double begin = threadSeconds();
    double t = start, spent = 0;
    for (long long k = 1; t < end && spent < budget && !stop.stop_requested(); ++k) {
        t = std::min(end, start + static_cast<double>(k) * every);
        solution(t, x);
        spent = threadSeconds() - begin;
    }
    return t > start ? spent * (end - start) / (t - start) : 0;
}

void ExpectedTime::addRuns(std::size_t n, const std::function<double(std::size_t)>& seconds) {
    if (n == 0) return;
    const std::size_t tried = std::min(n, mostTried);
    const auto placeOf = [&](std::size_t k) { return tried < 2 ? n / 2 : k * (n - 1) / (tried - 1); };
    std::size_t left = placeOf(0);
    double atLeft = std::max(least, seconds(left));
    add(atLeft);
    for (std::size_t k = 1; k < tried; ++k) {
        const std::size_t right = placeOf(k);
        const double atRight = std::max(least, seconds(right)), ratio = atRight / atLeft;
        for (std::size_t i = left + 1; i <= right; ++i)
            add(atLeft * std::pow(ratio, static_cast<double>(i - left) / static_cast<double>(right - left)));
        left = right;
        atLeft = atRight;
    }
}

void ExpectedTime::addSeries(std::size_t n, const std::function<bool(std::size_t, std::size_t)>& isSame,
                             const std::function<double(std::size_t)>& seconds) {
    for (std::size_t first = 0, last; first < n; first = last) {
        for (last = first + 1; last < n && isSame(first, last);) ++last;
        addRuns(last - first, [&](std::size_t k) { return seconds(first + k); });
    }
}

void ExpectedTime::add(double seconds) {
    all_ += seconds;
    longest_ = std::max(longest_, seconds);
}

double ExpectedTime::onThreads(unsigned threads) const {
    return std::max(longest_, all_ / threadsOf(threads));
}

}  // namespace extremal
