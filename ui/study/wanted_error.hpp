// SPDX-License-Identifier: GPL-3.0-or-later
/// The wanted error of the window as a number and a slider of tenths of decades.
#pragma once

#include <QWidget>

class QLineEdit;

namespace extremal {

class SeekSlider;
class Wanted;

class WantedError : public QWidget {
    Q_OBJECT
public:
    explicit WantedError(Wanted& wanted, QWidget* parent = nullptr);

    void takeFocus();

signals:
    void refused(const QString& text);  ///< what was typed is not a number above 0

private:
    void readText();
    void show();

    Wanted& wanted_;
    QLineEdit* text_;
    SeekSlider* slider_;
};

}  // namespace extremal
