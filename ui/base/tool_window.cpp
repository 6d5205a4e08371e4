// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/base/tool_window.hpp"

#include <QKeyEvent>
#include <QScreen>
#include <QWidget>

#include <utility>

namespace extremal {
namespace {

/// Keys that no part of the window takes come to the window itself.
class EscapeCloses : public QObject {
public:
    EscapeCloses(QWidget& window, std::function<bool()> mayClose)
        : QObject(&window), window_(window), mayClose_(std::move(mayClose)) {
        window.installEventFilter(this);
    }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() != QEvent::KeyPress) return QObject::eventFilter(watched, event);
        const auto* key = static_cast<const QKeyEvent*>(event);
        if (key->key() != Qt::Key_Escape || key->modifiers() != Qt::NoModifier) return false;
        if (!mayClose_ || mayClose_()) window_.close();
        return true;
    }

private:
    QWidget& window_;
    std::function<bool()> mayClose_;
};

}  // namespace

void setUpToolWindow(QWidget& window, const char* name, const QString& title, const char* page, QSize size) {
    window.setObjectName(name);
    window.setWindowTitle(title);
    window.setProperty("ground", "window");
    window.setProperty("help", page);
    window.setAttribute(Qt::WA_StyledBackground);
    const QSize room = window.screen()->availableSize() - QSize(24, 48);  // of its frame
    window.resize(size.boundedTo(room));
}

void closeOnEscape(QWidget& window, std::function<bool()> mayClose) {
    new EscapeCloses(window, std::move(mayClose));  // the window owns it
}

void bringToFront(QWidget& window) {
    window.show();
    window.raise();
    window.activateWindow();
}

}  // namespace extremal
