// SPDX-License-Identifier: GPL-3.0-or-later
/// Which registers of a tape are free while they are given out: the lowest ones that stand side by side
/// first, so that few are used, and what is used stays in the first cache. Internal to engine/model/typed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>

namespace extremal::typed {

class FreeRegisters {
public:
    explicit FreeRegisters(std::uint32_t first) : end_(first) {}

    /// The first of `count` registers side by side; of many, at the beginning of a line of the cache.
    std::uint32_t take(std::uint32_t count) {
        constexpr std::uint32_t line = 8;
        const auto startIn = [&](std::uint32_t first) {
            return count < line ? first : (first + line - 1) / line * line;
        };
        auto at = free_.begin();
        while (at != free_.end() && startIn(at->first) + count > at->second && at->second != end_) ++at;
        if (at == free_.end()) at = free_.emplace_hint(at, end_, end_);
        const auto [first, last] = *at;
        const std::uint32_t start = startIn(first), end = start + count;
        free_.erase(at);
        if (first < start) free_.emplace(first, start);
        if (end < last) free_.emplace(end, last);
        end_ = std::max(end_, end);
        return start;
    }
    void release(std::uint32_t one) {
        std::uint32_t first = one, last = one + 1;
        auto after = free_.lower_bound(one);
        if (after != free_.end() && after->first == last) {
            last = after->second;
            after = free_.erase(after);
        }
        if (after != free_.begin() && std::prev(after)->second == one) {
            --after;
            first = after->first;
            free_.erase(after);
        }
        free_.emplace(first, last);
    }
    /// One past the highest that was ever taken.
    std::uint32_t end() const { return end_; }

private:
    std::map<std::uint32_t, std::uint32_t> free_;  ///< of each free stretch: its first -> one past its last
    std::uint32_t end_;
};

}  // namespace extremal::typed
