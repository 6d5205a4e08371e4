// SPDX-License-Identifier: GPL-3.0-or-later
/// Formulas in texts, as TeX between dollar signs: the part of it that notes use, as characters with italic
/// letters, raised and lowered parts, and roots under a line.
///
///     const QString marked = withFormulas("with $\\omega = \\sqrt{k/m}$");   // marks around the parts
///     ... document.setMarkdown(marked) ...
///     formatFormulas(document);                                            // the marks become formats
///
/// Commands that are not known stay as they are, so that nothing is lost.
#pragma once

#include <QString>

class QTextDocument;

namespace extremal {

QString withFormulas(const QString& text);
void formatFormulas(QTextDocument& document);

/// Pages of the engine (engine/passport/document.hpp): indices and exponents in plain text are lowered and
/// raised, and lines set off as code are formulas, in the font of the text. Listings stay as they are.
void formatPage(QTextDocument& document);

}  // namespace extremal
