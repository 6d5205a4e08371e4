// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/foreign_text.hpp"

#include <QClipboard>
#include <QCoreApplication>
#include <QDesktopServices>
#include <QGuiApplication>
#include <QMenu>
#include <QTextBlock>
#include <QTextCursor>

#include <algorithm>
#include <vector>

#include "engine/scene/preset.hpp"
#include "ui/text/formula_text.hpp"
#include "ui/text/handbook_pages.hpp"

namespace extremal {
namespace {

QString say(const char* text) { return QCoreApplication::translate("extremal", text); }

bool isOfTheNet(const QUrl& url) {
    return (url.scheme() == QLatin1String("http") || url.scheme() == QLatin1String("https")) &&
           !url.host().isEmpty();
}

bool isOwn(const QUrl& url) {
    if (url.scheme() == QLatin1String("preset")) return findPreset(url.path().toStdString()) != nullptr;
    return url.scheme() == QLatin1String("handbook") && !handbookPage(url.path()).isEmpty();
}

/// "schemes.md#passport", as the pages of the handbook refer to each other.
QUrl placeOfPage(const QUrl& relative) {
    QUrl place;
    place.setScheme(QStringLiteral("handbook"));
    place.setPath(relative.path().section('.', 0, 0));
    if (relative.hasFragment()) place.setFragment(relative.fragment());
    return place;
}

/// Every character beyond ASCII is encoded: a host in look-alike letters shows as "xn--...". A name before
/// the host, as in "https://bank.com@evil.org", is left out.
QString fullAddress(const QUrl& url) {
    QUrl shown = url;
    shown.setUserInfo({});
    return shown.toString(QUrl::FullyEncoded);
}

struct Place {
    int begin, end;
    QTextCharFormat format;
};

/// Parts of the text whose format meets a condition, the last one first, so that edits leave the others where
/// they are.
template <class Condition>
std::vector<Place> placesWith(const QTextDocument& document, const Condition& holds) {
    std::vector<Place> places;
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next())
        for (auto it = block.begin(); !it.atEnd(); ++it) {
            const QTextFragment part = it.fragment();
            if (holds(part.charFormat()))
                places.push_back({part.position(), part.position() + part.length(), part.charFormat()});
        }
    std::reverse(places.begin(), places.end());
    return places;
}

QTextCursor select(QTextDocument& document, const Place& place) {
    QTextCursor cursor(&document);
    cursor.setPosition(place.begin);
    cursor.setPosition(place.end, QTextCursor::KeepAnchor);
    return cursor;
}

}  // namespace

void ForeignDocument::read(const QString& markdown) {
    parse(withFormulas(markdown.left(mostShown)));
    formatFormulas(*this);
    if (markdown.size() <= mostShown) return;
    QTextCursor end(this);
    end.movePosition(QTextCursor::End);
    end.insertBlock({}, {});
    end.insertText(
        say("%1 more characters are in the file and not shown here.").arg(markdown.size() - mostShown));
}

void ForeignDocument::readPage(const QString& markdown) { parse(markdown); }

void ForeignDocument::parse(const QString& markdown) {
    setUndoRedoEnabled(false);
    // One change: outside of an edit block Qt's reader takes the square of the time.
    QTextCursor whole(this);
    whole.beginEditBlock();
    // HTML could name pictures and style sheets in many ways; none of it is read.
    setMarkdown(markdown, MarkdownFeatures(MarkdownDialectGitHub) | MarkdownNoHTML);
    replacePictures();
    filterLinks([](const QUrl&) { return true; });
    whole.endEditBlock();
}

void ForeignDocument::keepOutsideLinks() { filterLinks(isOfTheNet); }

/// Not only hidden: to lay a picture out, Qt opens the file whose name is in the format even where
/// loadResource has nothing.
void ForeignDocument::replacePictures() {
    const std::vector<Place> places =
        placesWith(*this, [](const QTextCharFormat& f) { return f.isImageFormat(); });
    const auto source = [](const Place& place) { return place.format.toImageFormat().name(); };
    QString words;  // each part of a description that has a format of its own is a picture
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Place& place = places[i];
        words.prepend(place.format.property(QTextFormat::ImageAltText).toString());
        const bool goesOn = i + 1 < places.size() && places[i + 1].end == place.begin &&
                            source(places[i + 1]) == source(place);
        if (goesOn) {
            select(*this, place).removeSelectedText();
            continue;
        }
        select(*this, place).insertText(say("[picture, not loaded: %1]").arg(words), QTextCharFormat());
        words.clear();
    }
}

template <class Keep>
void ForeignDocument::filterLinks(const Keep& keep) {
    // Titles of links are tool tips, which may be rich text.
    for (const Place& place : placesWith(*this, [](const QTextCharFormat& f) {
             return f.isAnchor() || !f.anchorHref().isEmpty() || !f.toolTip().isEmpty();
         })) {
        const std::optional<QUrl> target = targetOfLink(place.format.anchorHref());
        QTextCharFormat format = place.format;
        if (target && keep(*target)) {
            format.setAnchorHref(target->toString(QUrl::FullyEncoded));
            format.setToolTip(fullAddress(*target).toHtmlEscaped());
        } else {
            for (const auto property :
                 {QTextFormat::IsAnchor, QTextFormat::AnchorHref, QTextFormat::AnchorName,
                  QTextFormat::TextToolTip, QTextFormat::ForegroundBrush, QTextFormat::TextUnderlineStyle,
                  QTextFormat::FontUnderline})
                format.clearProperty(property);
        }
        select(*this, place).setCharFormat(format);
    }
}

std::optional<QUrl> targetOfLink(const QString& written) {
    QUrl url(written.trimmed(), QUrl::StrictMode);
    if (!url.isValid() || written.isEmpty()) return std::nullopt;
    if (url.isRelative() && url.host().isEmpty() && !url.path().isEmpty()) url = placeOfPage(url);
    if (isOfTheNet(url) || isOwn(url)) return url;
    return std::nullopt;
}

void followLink(const QUrl& url, QWidget& parent, QPoint place) {
    const std::optional<QUrl> target = targetOfLink(url.toString());
    if (!target) return;
    if (isOwn(*target)) {
        QDesktopServices::openUrl(*target);  // the window's: it has said that it handles these schemes
        return;
    }
    auto* menu = new QMenu(&parent);
    menu->setObjectName("linkTarget");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->addAction(say("Opens in the browser, from %1:")
                        .arg(QString::fromLatin1(QUrl::toAce(target->host())).replace('&', "&&")))
        ->setEnabled(false);
    constexpr int widest = 560;
    const QString shown =
        menu->fontMetrics().elidedText(fullAddress(*target), Qt::ElideMiddle, widest).replace('&', "&&");
    QObject::connect(menu->addAction(shown), &QAction::triggered, menu,
                     [url = *target] { QDesktopServices::openUrl(url); });
    menu->addSeparator();
    QObject::connect(menu->addAction(say("Copy the address")), &QAction::triggered, menu, [url = *target] {
        QGuiApplication::clipboard()->setText(url.toString(QUrl::FullyEncoded));
    });
    menu->popup(place);
}

}  // namespace extremal
