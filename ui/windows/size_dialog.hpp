// SPDX-License-Identifier: GPL-3.0-or-later
/// Asks for the size of a picture on paper. The last choice is offered again.
#pragma once

#include <QDialog>
#include <QSize>

class QSpinBox;

namespace extremal {

struct PrintSize {
    int width = 120, height = 80;  ///< millimetres
    int dotsPerInch = 300;         ///< of pictures in pixels
    /// Of 96 per inch, in which fonts and lines are measured: text has its size on paper.
    QSize pixels() const;
};

class SizeDialog : public QDialog {
    Q_OBJECT
public:
    explicit SizeDialog(QWidget* parent);
    PrintSize chosen() const;
    void choose(const PrintSize& size);

private:
    QSpinBox *width_, *height_, *dots_;
};

}  // namespace extremal
