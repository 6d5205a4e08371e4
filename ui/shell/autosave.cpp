#include "ui/shell/autosave.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QSaveFile>
#include <QStandardPaths>
#include <QUuid>

#include "engine/core/problem.hpp"
#include "engine/scene/codec.hpp"
#include "engine/scene/json.hpp"
#include "ui/shell/notices.hpp"
#include "ui/shell/workspace.hpp"

namespace extremal {

namespace {
constexpr int everyMs = 20000;
}

Autosave::Autosave(Workspace& workspace, Notices& notices, const QString& directory, QObject* parent)
    : QObject(parent),
      workspace_(workspace),
      notices_(notices),
      directory_(directory),
      name_(QUuid::createUuid().toString(QUuid::WithoutBraces)) {
    timer_.setInterval(everyMs);
    connect(&timer_, &QTimer::timeout, this, &Autosave::writeNow);
    connect(&workspace_, &Workspace::fileChanged, this, [this] {
        if (!workspace_.isDirty()) QFile::remove(ownPath());
    });
    timer_.start();
}

Autosave::~Autosave() {
    QFile::remove(ownPath());
    if (lock_) lock_->unlock();
}

QString Autosave::defaultDirectory() {
    return QStandardPaths::writableLocation(QStandardPaths::AppDataLocation) + "/unsaved";
}

QString Autosave::ownPath() const { return directory_ + "/" + name_ + ".json"; }

void Autosave::writeNow() {
    if (!workspace_.isDirty() || !QDir().mkpath(directory_)) return;
    if (!lock_) {
        lock_ = std::make_unique<QLockFile>(directory_ + "/" + name_ + ".lock");
        lock_->setStaleLockTime(0);
        lock_->tryLock(0);
    }
    QSaveFile file(ownPath());
    const std::string text = writeScene(workspace_.scene());
    const bool isWritten = file.open(QIODevice::WriteOnly) &&
                           file.write(text.data(), static_cast<qint64>(text.size())) >= 0 && file.commit();
    if (!isWritten)
        notices_.post({Notice::Kind::warning,
                       "autosave",
                       tr("The unsaved scene could not be backed up: %1").arg(file.errorString()),
                       tr("save it with Ctrl+S"),
                       {}});
}

void Autosave::recover(const QString& path) {
    QFile file(path);
    if (file.open(QIODevice::ReadOnly)) {
        try {
            if (workspace_.adopt(parseJson(file.readAll().toStdString()))) file.remove();
        } catch (const InvalidScene&) {
            notices_.post({Notice::Kind::error,
                           "recovery",
                           tr("The backup of the scene is damaged: %1").arg(path),
                           tr("open it in an editor"),
                           {}});
        }
    }
}

void Autosave::offerRecovery() {
    const QFileInfoList kept = QDir(directory_).entryInfoList({"*.json"}, QDir::Files, QDir::Time);
    for (const QFileInfo& info : kept) {
        if (info.completeBaseName() == name_) continue;
        QLockFile lock(directory_ + "/" + info.completeBaseName() + ".lock");
        lock.setStaleLockTime(0);
        if (!lock.tryLock(0)) continue;  // another window is using it
        lock.unlock();
        const QString path = info.absoluteFilePath();
        notices_.post({Notice::Kind::information,
                       "recovery",
                       tr("The program ended unexpectedly; there is a backup of an unsaved scene of %1.")
                           .arg(info.lastModified().toString("d MMMM, HH:mm")),
                       {},
                       {{tr("Restore"), [this, path] { recover(path); }},
                        {tr("Discard"), [path] { QFile::remove(path); }}}});
        return;
    }
}

}  // namespace extremal
