// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/typeset.hpp"

#include <QFile>
#include <QPointer>
#include <QRegularExpression>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTextDocument>
#include <QTextTable>
#include <QUrl>

#include "ui/text/formula_text.hpp"

namespace extremal {
namespace {

bool isCode(const QTextBlock& block) {
    return block.isValid() && (block.blockFormat().hasProperty(QTextFormat::BlockCodeFence) ||
                               block.blockFormat().hasProperty(QTextFormat::BlockCodeLanguage));
}

QTextBlockFormat formatOf(const QTextBlock& block) {
    QTextBlockFormat format = block.blockFormat();
    format.setTopMargin(0);
    format.setBottomMargin(9);
    const bool isPicture = block.text() == QString(QChar::ObjectReplacementCharacter);  // as high as it is
    format.setLineHeight(isPicture ? 100 : 125, QTextBlockFormat::ProportionalHeight);
    if (const int level = format.headingLevel(); level > 0) {
        format.setTopMargin(level == 1 ? 4 : level == 2 ? 18 : 12);
        format.setBottomMargin(level == 1 ? 12 : 7);
    } else if (isCode(block)) {
        format.setBottomMargin(isCode(block.next()) ? 0 : 12);
        format.setLeftMargin(18);
    } else if (block.textList()) {
        format.setBottomMargin(4);
    } else if (QTextCursor(block).currentTable()) {
        format.setBottomMargin(0);
        format.setAlignment(Qt::AlignLeft);
        format.setNonBreakableLines(!block.text().contains(' '));  // a number is not cut at its point
    }
    return format;
}

void typesetTable(QTextTable& table, const QPalette& palette) {
    QTextTableFormat format = table.format();
    format.setCellSpacing(0);
    format.setCellPadding(5);
    format.setBorder(0);
    format.setBorderCollapse(true);
    format.setTopMargin(2);
    format.setBottomMargin(14);
    table.setFormat(format);
    for (int row = 0; row < table.rows(); ++row)
        for (int column = 0; column < table.columns(); ++column) {
            QTextTableCell cell = table.cellAt(row, column);
            QTextTableCellFormat line = cell.format().toTableCellFormat();
            line.setBottomBorder(1);
            line.setBottomBorderStyle(QTextFrameFormat::BorderStyle_Solid);
            line.setBottomBorderBrush(row == 0 ? palette.mid() : palette.alternateBase());
            cell.setFormat(line);
            if (row > 0) continue;
            QTextCursor text = cell.firstCursorPosition();
            // The reader leaves an empty paragraph here when the table follows code.
            if (text.block().length() == 1 && text.block() != cell.lastCursorPosition().block())
                text.deleteChar();
            text.setPosition(cell.lastCursorPosition().position(), QTextCursor::KeepAnchor);
            QTextCharFormat bold;
            bold.setFontWeight(QFont::DemiBold);
            text.mergeCharFormat(bold);
        }
}

/// A page of the handbook: its pictures are in the program, and nothing else is loaded.
class HandbookDocument : public QTextDocument {
public:
    using QTextDocument::QTextDocument;

protected:
    QVariant loadResource(int type, const QUrl& name) override {
        static const QRegularExpression plainName(QStringLiteral("^[\\w-]+\\.svg$"));
        if (type != QTextDocument::ImageResource || !plainName.match(name.toString()).hasMatch()) return {};
        QFile file(":/handbook/" + name.toString());
        return file.open(QIODevice::ReadOnly) ? QVariant(file.readAll()) : QVariant();
    }
};

}  // namespace

void showTypeset(QTextBrowser& browser, QTextDocument* document) {
    const QPalette palette = browser.palette();
    QTextCursor whole(document);
    whole.beginEditBlock();
    for (QTextBlock block = document->begin(); block.isValid(); block = block.next())
        QTextCursor(block).setBlockFormat(formatOf(block));
    for (QTextFrame* frame : document->rootFrame()->childFrames())
        if (auto* table = qobject_cast<QTextTable*>(frame)) typesetTable(*table, palette);
    whole.endEditBlock();
    const QPointer<QTextDocument> last = browser.document();
    // The marks of a search are cursors of the last document: the browser would ask it for their places when
    // it is given others.
    browser.setExtraSelections({});
    browser.setDocument(document);
    delete last;  // where the browser has not
    browser.verticalScrollBar()->setValue(0);
}

void showMarkdown(QTextBrowser& browser, const QString& markdown) {
    // Separate from the browser, which would lay out the text again after every change; without a history of
    // them.
    auto* document = new HandbookDocument(&browser);
    document->setUndoRedoEnabled(false);
    document->setDefaultFont(browser.font());
    document->setMarkdown(markdown);
    document->setDocumentMargin(18);
    formatFormulas(*document);
    showTypeset(browser, document);
}

}  // namespace extremal
