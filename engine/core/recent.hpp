/// The last few things made, for what takes long and is asked for again and again. Any thread may ask; each
/// thing is made once, and others wait for it.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <utility>

namespace extremal {

template <class Key, class Made>
class Recent {
public:
    explicit Recent(std::size_t most) : most_(most) {}

    /// What was made from the same key, else make(); if that throws, nothing is kept.
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
