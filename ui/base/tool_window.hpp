// SPDX-License-Identifier: GPL-3.0-or-later
/// What the windows beside the main one have in common.
#pragma once

#include <QSize>
#include <QString>

#include <functional>

class QWidget;

namespace extremal {

/// Its name, the title, the page of the handbook for F1, the ground of the theme, and a size that fits on the
/// screen.
void setUpToolWindow(QWidget& window, const char* name, const QString& title, const char* page, QSize size);

/// Esc closes the window, from whatever part of it has the focus and has no use of its own for the key.
/// `mayClose` is asked first: what was typed and not applied must not get lost by one key.
void closeOnEscape(QWidget& window, std::function<bool()> mayClose = {});

/// Shows it, in front of the others.
void bringToFront(QWidget& window);

}  // namespace extremal
