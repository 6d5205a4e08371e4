// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/disk_file.hpp"

#include <QFile>
#include <QFileInfo>
#include <QFileSystemWatcher>

#include "engine/core/text/fingerprint.hpp"

namespace extremal {

DiskFile::DiskFile(QObject* parent) : QObject(parent), watcher_(std::make_unique<QFileSystemWatcher>()) {
    connect(watcher_.get(), &QFileSystemWatcher::fileChanged, this, &DiskFile::look);
    connect(watcher_.get(), &QFileSystemWatcher::directoryChanged, this, &DiskFile::look);
}

DiskFile::~DiskFile() = default;

void DiskFile::take(const QString& path, std::string_view content) { takeKnown(path, fingerprint(content)); }

void DiskFile::takeKnown(const QString& path, const std::string& fingerprint) {
    path_ = path;
    known_ = fingerprint;
    isTold_ = false;
    watch();
}

/// The folder as well: a file that is replaced by another of its name is not watched any more.
void DiskFile::watch() {
    const QStringList before = watcher_->files() + watcher_->directories();
    if (!before.isEmpty()) watcher_->removePaths(before);
    if (path_.isEmpty()) return;
    QStringList now{QFileInfo(path_).absolutePath()};
    if (QFileInfo(path_).isFile()) now << path_;
    watcher_->addPaths(now);
}

bool DiskFile::isChanged(std::string_view mine) const {
    if (path_.isEmpty() || !QFileInfo(path_).isFile()) return false;
    QFile file(path_);
    if (!file.open(QIODevice::ReadOnly)) return false;  // saving says why it cannot be written
    const std::string now = fingerprint(file.readAll().toStdString());
    return now != known_ && (mine.empty() || now != fingerprint(mine));
}

void DiskFile::look() {
    if (!watcher_->files().contains(path_)) watch();
    const bool isNow = isChanged();
    if (isNow)
        emit changed();
    else if (isTold_)
        emit restored();
    isTold_ = isNow;
}

}  // namespace extremal
