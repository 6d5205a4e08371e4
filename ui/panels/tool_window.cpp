#include "ui/panels/tool_window.hpp"

#include <QScreen>
#include <QWidget>

namespace extremal {

void setUpToolWindow(QWidget& window, const char* name, const QString& title, const char* page, QSize size) {
    window.setObjectName(name);
    window.setWindowTitle(title);
    window.setProperty("ground", "window");
    window.setProperty("help", page);
    window.setAttribute(Qt::WA_StyledBackground);
    const QSize room = window.screen()->availableSize() - QSize(24, 48);  // of its frame
    window.resize(size.boundedTo(room));
}

void bringToFront(QWidget& window) {
    window.show();
    window.raise();
    window.activateWindow();
}

}  // namespace extremal
