// SPDX-License-Identifier: GPL-3.0-or-later
/// The text of the project's own files, as tests of its prose read it.
///
/// `runningText` joins the lines of a comment or of a string literal into running text, so that a phrase
/// is found where a line break divides it.
#pragma once

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QRegularExpression>
#include <QString>
#include <QStringList>

namespace extremal::tree_text {

inline const QString root = QStringLiteral(EXTREMAL_SOURCE_DIR "/");

/// Paths from the root of all files in `folders` (and of single files) whose names match `patterns`, sorted.
inline QStringList files(const QStringList& folders, const QStringList& patterns) {
    QStringList found;
    for (const QString& folder : folders) {
        if (!QDir(root + folder).exists()) {
            if (QFile::exists(root + folder)) found << folder;
            continue;
        }
        QDirIterator each(root + folder, patterns, QDir::Files, QDirIterator::Subdirectories);
        while (each.hasNext()) found << each.next().mid(root.size());
    }
    found.sort();
    return found;
}

/// Sources, presets, handbook and the Markdown files of the root.
inline QStringList everyText() {
    return files({"engine", "ui", "app", "tests", "presets", "resources", "README.md", "CHANGELOG.md"},
                 {"*.cpp", "*.hpp", "*.cmake", "CMakeLists.txt", "*.json", "*.md"});
}

inline QString text(const QString& path) {
    QFile file(root + path);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

inline QString runningText(const QString& path) {
    static const QRegularExpression commentBreak(R"(\n[ \t]*(///?<?|#)[ \t]*)");
    static const QRegularExpression literalBreak(R"("[ \t]*\n[ \t]*")");
    QString all = text(path);
    all.replace(literalBreak, "");
    all.replace(commentBreak, " ");
    return all.replace('\n', ' ');
}

}  // namespace extremal::tree_text
