// SPDX-License-Identifier: GPL-3.0-or-later
/// The last few values that were computed, by their keys: for values that are expensive and needed
/// repeatedly. Those that were asked for longest ago are forgotten. Thread-safe; one value is computed at a
/// time, so that each is computed once, and what is known is had without waiting for it.
///
/// A function of the settings alone that is asked for while a scene is read also costs what it cost when it
/// was made, whoever asked first: CountedCache.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/work.hpp"

namespace extremal {

template <class Key, class Made>
class MemoCache {
public:
    using Size = std::function<double(const Made&)>;

    explicit MemoCache(std::size_t most) : most_(most) {}
    /// Also forgets where the sizes of all values exceed `largest`.
    MemoCache(std::size_t most, double largest, Size size)
        : most_(most), largest_(largest), size_(std::move(size)) {}

    /// The value of this key: the stored one, otherwise make(). If that throws, nothing is stored.
    template <class Make, class IsSame = std::equal_to<>>
    Made get(const Key& key, Make&& make, IsSame&& isSame = {}) {
        return getIf(
            key, std::forward<Make>(make), [](const Made&) { return true; }, isSame);
    }
    /// The same, where only values that are `worthKeeping` are stored.
    template <class Make, class WorthKeeping, class IsSame = std::equal_to<>>
    Made getIf(const Key& key, Make&& make, WorthKeeping&& worthKeeping, IsSame&& isSame = {}) {
        if (std::optional<Made> known = recall(key, isSame)) return *std::move(known);
        const std::lock_guard lock(making_);
        if (std::optional<Made> known = recall(key, isSame)) return *std::move(known);
        Made made = make();
        if (worthKeeping(made)) keep(key, made);
        return made;
    }

private:
    template <class IsSame>
    std::optional<Made> recall(const Key& key, IsSame&& isSame) {
        const std::lock_guard lock(listing_);
        for (auto it = known_.begin(); it != known_.end(); ++it)
            if (isSame(it->first, key)) {
                known_.splice(known_.begin(), known_, it);
                return it->second;
            }
        return {};
    }
    void keep(const Key& key, const Made& made) {
        const std::lock_guard lock(listing_);
        known_.emplace_front(key, made);
        double sum = 0;
        std::size_t count = 0;
        const auto isBeyond = [&](const auto& entry) {
            if (size_) sum += size_(entry.second);
            return count++ > 0 && (count > most_ || sum > largest_);
        };
        known_.erase(std::find_if(known_.begin(), known_.end(), isBeyond), known_.end());
    }

    std::size_t most_;
    double largest_ = std::numeric_limits<double>::infinity();
    Size size_;
    std::mutex listing_;
    std::recursive_mutex making_;            ///< what is made may ask for another value
    std::list<std::pair<Key, Made>> known_;  ///< the last that was asked for first
};

/// Such values with the work of making them.
template <class Key, class Made>
class CountedCache {
    struct Counted {
        Made made;
        double work;
    };

public:
    explicit CountedCache(std::size_t most) : known_(most) {}
    CountedCache(std::size_t most, double largest, std::function<double(const Made&)> size)
        : known_(most, largest, [size = std::move(size)](const Counted& c) { return size(c.made); }) {}

    /// `name`: by which the work is charged once to an account.
    template <class Make, class WorthKeeping>
    Made getIf(const Key& key, const std::string& name, Make&& make, WorthKeeping&& worthKeeping) {
        const Counted counted = known_.getIf(
            key,
            [&] {
                const work::Measured measured;
                Made made = make();
                return Counted{std::move(made), measured.spent()};
            },
            [&](const Counted& c) { return worthKeeping(c.made); });
        work::spendOnce(name, counted.work);
        return counted.made;
    }
    template <class Make>
    Made get(const Key& key, const std::string& name, Make&& make) {
        return getIf(key, name, std::forward<Make>(make), [](const Made&) { return true; });
    }

private:
    MemoCache<Key, Counted> known_;
};

}  // namespace extremal
