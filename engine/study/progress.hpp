// SPDX-License-Identifier: GPL-3.0-or-later
/// How the points of a study are run: as independent tasks on a pool of threads, each handed on when it is
/// known, with the share of them that is, and how long all of them should take.
#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/duration.hpp"
#include "engine/core/pool.hpp"
#include "engine/study/search/selection.hpp"

namespace extremal {

/// The points of a shard that are not known.
template <class IsKnown>
std::vector<std::size_t> wantedPoints(std::size_t size, const Shard& shard, IsKnown&& isKnown) {
    std::vector<std::size_t> wanted;
    for (std::size_t i = 0; i < size; ++i)
        if (shard.has(i) && !isKnown(i)) wanted.push_back(i);
    return wanted;
}

/// How long a study should take.
struct AnnouncedTime {
    double seconds = 0;    ///< from its begin to its end, on an idle machine; 0: not known yet
    bool isLimit = false;  ///< it may end earlier: what it searches is cut off there
};

/// "about 12 s", "at most 4 s".
inline std::string textOf(const AnnouncedTime& time) {
    return (time.isLimit ? "at most " : "about ") + durationText(std::ceil(time.seconds));
}

/// Copies share their counters.
class StudyProgress {
public:
    /// 0..1; callable while it runs, as is the next.
    double fraction() const {
        const std::size_t wanted = counters_->wanted;
        return wanted > 0 ? static_cast<double>(counters_->done) / static_cast<double>(wanted) : 0;
    }
    /// What all points need is computed; none has begun.
    bool isPreparing() const { return counters_->isPreparing; }
    void setPreparing(bool isPreparing) { counters_->isPreparing = isPreparing; }

    AnnouncedTime announced() const { return {counters_->announced, counters_->isLimit}; }
    void begin() {
        counters_->announced = 0;
        begin_ = std::chrono::steady_clock::now();
    }
    /// What is ahead; what it took so far is added. Zero or less: it cannot tell.
    void announce(double ahead, bool isLimit = false) {
        counters_->isLimit = isLimit;
        const std::chrono::duration<double> soFar = std::chrono::steady_clock::now() - begin_;
        if (ahead > 0) counters_->announced = soFar.count() + ahead;
    }

    /// keep(i, compute(i)) for each wanted point: computed on as many threads, kept by one at a time. What is
    /// computed when a stop has been requested is dropped.
    template <class Compute, class Keep>
    void run(const std::vector<std::size_t>& wanted, unsigned threads, const std::stop_token& stop,
             Compute&& compute, Keep&& keep) {
        counters_->done = 0;
        counters_->wanted = wanted.size();
        std::mutex mutex;
        forEachInPool(wanted, threads, stop, [&](std::size_t i) {
            auto result = compute(i);
            const std::lock_guard lock(mutex);
            if (stop.stop_requested()) return;
            keep(i, std::move(result));
            ++counters_->done;
        });
    }

private:
    struct Counters {
        std::atomic<std::size_t> done{0}, wanted{0};
        std::atomic<bool> isPreparing{false}, isLimit{false};
        std::atomic<double> announced{0};
    };
    std::shared_ptr<Counters> counters_ = std::make_shared<Counters>();
    std::chrono::steady_clock::time_point begin_ = {};
};

}  // namespace extremal
