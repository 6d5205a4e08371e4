// SPDX-License-Identifier: GPL-3.0-or-later
/// The program as a user runs it.
#pragma once

#include <QFile>
#include <QProcess>
#include <QString>
#include <QStringList>

#include "tests/tools/slowdown.hpp"

namespace extremal::tests {

/// How long a program may take before it counts as hung, in milliseconds.
constexpr int limit(int milliseconds) { return slowdown * milliseconds; }

struct Answer {
    int code = -1;  ///< -2: ended by a signal
    QString out, err;
};

struct Surroundings {
    QByteArray input = {};
    QString outFile = {};  ///< where standard output goes instead
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
};

inline Answer runProgram(const QStringList& arguments, const Surroundings& around = {}) {
    QProcess process;
    process.setProcessEnvironment(around.environment);
    if (!around.outFile.isEmpty()) process.setStandardOutputFile(around.outFile);
    process.start(QStringLiteral(EXTREMAL_BINARY), arguments);
    process.write(around.input);
    process.closeWriteChannel();
    if (!process.waitForFinished(limit(60000))) return {};
    return {process.exitStatus() == QProcess::NormalExit ? process.exitCode() : -2,
            QString::fromUtf8(process.readAllStandardOutput()),
            QString::fromUtf8(process.readAllStandardError())};
}

/// The content of a file; nothing where it cannot be opened.
inline QByteArray contentOf(const QString& path) {
    QFile file(path);
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace extremal::tests
