// SPDX-License-Identifier: GPL-3.0-or-later
/// A text field for a formula: monospaced, as high as its text, with one place that can be underlined as
/// wrong.
#pragma once

#include <QPlainTextEdit>
#include <optional>

namespace extremal {

class FormulaEdit : public QPlainTextEdit {
    Q_OBJECT
public:
    explicit FormulaEdit(QWidget* parent = nullptr);

    /// Underlines the word at a character; none: nothing.
    void mark(std::optional<int> position);
    /// The whole of it was refused, wherever the place is.
    void setWrong(bool isWrong);

protected:
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void fit();
};

}  // namespace extremal
