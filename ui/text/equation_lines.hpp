// SPDX-License-Identifier: GPL-3.0-or-later
/// Equations of motion under what was typed, and a button that copies them as LaTeX. Hidden where there are
/// none.
#pragma once

#include <QWidget>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"

class QLabel;
class QToolButton;

namespace extremal {

class EquationLines : public QWidget {
    Q_OBJECT
public:
    explicit EquationLines(const QString& tip, QWidget* parent = nullptr);

    /// `lines`: rich text, one per equation.
    void setEquations(const std::vector<std::string>& lines, const std::string& tex);
    /// Those of a typed model (typed/phase/motion_lines.hpp), found in a background thread; what cannot be
    /// read has none.
    void follow(const Settings& model);

private:
    QLabel* lines_;
    QToolButton* copy_;
    std::string tex_;
    Settings followed_;
};

}  // namespace extremal
