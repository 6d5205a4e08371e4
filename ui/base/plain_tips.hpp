// SPDX-License-Identifier: GPL-3.0-or-later
/// Tool tips are plain text. Qt takes a tip for rich text if it looks like it, and rich text opens the files
/// it names: "<img src=/dev/zero>" in a label of a scene would be enough. This filter shows every tip of the
/// application, of widgets, actions, items and tabs, as the characters that it consists of.
#pragma once

#include <QObject>

class QApplication;

namespace extremal {

/// From now on; the second call does nothing.
void showTipsAsPlainText(QApplication& application);

/// The text of a tip in the form in which QToolTip shows exactly its characters.
QString plainTip(const QString& text);

}  // namespace extremal
