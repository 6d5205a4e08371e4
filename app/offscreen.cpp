// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/offscreen.hpp"

#include "app/report.hpp"

namespace extremal::app {
namespace {

void dropRemarks(QtMsgType type, const QMessageLogContext&, const QString& text) {
    if (type == QtCriticalMsg || type == QtFatalMsg) printProblem("", text.toStdString());
}

int& onOffscreenPlatform(int& argc) {
    qInstallMessageHandler(dropRemarks);
    qputenv("QT_QPA_PLATFORM", "offscreen");
    return argc;
}

}  // namespace

Offscreen::Offscreen() : application_(onOffscreenPlatform(argc_), argv_) {}

}  // namespace extremal::app
