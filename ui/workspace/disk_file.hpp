// SPDX-License-Identifier: GPL-3.0-or-later
/// The file of the scene being worked on, as far as others write it as well: another program, another window,
/// another user.
///
/// What was read from the file or written to it last is remembered by its fingerprint, so that a file that
/// was only touched has not changed. Watching is a convenience; isChanged() looks at the file itself.
#pragma once

#include <QObject>
#include <QString>

#include <memory>
#include <string>
#include <string_view>

class QFileSystemWatcher;

namespace extremal {

class DiskFile : public QObject {
    Q_OBJECT
public:
    explicit DiskFile(QObject* parent = nullptr);
    ~DiskFile() override;

    /// From now on this is the file, with this content; an empty path: there is none. By the fingerprint
    /// where the content was known earlier (empty: it is not known, and whatever the file has counts as a
    /// change).
    void take(const QString& path, std::string_view content);
    void takeKnown(const QString& path, const std::string& fingerprint);

    /// Whether the file is there with another content than the one that is known, and than `mine`.
    bool isChanged(std::string_view mine = {}) const;
    const std::string& known() const { return known_; }

signals:
    void changed();   ///< the file has another content now
    void restored();  ///< it has the known one again, or is gone

private:
    void look();
    void watch();

    std::unique_ptr<QFileSystemWatcher> watcher_;
    QString path_;
    std::string known_;
    bool isTold_ = false;
};

}  // namespace extremal
