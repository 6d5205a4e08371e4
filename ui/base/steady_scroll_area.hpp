// SPDX-License-Identifier: GPL-3.0-or-later
/// A scroll area for contents whose height depends on their width.
///
/// Such contents may need the bar where there is none, and not need it where it is. It would come and go for
/// ever, each time within the event of the time before, until the stack is used up: here the second time is
/// the last.
#pragma once

#include <QEvent>
#include <QScrollArea>

namespace extremal {

class SteadyScrollArea : public QScrollArea {
public:
    using QScrollArea::QScrollArea;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        constexpr int most = 2;
        if (event->type() != QEvent::Resize) return QScrollArea::eventFilter(watched, event);
        if (depth_ >= most) return false;
        ++depth_;
        const bool isHandled = QScrollArea::eventFilter(watched, event);
        --depth_;
        return isHandled;
    }

private:
    int depth_ = 0;  ///< of resizes within each other
};

}  // namespace extremal
