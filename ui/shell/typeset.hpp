/// Makes a Markdown page look like a page: space between paragraphs, code set off, tables with hairlines.
/// Qt's Markdown reader sets structure only.
#pragma once

#include <QString>

class QTextBrowser;

namespace extremal {

struct Document;

/// Shows the text in the colours of the browser's palette.
void showMarkdown(QTextBrowser& browser, const QString& markdown);

/// The same of a page of the engine, whose formulas are typeset; `ending`: Markdown that follows.
void showPage(QTextBrowser& browser, const Document& page, const QString& ending = {});

}  // namespace extremal
