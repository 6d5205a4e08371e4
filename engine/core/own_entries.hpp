// SPDX-License-Identifier: GPL-3.0-or-later
/// Entries of catalogues that do not come from files of the engine: systems and spaces of a program that uses
/// the library. Catalogues are constants; such entries are added before a catalogue is first asked for, and
/// become part of the constant.
#pragma once

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace extremal {

template <class Entry>
class OwnEntries {
public:
    /// Throws std::logic_error where the catalogue is in use already, or has an added entry of this id.
    static void add(Entry entry) {
        const std::lock_guard lock(mutex_);
        if (isInUse_)
            throw std::logic_error("\"" + entry.item.id +
                                   "\" must be added before the first scene is read or catalogue asked for");
        for (const Entry& other : added_)
            if (other.item.id == entry.item.id)
                throw std::logic_error("\"" + entry.item.id + "\" has been added already");
        added_.push_back(std::move(entry));
    }
    /// The supplied entries and those added, which from now on cannot grow. Throws std::logic_error where an
    /// added one has the id of a supplied one.
    static std::vector<Entry> joined(std::vector<Entry> supplied) {
        const std::lock_guard lock(mutex_);
        isInUse_ = true;
        if constexpr (requires(const Entry& e) { e.item.id; })
            for (const Entry& entry : added_)
                for (const Entry& other : supplied)
                    if (other.item.id == entry.item.id)
                        throw std::logic_error("\"" + entry.item.id + "\" is supplied already");
        supplied.insert(supplied.end(), added_.begin(), added_.end());
        return supplied;
    }

private:
    inline static std::mutex mutex_;
    inline static bool isInUse_ = false;
    inline static std::vector<Entry> added_;
};

/// Adds the rows of a table, each in front of the first entry whose id is greater, as those of files are in
/// alphabetical order.
template <class Entry>
void addRows(std::vector<Entry>& entries, std::vector<Entry> rows) {
    for (Entry& row : rows)
        entries.insert(std::find_if(entries.begin(), entries.end(),
                                    [&](const Entry& entry) { return entry.item.id > row.item.id; }),
                       std::move(row));
}

}  // namespace extremal
