// SPDX-License-Identifier: GPL-3.0-or-later
/// Qt for a verb that draws without a display: the application, on the platform "offscreen".
#pragma once

#include <QApplication>

namespace extremal::app {

/// Qt's remarks about the machine are dropped, since they do not concern the picture; its errors are printed.
class Offscreen {
public:
    Offscreen();

private:
    /// Before the application: the platform is chosen when that is made, and it keeps these.
    int argc_ = 1;
    char program_[9] = "extremal";
    char* argv_[2] = {program_, nullptr};
    QApplication application_;
};

}  // namespace extremal::app
