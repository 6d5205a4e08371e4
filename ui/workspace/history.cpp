// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/history.hpp"

namespace extremal {

namespace {
constexpr std::size_t maxEntries = 500;
constexpr qint64 mergeWithinMs = 1000;
}  // namespace

void History::clear() {
    past_.clear();
    future_.clear();
}

void History::push(EditState before, const QString& what, const QString& mergeKey) {
    const bool merges = !mergeKey.isEmpty() && !past_.empty() && future_.empty() &&
                        past_.back().mergeKey == mergeKey && sincePush_.isValid() &&
                        sincePush_.elapsed() < mergeWithinMs;
    sincePush_.start();
    future_.clear();
    if (merges) return;
    past_.push_back({std::move(before), what, mergeKey});
    if (past_.size() > maxEntries) past_.erase(past_.begin());
}

EditState History::undo(EditState now) {
    Entry entry = std::move(past_.back());
    past_.pop_back();
    future_.push_back({std::move(now), entry.what, {}});
    return std::move(entry.state);
}

EditState History::redo(EditState now) {
    Entry entry = std::move(future_.back());
    future_.pop_back();
    past_.push_back({std::move(now), entry.what, {}});
    return std::move(entry.state);
}

}  // namespace extremal
