// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/text/handbook_pages.hpp"

#include <QFile>
#include <QRegularExpression>

static void initHandbook() { Q_INIT_RESOURCE(resources); }  // outside of any namespace

namespace extremal {
namespace {

/// The level of a heading, 1 for "# Title"; 0: the line is not a heading.
int headingLevel(const QString& line) {
    int level = 0;
    while (level < line.size() && line[level] == '#') ++level;
    return level < line.size() && line[level] == ' ' ? level : 0;
}

}  // namespace

QString handbookPage(const QString& page) {
    initHandbook();
    QFile file(QStringLiteral(":/handbook/%1.md").arg(page));
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()) : QString();
}

QString handbookTitle(const QString& page) {
    return handbookPage(page).section('\n', 0, 0).remove('#').trimmed();
}

QStringList handbookPages() {
    QStringList pages{QStringLiteral("index")};
    static const QRegularExpression link(QStringLiteral(R"(\]\(([\w-]+)\.md\))"));
    for (const QRegularExpressionMatch& match : link.globalMatch(handbookPage(QStringLiteral("index"))))
        if (!pages.contains(match.captured(1))) pages << match.captured(1);
    return pages;
}

QString handbookAnchor(const QString& heading) {
    QString anchor;
    for (const QChar c : heading.toLower())
        if (c.isLetterOrNumber())
            anchor += c;
        else if ((c == ' ' || c == '-') && !anchor.endsWith('-'))
            anchor += '-';
    return anchor;
}

QString handbookSection(const QString& place) {
    const QString text = handbookPage(place.section('#', 0, 0)), heading = place.section('#', 1);
    if (heading.isEmpty()) return text;
    QStringList section;
    int level = 0;
    bool isCode = false;
    for (const QString& line : text.split('\n')) {
        if (line.startsWith(QLatin1String("```"))) isCode = !isCode;
        const int here = isCode ? 0 : headingLevel(line);
        if (level > 0 && here > 0 && here <= level) break;
        if (level == 0 && here > 0 && handbookAnchor(line.mid(here).trimmed()) == heading) level = here;
        if (level > 0) section << line;
    }
    while (!section.isEmpty() && section.back().isEmpty()) section.removeLast();
    return section.isEmpty() ? QString() : section.join('\n') + '\n';
}

}  // namespace extremal
