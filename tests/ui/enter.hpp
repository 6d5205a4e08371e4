// SPDX-License-Identifier: GPL-3.0-or-later
/// What a user does to a line of text.
#pragma once

#include <QLineEdit>
#include <QTest>

namespace extremal {

/// Replaces the text and presses Return.
inline void enter(QLineEdit* edit, const QString& text) {
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, text);
    QTest::keyClick(edit, Qt::Key_Return);
}

}  // namespace extremal
