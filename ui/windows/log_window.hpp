// SPDX-License-Identifier: GPL-3.0-or-later
/// Everything that the program has said in this session.
#pragma once

#include <QWidget>

class QPlainTextEdit;

namespace extremal {

class Notices;

class LogWindow : public QWidget {
    Q_OBJECT
public:
    explicit LogWindow(Notices& notices, QWidget* parent = nullptr);
    void open();

private:
    void refresh();

    Notices& notices_;
    QPlainTextEdit* text_;
};

}  // namespace extremal
