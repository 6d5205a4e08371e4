// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/autosave.hpp"

#include <QCoreApplication>
#include <QDateTime>
#include <QDir>
#include <QSaveFile>
#include <QStandardPaths>
#include <QUuid>

#include "engine/core/problem.hpp"
#include "engine/scene/read/json.hpp"
#include "ui/base/notices.hpp"
#include "ui/workspace/workspace.hpp"

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
    const bool hasChanges = workspace_.isDirty() || workspace_.hasDrafts();
    if (!workspace_.hasScene() || !hasChanges || !QDir().mkpath(directory_)) return;
    if (!lock_) {
        lock_ = std::make_unique<QLockFile>(directory_ + "/" + name_ + ".lock");
        lock_->setStaleLockTime(0);
        lock_->tryLock(0);
    }
    QSaveFile file(ownPath());
    const Value copy(Value::Object{
        {"name", workspace_.fileName().toStdString()},
        {"path", workspace_.path().toStdString()},
        {"origin", workspace_.origin().toStdString()},
        {"disk", workspace_.diskMark()},
        {"drafts", Value(Value::Object(workspace_.drafts().begin(), workspace_.drafts().end()))},
        {"scene", workspace_.document()}});
    const std::string text = writeJson(copy);
    const bool isWritten = file.open(QIODevice::WriteOnly) &&
                           file.write(text.data(), static_cast<qint64>(text.size())) >= 0 && file.commit();
    if (!isWritten)
        notices_.post({Notice::Kind::warning,
                       "autosave",
                       tr("The unsaved scene could not be backed up: %1").arg(file.errorString()),
                       tr("save it with Ctrl+S"),
                       {}});
}

std::vector<UnsavedScene> Autosave::unsaved() const {
    std::vector<UnsavedScene> all;
    const QFileInfoList copies = QDir(directory_).entryInfoList({"*.json"}, QDir::Files, QDir::Time);
    for (const QFileInfo& info : copies) {
        if (info.completeBaseName() == name_) continue;
        QLockFile lock(directory_ + "/" + info.completeBaseName() + ".lock");
        lock.setStaleLockTime(0);
        if (!lock.tryLock(0)) continue;  // another window is using it
        lock.unlock();
        QFile file(info.absoluteFilePath());
        try {
            if (!file.open(QIODevice::ReadOnly)) continue;
            const Value copy = parseJson(file.readAll().toStdString());
            const Value* scene = copy.find("scene");
            const auto text = [&](const char* key) {
                const Value* value = copy.find(key);
                return value && value->isString() ? QString::fromStdString(value->asString()) : QString();
            };
            std::map<std::string, Value> drafts;
            if (const Value* kept = copy.find("drafts"); kept && kept->isObject())
                drafts = {kept->asObject().begin(), kept->asObject().end()};
            all.push_back({info.absoluteFilePath(), text("name"), text("path"), text("origin"),
                           text("disk").toStdString(), info.lastModified(), scene ? *scene : copy,
                           std::move(drafts)});
            if (all.back().name.isEmpty()) all.back().name = tr("unsaved");
        } catch (const InvalidScene&) {
            notices_.post({Notice::Kind::error,
                           "recovery",
                           tr("The backup of a scene is damaged: %1").arg(info.absoluteFilePath()),
                           tr("open it in an editor"),
                           {}});
        }
    }
    return all;
}

bool Autosave::restore(const UnsavedScene& scene) {
    if (!workspace_.adopt(scene.document, scene.path, scene.origin, scene.disk)) return false;
    for (const auto& [place, value] : scene.drafts) workspace_.edit({{place, value}}, tr("Typed before"));
    writeNow();
    if (QFile::exists(ownPath())) QFile::remove(scene.copy);
    return true;
}

void Autosave::discard(const UnsavedScene& scene) { QFile::remove(scene.copy); }

}  // namespace extremal
