// SPDX-License-Identifier: GPL-3.0-or-later
/// Independent pieces of work on threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stop_token>
#include <thread>
#include <vector>

namespace extremal {

/// 0: as many as the machine has cores.
inline unsigned threadsOf(unsigned threads) {
    return threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls work(i) once for every i of the list, until a stop is requested. `threads`: 0 for as many as the
/// machine has cores.
template <class Work>
void forEachInPool(const std::vector<std::size_t>& list, unsigned threads, const std::stop_token& stop,
                   Work&& work) {
    std::atomic<std::size_t> next{0};
    const auto take = [&] {
        for (std::size_t k = next++; k < list.size() && !stop.stop_requested(); k = next++) work(list[k]);
    };
    const auto most = std::min<std::size_t>(threadsOf(threads), list.size());
    std::vector<std::jthread> pool;
    for (std::size_t i = 1; i < most; ++i) pool.emplace_back(take);
    take();
}

}  // namespace extremal
