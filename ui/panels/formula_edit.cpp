// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/panels/formula_edit.hpp"

#include <QEvent>
#include <QFontDatabase>
#include <QKeyEvent>
#include <QMimeData>
#include <QTextBlock>
#include <QTextLayout>
#include <algorithm>

#include "ui/base/theme.hpp"
#include "ui/workspace/tex_formula.hpp"

namespace extremal {

FormulaEdit::FormulaEdit(QWidget* parent) : QPlainTextEdit(parent) {
    const QFont mono = QFontDatabase::systemFont(QFontDatabase::FixedFont);
    setFont(mono);
    setProperty("role", "formula");  // of which the style sheet knows the size
    setTabChangesFocus(true);
    setWordWrapMode(QTextOption::WrapAtWordBoundaryOrAnywhere);
    setVerticalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(this, &QPlainTextEdit::textChanged, this, &FormulaEdit::fit);
}

void FormulaEdit::resizeEvent(QResizeEvent* event) {
    QPlainTextEdit::resizeEvent(event);
    fit();
}

void FormulaEdit::changeEvent(QEvent* event) {
    QPlainTextEdit::changeEvent(event);
    if (event->type() == QEvent::FontChange) fit();
}

void FormulaEdit::setLeastLines(int lines) {
    leastLines_ = lines;
    fit();
}

void FormulaEdit::keyPressEvent(QKeyEvent* event) {
    const bool isReturn = event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter;
    if (isReturn && leastLines_ == 1) {
        event->accept();
        return emit returnPressed();
    }
    QPlainTextEdit::keyPressEvent(event);
}

void FormulaEdit::insertFromMimeData(const QMimeData* source) {
    if (source->hasText() && isTex(source->text())) return insertPlainText(formulaFromTex(source->text()));
    QPlainTextEdit::insertFromMimeData(source);
}

void FormulaEdit::fit() {
    int lines = 0;
    for (QTextBlock block = document()->begin(); block.isValid(); block = block.next()) {
        blockBoundingRect(block);  // lays it out
        lines += std::max(1, block.layout() ? block.layout()->lineCount() : 1);
    }
    const int margins = 2 * (static_cast<int>(document()->documentMargin()) + frameWidth()) + 6;
    setFixedHeight(std::clamp(lines, leastLines_, 12) * fontMetrics().lineSpacing() + margins);
}

void FormulaEdit::mark(std::optional<int> position) {
    QList<QTextEdit::ExtraSelection> selections;
    if (position) {
        QTextEdit::ExtraSelection wrong;
        wrong.cursor = QTextCursor(document());
        const int end = document()->characterCount() - 1;
        wrong.cursor.setPosition(std::clamp(*position, 0, end));
        wrong.cursor.movePosition(QTextCursor::EndOfWord, QTextCursor::KeepAnchor);
        if (!wrong.cursor.hasSelection() && *position < end)
            wrong.cursor.movePosition(QTextCursor::NextCharacter, QTextCursor::KeepAnchor);
        if (!wrong.cursor.hasSelection())
            wrong.cursor.movePosition(QTextCursor::PreviousCharacter, QTextCursor::KeepAnchor);
        wrong.format.setUnderlineStyle(QTextCharFormat::WaveUnderline);
        wrong.format.setUnderlineColor(QColor(0xd0, 0x3a, 0x3a));
        selections << wrong;
    }
    setExtraSelections(selections);
}

void FormulaEdit::setWrong(bool isWrong) {
    if (property("invalid").toBool() == isWrong) return;
    setProperty("invalid", isWrong);
    repolish(*this);
}

}  // namespace extremal
