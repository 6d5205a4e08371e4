// SPDX-License-Identifier: GPL-3.0-or-later
/// The wanted error as a number and a slider of tenths of decades.
#pragma once

#include <QWidget>

class QLineEdit;

namespace extremal {

class SeekSlider;

class WantedError : public QWidget {
    Q_OBJECT
public:
    explicit WantedError(QWidget* parent = nullptr);

    double value() const { return value_; }
    /// To two digits, within the slider's range; tells of a change.
    void setValue(double value);
    void takeFocus();

signals:
    void changed(double value);
    void refused(const QString& text);  ///< what was typed is not a number above 0

private:
    void readText();
    void show();

    double value_ = 1e-6;
    QLineEdit* text_;
    SeekSlider* slider_;
};

}  // namespace extremal
