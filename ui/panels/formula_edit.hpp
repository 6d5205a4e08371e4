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
    /// How high it is when empty; two lines at first. With one line Return does not begin a new one.
    void setLeastLines(int lines);

signals:
    void returnPressed();  ///< of a field with one line

protected:
    void keyPressEvent(QKeyEvent* event) override;
    /// TeX is pasted as a formula.
    void insertFromMimeData(const QMimeData* source) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void fit();
    int leastLines_ = 2;
};

}  // namespace extremal
