// SPDX-License-Identifier: GPL-3.0-or-later
/// Texts that come from a scene, and so from anybody: notes, steps of a lesson, pages with labels in them.
///
///     ForeignDocument document;
///     document.read("see ![x](/dev/zero) and [this](https://example.org)");   // nothing is loaded
///
/// A text is Markdown. HTML in it is shown as it was typed. A picture is replaced by its description, so that
/// no file, pipe or address is ever opened. A link stays one only if it leads to a place that followLink
/// opens: http and https, a page of the handbook ("handbook:schemes#passport", "schemes.md#passport"), or a
/// preset ("preset:kepler"). Every other link becomes plain text.
#pragma once

#include <QString>
#include <QTextDocument>
#include <QUrl>

#include <optional>

class QPoint;
class QWidget;

namespace extremal {

class ForeignDocument : public QTextDocument {
public:
    using QTextDocument::QTextDocument;

    /// Replaces the contents. Formulas between dollar signs are typeset. What exceeds `mostShown` characters
    /// is left out, which the text then says.
    void read(const QString& markdown);
    /// The same without the formulas, of a page of the engine, which writes them itself.
    void readPage(const QString& markdown);
    /// Removes what leads into this program: a file for others must not link to it.
    void keepOutsideLinks();

    /// Some ten printed pages. Qt's time to read a list grows with the square of its items.
    static constexpr qsizetype mostShown = 20000;

protected:
    QVariant loadResource(int, const QUrl&) override { return {}; }

private:
    void parse(const QString& markdown);
    void replacePictures();
    template <class Keep>
    void filterLinks(const Keep& keep);
};

/// Where a link in a foreign text leads, with its scheme; nothing where it must not be followed.
std::optional<QUrl> targetOfLink(const QString& written);

/// Handbook and presets open at once. For an address on the net a menu at `place` names the target, and a
/// click in it opens it. Any other address is ignored.
void followLink(const QUrl& url, QWidget& parent, QPoint place);

}  // namespace extremal
