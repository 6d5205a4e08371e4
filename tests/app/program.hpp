/// The program as a user runs it.
#pragma once

#include <QFile>
#include <QProcess>
#include <QString>
#include <QStringList>

namespace extremal::tests {

/// Milliseconds after which a program counts as hung: with sanitizers it is thirty times as slow.
inline constexpr int patience = 600'000;

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
    if (!process.waitForFinished(patience)) return {};
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
