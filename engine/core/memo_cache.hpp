// SPDX-License-Identifier: GPL-3.0-or-later
/// The last few values that were computed, by their keys: for values that are expensive and needed
/// repeatedly. Thread-safe; each value is computed once, while other threads wait for it.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

namespace extremal {

template <class Key, class Made>
class MemoCache {
public:
    explicit MemoCache(std::size_t most) : most_(most) {}

    /// The value of this key: the stored one, otherwise make(). If that throws, nothing is stored.
    template <class Make, class IsSame = std::equal_to<>>
    Made get(const Key& key, Make&& make, IsSame&& isSame = {}) {
        const std::lock_guard lock(mutex_);
        for (const auto& [of, made] : known_)
            if (isSame(of, key)) return made;
        Made made = make();
        if (known_.size() >= most_) known_.pop_front();
        return known_.emplace_back(key, std::move(made)).second;
    }

private:
    std::size_t most_;
    std::mutex mutex_;
    std::deque<std::pair<Key, Made>> known_;
};

}  // namespace extremal
