/// What the windows beside the main one have in common.
#pragma once

#include <QSize>
#include <QString>

class QWidget;

namespace extremal {

/// Its name, the title, the page of the handbook for F1, the ground of the theme, and a size that fits on the
/// screen.
void setUpToolWindow(QWidget& window, const char* name, const QString& title, const char* page, QSize size);

/// Shows it, in front of the others.
void bringToFront(QWidget& window);

}  // namespace extremal
