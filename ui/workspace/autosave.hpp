// SPDX-License-Identifier: GPL-3.0-or-later
/// Unsaved scenes survive a crash: a copy every 20 seconds, with the name and the file of the scene, offered
/// on the start page of the next session.
///
/// Each running window owns one copy, guarded by a lock file; a copy whose lock is free was left by a crash.
#pragma once

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QTimer>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/core/value.hpp"

namespace extremal {

class Notices;
class Workspace;

/// A scene that a session has left unsaved.
struct UnsavedScene {
    QString copy;          ///< the file that holds it
    QString name;          ///< "kepler.json"
    QString path, origin;  ///< as of Workspace
    std::string disk;      ///< Workspace::diskMark()
    QDateTime time;
    Value document;
    std::map<std::string, Value> drafts;  ///< what was typed and refused, by its places
};

class Autosave : public QObject {
    Q_OBJECT
public:
    Autosave(Workspace& workspace, Notices& notices, const QString& directory, QObject* parent = nullptr);
    ~Autosave() override;  ///< a clean end: the copy goes

    /// What crashes have left, the newest first. Copies that cannot be read are named in a notice.
    std::vector<UnsavedScene> unsaved() const;
    /// Opens it under its name. It stays unsaved, and its copy stays until this session has one of its own.
    bool restore(const UnsavedScene& scene);
    void discard(const UnsavedScene& scene);
    void writeNow();

    static QString defaultDirectory();

private:
    QString ownPath() const;

    Workspace& workspace_;
    Notices& notices_;
    QString directory_, name_;
    std::unique_ptr<QLockFile> lock_;
    QTimer timer_;
};

}  // namespace extremal
