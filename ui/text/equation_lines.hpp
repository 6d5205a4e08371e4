// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of motion under what was typed, and a button that copies them as LaTeX. Hidden where there are
/// none.
#pragma once

#include <QWidget>
#include <string>
#include <vector>

class QLabel;
class QToolButton;

namespace extremal {

class EquationLines : public QWidget {
    Q_OBJECT
public:
    explicit EquationLines(QWidget* parent = nullptr);

    void setTip(const QString& tip);
    /// `lines`: rich text, one per equation.
    void setEquations(const std::vector<std::string>& lines, const std::string& tex);

private:
    QLabel* lines_;
    QToolButton* copy_;
    std::string tex_;
};

}  // namespace extremal
