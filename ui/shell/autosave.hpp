/// Unsaved scenes survive a crash: a copy every 20 seconds, offered on the next start.
///
/// Each running window owns one copy, guarded by a lock file; a copy whose lock is free was left by a crash.
#pragma once

#include <QLockFile>
#include <QObject>
#include <QTimer>
#include <memory>

namespace extremal {

class Notices;
class Workspace;

class Autosave : public QObject {
    Q_OBJECT
public:
    Autosave(Workspace& workspace, Notices& notices, const QString& directory, QObject* parent = nullptr);
    ~Autosave() override;  ///< a clean end: the copy goes

    /// Posts a banner for the newest copy that a crash left, if there is one.
    void offerRecovery();
    void writeNow();

    static QString defaultDirectory();

private:
    QString ownPath() const;
    void recover(const QString& path);

    Workspace& workspace_;
    Notices& notices_;
    QString directory_, name_;
    std::unique_ptr<QLockFile> lock_;
    QTimer timer_;
};

}  // namespace extremal
