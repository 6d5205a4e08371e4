// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/notices.hpp"

#include <QTime>
#include <algorithm>

namespace extremal {

void Notices::post(Notice notice) {
    const auto same =
        std::find_if(all_.begin(), all_.end(), [&](const Notice& n) { return n.key == notice.key; });
    const bool isRepeated = same != all_.end() && same->text == notice.text;
    if (!isRepeated) addToLog(notice.hint.isEmpty() ? notice.text : notice.text + " (" + notice.hint + ")");
    if (same != all_.end())
        *same = std::move(notice);
    else
        all_.push_back(std::move(notice));
    emit changed();
}

void Notices::dismiss(const QString& key) {
    if (std::erase_if(all_, [&](const Notice& n) { return n.key == key; })) emit changed();
}

void Notices::addToLog(const QString& line) {
    constexpr qsizetype maxLines = 1000;
    log_.append(QTime::currentTime().toString("HH:mm:ss  ") + line);
    if (log_.size() > maxLines) log_.removeFirst();
    emit logChanged();
}

}  // namespace extremal
