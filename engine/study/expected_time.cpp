// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/expected_time.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "engine/core/problem.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/scene/outlook/cost.hpp"
namespace extremal {
namespace {

constexpr std::size_t mostTried = 4;
constexpr double least = 1e-7;  ///< seconds: a run that fails at once costs something as well

}  // namespace

double secondsOfScene(const std::function<ReadScene()>& read) {
    constexpr double observed = 0.5;  // of the steps
    const double begin = threadSeconds();
    const ReadScene scene = read();
    const double reading = threadSeconds() - begin;
    if (!scene.resolved) return reading;
    try {
        return reading + (1 + observed) * predictSeconds(*scene.resolved, scene.resolved->schemes.front());
    } catch (const InvalidScene&) {
        return reading;
    }
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

void ExpectedTime::add(double seconds) {
    all_ += seconds;
    longest_ = std::max(longest_, seconds);
}

double ExpectedTime::onThreads(unsigned threads) const {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    return std::max(longest_, all_ / (threads > 0 ? threads : cores));
}

}  // namespace extremal
