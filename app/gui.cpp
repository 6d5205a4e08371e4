// SPDX-License-Identifier: GPL-3.0-or-later
#include <QCoreApplication>
#include <QString>
#include <QtGlobal>

#include <cstdlib>

#include <unistd.h>

#include "app/report.hpp"
#include "app/verbs.hpp"
#include "ui/shell/start.hpp"

namespace extremal::app {
namespace {

int tellMissingDisplay() {
    printProblem("window", "there is no display to open it on",
                 "extremal run and extremal snapshot need none");
    return unusable;
}

/// Qt ends the program when it finds no display; it shall do so with our words and exit code.
void tellFatal(QtMsgType type, const QMessageLogContext&, const QString& text) {
    if (type == QtFatalMsg && text.contains("platform plugin")) ::_exit(tellMissingDisplay());
    // The message before it names the display that was tried; other messages are not shown.
    const bool isAboutDisplay =
        text.contains("could not connect to display") || text.contains("platform plugin");
    if (!isAboutDisplay && (type == QtFatalMsg || std::getenv("EXTREMAL_DEBUG")))
        printProblem("window", text.toStdString());
}

bool hasDisplay() {
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
        if (const char* value = std::getenv(name); value && *value) return true;
    return false;
}

}  // namespace

int guiVerb(int argc, char** argv, const std::string& scene, const CommonOptions& options) {
    if (!options.overrides.empty() || !options.added.empty()) {
        printProblem("arguments", "--set and --add change the scene of a verb, not of the window",
                     "extremal run SCENE --set ...");
        return unusable;
    }
    if (!hasDisplay()) return tellMissingDisplay();
    qInstallMessageHandler(tellFatal);
    QCoreApplication::setApplicationVersion(QString::fromStdString(versionText()));
    return runWindow(argc, argv, scene,
                     [&](const std::vector<Problem>& problems) { printProblems(scene, problems); });
}

}  // namespace extremal::app
