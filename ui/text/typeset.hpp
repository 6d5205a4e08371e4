// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes a Markdown page look like a page: space between paragraphs, code set off, tables with hairlines.
/// Qt's Markdown reader sets structure only.
#pragma once

#include <QString>

class QTextBrowser;
class QTextDocument;

namespace extremal {

/// Shows a page of the handbook, in the colours of the browser's palette. Its pictures are those of the
/// handbook; nothing else is loaded.
void showMarkdown(QTextBrowser& browser, const QString& markdown);

/// Shows a document that has been read, and takes it; the one before is deleted.
void showTypeset(QTextBrowser& browser, QTextDocument* document);

}  // namespace extremal
